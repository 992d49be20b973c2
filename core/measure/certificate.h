#pragma once
#include <mutex>

#include "assemble/mask.h"
#include "assemble/problem.h"

namespace mlcp {

/// Farkas: rows `row` with multipliers y prove that no v, γ satisfy the problem. Where hi = ∞, w ≥ 0 in every solution; where
/// lo = −∞, w ≤ 0. So with y > 0 only on the former, y < 0 only on the latter, Jᵀy = 0 on dynamic velocities and Σy = 0,
///     0 ≤ yᵀw = yᵀ(J v + Σγ − r) = −yᵀ(r − J v_given),
/// which yᵀ(r − J v_given) > 0 contradicts. From the caller's data alone.
class CertificateCheck {
 public:
  explicit CertificateCheck(const Memory& m) : sum_(m), size_(m), y_(m) {}
  /// Makes room, so that holds() allocates nothing.
  void prepare(const Problem& problem);
  /// What a proof may leave of zero, relative to |J|ᵀ|y| and |Σ||y|, and what yᵀ(r − J v_given) is to be more than.
  static constexpr double allowed = 1e-12;

  /// zero: of Jᵀy and Σy, at most allowed. May be called by several threads: they take turns.
  bool holds(const Problem& problem, const Mask* enabled, std::span<const std::int32_t> row, std::span<const double> y, double zero = allowed);

 private:
  std::mutex turn_;
  Array<long double> sum_;
  Array<double> size_, y_;
};

}  // namespace mlcp
