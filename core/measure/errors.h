#pragma once
#include "assemble/mask.h"
#include "assemble/problem.h"

namespace mlcp {

/// How far (v, γ) is from a solution, from the caller's numbers alone. Anything not finite is an infinite error.
struct Errors {
  double momentum = 0;              ///< componentwise backward error (Oettli & Prager 1964) over dynamic velocities
  double constraints = 0;           ///< natural residual in velocity units over the size of its terms
  double momentum_residual = 0;     ///< N·s
  double constraint_residual = 0;   ///< m/s
  std::int32_t worst_velocity = -1, worst_row = -1;
  double largest() const { return momentum > constraints ? momentum : constraints; }
};

/// Workspace and per-row numbers of one measurement.
class Measure {
 public:
  explicit Measure(const Memory& m) : w(m), scale(m), a(m), error(m), velocity_error(m), sum_(m), size_(m) {}

  /// after: w, scale, a, error (rows) and velocity_error hold what the maxima were taken over; rows left out by enabled are 0.
  Errors run(const Problem& problem, const Mask* enabled, std::span<const double> v, std::span<const double> gamma);

  Array<double> w;               ///< J v + Σ γ − r
  Array<double> scale;           ///< |J|(|v| + |v₀|) + |Σ||γ| + |r|,  v₀ⱼ = kⱼ/Mⱼⱼ
  Array<double> a;               ///< Σⱼ Jᵢⱼ²/Mⱼⱼ + Σᵢᵢ; where that is 0 the largest of the problem, or 1
  Array<double> error;           ///< per row
  Array<double> velocity_error;  ///< per velocity

 private:
  void momentum(const Problem& problem, std::span<const double> v, std::span<const double> gamma, Errors& e);
  void rows(const Problem& problem, const Mask* enabled, std::span<const double> v, std::span<const double> gamma, Errors& e);
  Array<long double> sum_;
  Array<double> size_;
};

/// median(w, a(γ − lo), a(γ − hi)): 0 exactly where w > 0 ⇒ γ = lo, w < 0 ⇒ γ = hi, lo ≤ γ ≤ hi holds.
double natural_residual(double w, double a, double gamma, double lo, double hi);

}  // namespace mlcp
