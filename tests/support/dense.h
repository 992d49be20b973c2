#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assemble/mask.h"
#include "assemble/problem.h"

/// The problem as the page states it: dense, in long double, everything by definition. What sparse results are tested against.
namespace support {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// M v − Jᵀγ = k, J v + Σγ − r = w, lo ≤ γ ≤ hi with all rows and velocities.
struct Dense {
  Matrix M, J, S;
  Vector k, r, lo, hi, given;
  std::vector<bool> dynamic, enabled;

  int n() const { return static_cast<int>(k.size()); }
  int m() const { return static_cast<int>(r.size()); }
};
Dense dense(const mlcp::Problem& problem, const mlcp::Mask* enabled = nullptr);

Vector widen(std::span<const double> x);

/// The two errors of a point, with their components and the worst of them.
struct DenseErrors {
  Real momentum = 0, constraints = 0;
  int worst_velocity = -1, worst_row = -1;
  Vector velocity, row;
};
/// negligible: residuals up to this count as 0, for denormal data.
DenseErrors errors_of(const Dense& d, const Vector& v, const Vector& gamma, Real negligible = 0);

/// "" if y on the rows proves infeasibility as Farkas has it, else what is wrong. zero: relative size that counts as nothing.
std::string certificate_fault(const Dense& d, std::span<const std::int32_t> rows, std::span<const double> y,
                              Real zero = 1e-12L);

/// The dense LCP of paper (2.8), over the enabled rows: w = A γ + b, A = J M⁻¹Jᵀ + Σ, b = J M⁻¹k + J v_given − r.
struct Reduced {
  Matrix A;
  Vector b, lo, hi;
  Vector size;           ///< of the terms that b is the sum of
  std::vector<int> row;  ///< of the problem
};
Reduced reduce(const Dense& d);

/// v = M⁻¹(k + Jᵀγ), given velocities where bodies are prescribed. γ over all rows.
Vector velocities(const Dense& d, const Vector& gamma);

/// A solution γ of the reduced problem by trying active sets, none if there is no solution. At most about 12 rows.
/// A solution at a vertex has independent active columns, so singular active sets need not be tried.
/// zero: slack relative to its terms that counts as nothing.
std::optional<Vector> enumerate(const Reduced& p, Real zero = 1e-15L);
/// The same for the whole problem: γ over all rows, 0 where disabled.
std::optional<Vector> oracle(const Dense& d);
/// Where slacks up to 1e-13 of the largest terms in the problem count as nothing: for what only rounding makes infeasible.
std::optional<Vector> forgiving_oracle(const Dense& d);

/// x with A x = b for symmetric positive definite A.
Matrix solve_spd(const Matrix& A, const Matrix& b);

}  // namespace support
