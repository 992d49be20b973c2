#include "factorize/refinement.h"

#include <cmath>

#include "memory/slice.h"

namespace mlcp {
namespace {

constexpr double rounding = 2.5e-16;
constexpr int most_steps = 6;
/// Rows with an error up to this are right; those above are worth correcting alone.
constexpr double noisy = 1e-13;

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
  off_ = 0;
  for (std::int32_t p = island.first; p < island.last; ++p) {
    if (!factor.in(p)) continue;
    const double e = std::abs(static_cast<double>(residual_[p])), relative = scale_[p] > 0 ? e / scale_[p] : e;
    worst = relative <= worst ? worst : relative;  // keeps NaN
    off_ += relative > noisy;
  }
  return worst;
}

/// Corrects rows alone. A velocity that its row holds near 0 comes out as rounding of the impulses around it, far larger than the row's own
/// terms. With the momentum residual, which is rounding by now, left out of the right-hand side, the correction is as small as
/// the row's residual and leaves momentum as it is (M δv = Jᵀδγ). What then is left far below the rounding of momentum, in a row that is
/// still off, is 0: the row holds it exactly there.
void Refinement::polish_rows(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
                             const double* b, const double* size, double* x, std::int64_t& work) {
  const auto of = [&](auto* data) { return slice(data, island.first, island.last); };
  for (int step = 0; step < 2; ++step) {
    for (std::int32_t p = island.first; p < island.last; ++p)
      correction_[p] = pattern.is_row(p) ? static_cast<double>(residual_[p]) : 0.0;
    factor.solve(island, correction_.data(), work);  // 0 on what is out
    of(x) += of(correction_.data());
    measure(island, pattern, values, factor, b, size, x, work);
  }
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::int32_t p = pattern.row_position[o];
    if (!factor.in(p) || std::abs(static_cast<double>(residual_[p])) <= noisy * scale_[p]) continue;
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) {
      const std::int32_t q = pattern.row_columns[t];
      if (!pattern.is_row(q) && std::abs(values.diagonal[q] * x[q]) <= 1e-3 * rounding * scale_[q]) x[q] = 0;
    }
  }
}

/// Solve and correct until rounding is reached or a step no longer helps; then, if rows are still off, polish them.
double Refinement::solve(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
                         const double* b, const double* size, double* x, std::int64_t& steps, std::int64_t& work) {
  const auto of = [&](auto* data) { return slice(data, island.first, island.last); };
  for (std::int32_t p = island.first; p < island.last; ++p)
    if (factor.in(p)) x[p] = 0;
  double error = measure(island, pattern, values, factor, b, size, x, work);
  const auto keep = [&] { of(best_.data()) = of(x); };
  const auto go_back = [&] {
    of(x) = of(best_.data());
    return measure(island, pattern, values, factor, b, size, x, work);
  };
  for (int step = 0; step <= most_steps; ++step) {
    keep();
    of(correction_.data()) = of(residual_.data()).cast<double>();
    factor.solve(island, correction_.data(), work);  // 0 on what is out
    of(x) += of(correction_.data());
    steps += step > 0;
    const double now = measure(island, pattern, values, factor, b, size, x, work);
    if (step > 0 && !(now < error)) {
      error = go_back();
      break;
    }
    error = now;
    if (error <= rounding) return error;
  }
  if (off_ == 0) return error;
  const std::int32_t off = off_;
  keep();
  ++steps;
  polish_rows(island, pattern, values, factor, b, size, x, work);
  const double now = measure(island, pattern, values, factor, b, size, x, work);
  return off_ < off || now < error ? now : go_back();
}

}  // namespace mlcp
