#pragma once
#include "solve/basis.h"

namespace mlcp {

/// The proximal problem around (u, c) (`center`): the dual with ½ε Σ aᵢ(γᵢ − cᵢ)² added, which makes K quasi-definite and dependent
/// rows harmless, and where M is only semidefinite the primal with ½δ|v − u|² (Rockafellar 1976; Hermans, Themelis & Patrinos 2022). It is
/// unconstrained and piecewise quadratic in v,
///     f(v) = ½vᵀMv − kᵀv + ½δ|v − u|² + Σ ψᵢ(wᵢ),   ψᵢ' = −γᵢ(wᵢ),   γᵢ(w) = median(lo, hi, (ε aᵢ cᵢ − w) / (Σᵢᵢ + ε aᵢ)),   w = J v − r,
/// and where Σ couples rows, in (v, z) with ½zᵀΣz and w = J v + Σz − r; then Σᵢᵢ is not in γᵢ(w).
class Proximal {
 public:
  Proximal(Basis& basis, Counts& counts) : basis_(basis), counts_(counts) {}

  /// Looks at the island: whether Σ couples rows.
  void enter(const Island& island);
  /// ε and δ from now on, and the factor to go with them.  false: M + δ is not positive definite.
  bool soften(const Island& island, double epsilon, double delta, double drop);
  /// ε from now on, the factor being there.
  void resume(double epsilon) { epsilon_ = epsilon; }
  double epsilon() const { return epsilon_; }

  /// center := x of the basis, impulses within their bounds
  void center_here(const Island& island);
  /// The Newton point of the present active set: K_ε x = b_ε, rows that rest at their bounds. Into Basis::set.x.
  void newton_point(const Island& island);
  /// Rows whose state does not fit the Newton point: those are the changes of a full Newton step.
  /// after: w and what counts as zero are fresh.
  std::span<const Flip> flips_of_full_step(const Island& island);
  /// Rows whose state does not fit x by ε = 0. before: w and what counts as zero are fresh.
  std::span<const Flip> flips_of_point(const Island& island) { return flips(island, 0); }

  /// The `count` flips whose rows are furthest from their state: |w|/√a of those that enter, √a times the excess of the impulse of those that
  /// leave. Ties go to the first.  before: flips come from one of the two above.
  std::span<const Flip> largest(std::span<const Flip> flips, std::size_t count);

  /// Starts a descent on f at the present x.
  void start_descent(const Island& island);
  /// Rows whose state is not that of f at the point of the descent.
  std::span<const Flip> flips_of_descent(const Island& island);
  /// One step to the minimum of f on the line to the Newton point.  returns its length; 1: the Newton point itself.
  double descend(const Island& island);
  /// center := (v, γ(w)) at the point.  returns max √aᵢ|γᵢ − cᵢ|.
  double recenter(const Island& island);

 private:
  std::span<const Flip> flips(const Island& island, double epsilon);
  double impulse(std::int32_t o, double slack) const;
  void find_slacks(const Island& island);
  double search(const Island& island);

  Basis& basis_;
  Counts& counts_;
  double epsilon_ = 0;
  bool coupled_ = false;
};

}  // namespace mlcp
