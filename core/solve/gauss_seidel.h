#pragma once
#include "factorize/mass_response.h"
#include "solve/basis.h"

namespace mlcp {

/// Projected Gauss-Seidel over the rows of an island (Moreau 1999; Jourdan, Alart & Jean 1998): each row in turn takes the impulse that makes
/// its own slack zero, within its bounds, and the velocities follow at once. Linear convergence at best: a first guess for the others,
/// or an answer of low accuracy.
class GaussSeidel {
 public:
  GaussSeidel(Basis& basis, Limits& limits, Counts& counts) : basis_(basis), limits_(limits), counts_(counts) {}

  /// false: M couples too many velocities, or is not positive definite; nothing has changed.
  bool prepare(const Island& island);
  /// Sweeps and conjugate gradients (Subspace) in turns until hardly a row leaves or reaches a bound any more; puts the rows where their impulses are.
  /// warm: the impulses are nearly right; before: cycles pay.
  void guess(const Island& island, bool warm);
  /// Whether conjugate gradients between the sweeps of a guess are worth their time: full steps from a worse guess take more factorizations, and so long as
  /// these are cheap, so is that. Where they are, sweeps from nearly right impulses are not worth theirs.
  bool cycles_pay(const Island& island) const;
  /// More rows are active than there are velocities. Then loads can be shared in many ways, and the longer a guess goes on, the more rows that contradict each
  /// other by a rounding it leaves between their bounds.
  bool must_depend(const Island& island) const;
  /// Sweeps until every error is within the tolerance.
  mlcp_outcome solve(const Island& island, double tolerance);

 private:
  void start(const Island& island);
  void sweep(const Island& island);
  double error(const Island& island);
  std::int32_t settle(const Island& island);

  Basis& basis_;
  Limits& limits_;
  Counts& counts_;
};

}  // namespace mlcp
