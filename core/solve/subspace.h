#pragma once
#include <span>

#include "solve/basis.h"

namespace mlcp {

/// What Gauss-Seidel is slow at: the minimum of ½γᵀAγ + bᵀγ over the rows whose impulses lie between their bounds, while the others stay, by a few
/// conjugate gradients preconditioned with the diagonal of A. Impulses that leave their bounds on the way are put back in the end: the sweeps
/// around it find the rows that rest, this carries loads through them (Silcowitz-Hansen, Niebe & Erleben 2010). A is never formed.
class Subspace {
 public:
  Subspace(Basis& basis, Counts& counts) : basis_(basis), counts_(counts) {}

  /// before: γ in x, M⁻¹(k + Jᵀγ) in response.velocity.     after: the same, |w| smaller on rows between their bounds.
  /// cost: entries of J and M⁻¹Jᵀ a step.
  void minimise(const Island& island, int steps);

 private:
  std::int32_t collect(const Island& island);
  double apply(const Island& island, std::span<const std::int32_t> free);
  void put_back(std::span<const std::int32_t> free);

  Basis& basis_;
  Counts& counts_;
};

}  // namespace mlcp
