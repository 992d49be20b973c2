#include "factorize/refinement.h"

#include <cmath>

namespace mlcp {
namespace {

constexpr double rounding = 2.5e-16;
constexpr int most_steps = 6;

}  // namespace

void Refinement::prepare(std::int32_t size) {
  residual_.resize(size);
  scale_.resize(size);
  correction_.resize(size);
  best_.resize(size);
}

/// after: residual_ = b − K x, scale_ = |K||x| + size on the island.
double Refinement::measure(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
                           const double* b, const double* size, const double* x, std::int64_t& work) {
  for (std::int32_t p = island.first; p < island.last; ++p) {
    residual_[p] = static_cast<long double>(b[p]) - static_cast<long double>(values.diagonal[p]) * x[p];
    scale_[p] = size[p] + std::abs(values.diagonal[p] * x[p]);
  }
  for (std::int32_t p = island.first; p < island.last; ++p) {
    for (std::int32_t t = pattern.lower_pointers[p]; t < pattern.lower_pointers[p + 1]; ++t) {
      const std::int32_t q = pattern.lower_rows[t];
      const long double k = values.lower[t];
      residual_[p] -= k * x[q];
      residual_[q] -= k * x[p];
      scale_[p] += std::abs(values.lower[t] * x[q]);
      scale_[q] += std::abs(values.lower[t] * x[p]);
    }
  }
  work += 2 * (pattern.lower_pointers[island.last] - pattern.lower_pointers[island.first]);
  double worst = 0;
  for (std::int32_t p = island.first; p < island.last; ++p) {
    if (!factor.in(p)) continue;
    const double e = std::abs(static_cast<double>(residual_[p])), relative = scale_[p] > 0 ? e / scale_[p] : e;
    worst = relative <= worst ? worst : relative;  // keeps NaN
  }
  return worst;
}

double Refinement::solve(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
                         const double* b, const double* size, double* x, std::int64_t& steps, std::int64_t& work) {
  for (std::int32_t p = island.first; p < island.last; ++p)
    if (factor.in(p)) x[p] = 0;
  double error = 1;
  measure(island, pattern, values, factor, b, size, x, work);
  for (int step = 0;; ++step) {
    for (std::int32_t p = island.first; p < island.last; ++p) {
      correction_[p] = static_cast<double>(residual_[p]);
      best_[p] = x[p];
    }
    factor.solve(island, correction_.data(), work);
    for (std::int32_t p = island.first; p < island.last; ++p)
      if (factor.in(p)) x[p] += correction_[p];
    const double now = measure(island, pattern, values, factor, b, size, x, work);
    if (step > 0 && !(now < error)) {
      std::copy(best_.begin() + island.first, best_.begin() + island.last, x + island.first);
      return error;
    }
    error = now;
    if (error <= rounding || step == most_steps) return error;
    ++steps;
  }
}

}  // namespace mlcp
