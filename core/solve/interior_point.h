#pragma once
#include "solve/basis.h"

namespace mlcp {

/// Mehrotra's predictor-corrector method (1992) on the complementarity conditions with bounds: γ strictly between them, a slack of each sign > 0,
///     M v − Jᵀγ = k,   J v + Σγ − r = s − t,   (γ − lo) s = µ,   (hi − γ) t = µ,   µ → 0.
/// Every step factors K with the compliance s/(γ − lo) + t/(hi − γ) on each row, all rows active. The number of steps, ten to twenty, hardly depends on
/// how many rows there are or how much they depend on each other, which is where active-set steps are many. It ends where it is clear which rows are active:
/// a start for Newton, not an answer.
class InteriorPoint {
 public:
  InteriorPoint(Basis& basis, Limits& limits, Counts& counts) : basis_(basis), limits_(limits), counts_(counts) {}

  /// From the impulses and velocities in the basis.  false: M is not positive definite, numbers leave the range of doubles, or a limit is reached.
  /// delta: as in Proximal, around the point of each step. far: a thousand times as far inside, for impulses that have to grow by so much.
  bool start(const Island& island, double delta, bool far = false);
  /// Steps until µ is this part of what it was in the beginning.  false: there may be no feasible point, or as in start().
  /// after: rows are active where γ is further from its bounds than the slack from 0, and have that γ; the factor is not theirs.
  bool reduce(const Island& island, double part);
  mlcp_outcome stopped() const { return stopped_; }

 private:
  bool live(std::int32_t o) const;
  double gap(const Island& island) const;
  bool factorize(const Island& island);
  void find_residual(const Island& island);
  void solve(const Island& island, double target, bool second);
  double aim(std::int32_t o, double target, bool second, bool upper) const;
  double slack_step(std::int32_t o, double dgamma, double target, bool second, bool upper) const;
  double length(const Island& island, const double* step, double target, bool second) const;
  double gap_after(const Island& island, double t) const;
  void move(const Island& island, double t, double target);
  void settle(const Island& island);

  Basis& basis_;
  Limits& limits_;
  Counts& counts_;
  double first_gap_ = 0, gap_ = 0, delta_ = 0, proximal_ = 0;
  double margin_ = 1, infeasibility_ = 1;
  mlcp_outcome stopped_ = MLCP_SOLVED;
};

}  // namespace mlcp
