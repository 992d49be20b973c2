#pragma once
#include <algorithm>

#include "assemble/mask.h"
#include "assemble/problem.h"
#include "assemble/velocity_runs.h"

namespace mlcp {

/// How far (v, γ) is from a solution, from the caller's numbers alone. Anything not finite is an infinite error. Sums are those of double precision:
/// what rounding adds to a residual is rounding of the very terms that it is divided by.
struct Errors {
  double momentum = 0;              ///< componentwise backward error (Oettli & Prager 1964) over dynamic velocities
  double constraints = 0;           ///< natural residual in velocity units over the size of its terms
  double momentum_residual = 0;     ///< N·s
  double constraint_residual = 0;   ///< m/s
  std::int32_t worst_velocity = -1, worst_row = -1;
  double cones = 0;                 ///< defect of contacts with a cone over their scale
  double cone_residual = 0;         ///< m/s
  std::int32_t worst_contact = -1;
  double largest() const { return std::max({momentum, constraints, cones}); }
};

/// Workspace and per-row numbers of one measurement.
class Measure {
 public:
  explicit Measure(const Memory& m) : w(m), scale(m), a(m), residual(m), error(m), sum_(m), size_(m), diagonal_(m), diagonal_at_(m), reach_(m), inverse_(m), velocities_(m), rows_(m), largest_(m) {}

  /// contact_of_row: see SolveInput.
  /// after: w, scale, a, error (rows) and velocity_error() are what the maxima were taken over; rows left out by enabled are 0.
  Errors run(const Problem& problem, const Mask* enabled, std::span<const double> v, std::span<const double> gamma, std::span<const std::int32_t> contact_of_row = {});

  /// The errors of one part, and whether those of its rows are right already: some may have no a of their own, or share a scale with others.
  struct Part {
    Errors errors;
    bool complete = true;
  };
  /// The same by parts that share no dynamic velocity, each of which may be measured on a thread of its own. Neither order nor threads change a bit.
  /// begin: room, prescribed velocities, and the errors of those that stand alone.  end: from those and from all parts; what rows share.
  Errors begin(const Problem& problem, const Mask* enabled, std::span<const VelocityRuns::Run> free_velocities, std::span<const double> v);
  Part part(const Problem& problem, std::span<const std::int32_t> velocities, std::span<const std::int32_t> rows, std::span<const double> v,
            std::span<const double> gamma);
  Errors end(const Problem& problem, const Mask* enabled, std::span<const double> gamma, std::span<const std::int32_t> contact_of_row, Errors free,
             std::span<const Part> parts);

  /// The maxima over rows, of residual and error as they are now.
  void take_maxima(const Mask* enabled, Errors& e) const;

  Array<double> w;               ///< J v + Σ γ − r
  Array<double> scale;           ///< |J|(|v| + |v₀|) + |Σ||γ| + |r|,  v₀ⱼ = kⱼ/Mⱼⱼ
  Array<double> a;               ///< Σⱼ Jᵢⱼ²/Mⱼⱼ + Σᵢᵢ; where that is 0 the largest of the problem, or 1
  Array<double> residual;        ///< |median(w, a(γ − lo), a(γ − hi))| per row
  Array<double> error;           ///< residual / scale per row
  /// |M v − Jᵀγ − k|ⱼ over the size of its terms, of the last run or part; 0 on prescribed bodies; not of free velocities that begin() has measured.
  double velocity_error(std::int32_t j) const;
  /// (M v − Jᵀγ − k)ⱼ of the last run.
  double momentum_residual(std::int32_t j) const { return sum_[j]; }
  /// The terms of that, by magnitude; Mⱼⱼ.
  double momentum_scale(std::int32_t j) const { return size_[j]; }
  double mass(std::int32_t j) const { return diagonal_[j]; }

 private:
  /// Mv − Jᵀγ − k and its terms, Mⱼⱼ, maxima.
  void momentum(const Problem& problem, std::span<const std::int32_t> velocities, std::span<const std::int32_t> rows, std::span<const double> v,
                std::span<const double> gamma, Errors& e);
  void free_momentum(const Problem& problem, std::span<const VelocityRuns::Run> runs, std::span<const double> v, Errors& e) const;
  /// w, scale and a.  before: momentum() of their velocities.
  void rows(const Problem& problem, std::span<const std::int32_t> rows, std::span<const double> v, std::span<const double> gamma);
  /// residual and error.
  void judge_row(const Problem& problem, std::int32_t i, double gamma);
  void take_row(std::int32_t i, Errors& e) const;
  /// All of them, with what some have from others.
  void judge_together(const Problem& problem, const Mask* enabled, std::span<const double> gamma, std::span<const std::int32_t> contact_of_row);
  void scale_by_contact(std::span<const std::int32_t> contact_of_row);
  Array<double> sum_;
  Array<double> size_;             // −1 on prescribed bodies
  Array<double> diagonal_;         // Mⱼⱼ; where rows have been, 1 if that is not positive; 0 on prescribed bodies
  Array<std::int32_t> diagonal_at_;  // where Mⱼⱼ stood among the entries of M at the last look
  Array<double> reach_, inverse_;  // |v| + |v₀|, −1 where no row has asked for it; 1/Mⱼⱼ likewise
  Array<std::int32_t> velocities_, rows_;  // all that is measured by run()
  Array<double> largest_;                  // by contact
};

/// absolute / size, and infinity where either is not finite. Where there is nothing to compare with, the absolute one.
double relative_error(double absolute, double size);

/// median(w, a(γ − lo), a(γ − hi)): 0 exactly where w > 0 ⇒ γ = lo, w < 0 ⇒ γ = hi, lo ≤ γ ≤ hi holds.
double natural_residual(double w, double a, double gamma, double lo, double hi);

}  // namespace mlcp
