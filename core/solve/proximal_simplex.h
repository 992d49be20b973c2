#pragma once
#include "solve/simplex.h"

namespace mlcp {

/// The pivoting method where M is only semidefinite: proximal point steps on the primal (Rockafellar 1976),
///     vᵗ⁺¹ = argmin ½vᵀMv − kᵀv + ½δ|v − vᵗ|² over the rows,
/// each of them pivoted on M + δ from the last active set. Where the active rows leave M no direction of its own, as at the vertices of a linear program, the
/// second step finds nothing to move; else steps shrink by δ over the least curvature that is left.
class ProximalSimplex {
 public:
  ProximalSimplex(const SolveInput& input, Basis& basis, CertificateCheck& check, Limits& limits, Counts& counts)
      : problem_(input.problem), basis_(basis), limits_(limits), counts_(counts), simplex_(input, basis, check, limits, counts) {}

  /// As Simplex::solve. NOT_POSITIVE_DEFINITE: M + δ is not, or no step comes to rest: nothing holds a velocity that M does not.
  /// after: the factor is of M + δ.
  mlcp_outcome solve(const Island& island, std::int32_t index, Array<mlcp_pivot>* trace);
  /// After INFEASIBLE, as of Simplex.
  void settle(const Island& island);
  std::int32_t certificate_rows() const { return simplex_.certificate_rows(); }

 private:
  void add_mass(const Island& island);
  double moved(const Island& island);
  bool solves(const Island& island);

  const Problem& problem_;
  Basis& basis_;
  Limits& limits_;
  Counts& counts_;
  Simplex simplex_;
};

}  // namespace mlcp
