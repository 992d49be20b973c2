#pragma once
#include "scenes/handles.h"

/// Takes the place of dSolveLCP of ODE, Bullet and DART: the same arrays, the same meaning. Keep one for each thread; it owns its memory.
///
///     A x = b + w,   lo ≤ x ≤ hi,   wᵢ > 0 ⇒ xᵢ = loᵢ,   wᵢ < 0 ⇒ xᵢ = hiᵢ
///
/// with |xᵢ| ≤ hiᵢ x[findexᵢ] on rows with findexᵢ ≥ 0. Three differences: bounds of friction follow the normal impulses of the *answer*, where
/// dSolveLCP takes those of a solve without friction; the answer is measured, so that a wrong one is never returned as a right one; and
/// A and b stay as they are.
class Swap {
 public:
  explicit Swap(const mlcp_settings* settings = nullptr);

  /// n: rows. A: n × n, symmetric, rows padded to a multiple of four (dPAD), zeros of which cost nothing. b, lo, hi: n. nub: so many rows at
  /// the beginning are free. findex: n entries or NULL. Out: x and w, n each. Returns whether it is solved; `report` tells the rest.
  /// Throws std::runtime_error for arrays that make no problem, with the row.
  bool solve(int n, const double* A, double* x, const double* b, double* w, int nub, const double* lo, const double* hi, const int* findex);

  const mlcp_report& report() const { return report_; }

 private:
  handles::Problem problem_ = handles::make_problem();
  handles::Solver solver_;
  mlcp_report report_;
};
