#include "measure/certificate.h"

#include <cmath>

namespace mlcp {
namespace {

/// In extended precision: what underflows in double is not 0.
bool vanishes(long double sum, double size, double zero) { return std::abs(sum) <= static_cast<long double>(zero) * size; }

}  // namespace

void CertificateCheck::prepare(const Problem& problem) {
  sum_.reserve(std::max(problem.n(), problem.m()));
  size_.reserve(std::max(problem.n(), problem.m()));
}

bool CertificateCheck::holds(const Problem& problem, const Mask* enabled, std::span<const std::int32_t> row,
                             std::span<const double> y, double zero) {
  const std::lock_guard turn(turn_);
  const SparseView jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  sum_.assign(std::max(problem.n(), problem.m()), 0.0L);
  size_.assign(std::max(problem.n(), problem.m()), 0.0);
  long double gap = 0;
  double gap_size = 0;
  for (std::size_t s = 0; s < row.size(); ++s) {
    const std::int32_t i = row[s];
    if (!std::isfinite(y[s]) || (y[s] > 0 && problem.hi[i] < infinity) || (y[s] < 0 && problem.lo[i] > -infinity)) return false;
    gap += static_cast<long double>(y[s]) * problem.r[i];
    gap_size += std::abs(y[s] * problem.r[i]);
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t) {
      const std::int32_t j = jacobian.indices[t];
      const long double term = static_cast<long double>(jacobian.values[t]) * y[s];
      if (problem.prescribed(j)) {
        gap -= term * problem.given_velocity[j];
        gap_size += std::abs(static_cast<double>(term) * problem.given_velocity[j]);
      } else {
        sum_[j] += term;
        size_[j] += std::abs(static_cast<double>(term));
      }
    }
  }
  for (std::int32_t j = 0; j < problem.n(); ++j)
    if (!vanishes(sum_[j], size_[j], zero)) return false;
  if (!(static_cast<double>(gap) > allowed * gap_size)) return false;

  sum_.assign(problem.m(), 0.0L);
  size_.assign(problem.m(), 0.0);
  for (std::size_t s = 0; s < row.size(); ++s)
    for (std::int32_t t = sigma.pointers[row[s]]; t < sigma.pointers[row[s] + 1]; ++t) {
      const long double term = static_cast<long double>(sigma.values[t]) * y[s];
      sum_[sigma.indices[t]] += term;
      size_[sigma.indices[t]] += std::abs(static_cast<double>(term));
    }
  for (std::int32_t i = 0; i < problem.m(); ++i)
    if ((!enabled || enabled->state[i] != MLCP_ROW_DISABLED) && !vanishes(sum_[i], size_[i], zero)) return false;
  return true;
}

}  // namespace mlcp
