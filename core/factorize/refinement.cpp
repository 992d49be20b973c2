#include "factorize/refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "memory/slice.h"

namespace mlcp {
namespace {

constexpr double rounding = 2.5e-16;
/// An error up to this is not looked at again: one more step costs as much as the first and gains a few roundings.
constexpr double done = 1e-15;
/// A momentum residual up to this cannot be made smaller for certain.
constexpr double settled = 1e-15;
constexpr int most_steps = 12;
/// Rows with an error up to this are right; those above are worth correcting alone.
constexpr double noisy = 1e-13;

}  // namespace

void Refinement::prepare(std::int32_t size) {
  residual_.resize(size);
  scale_.resize(size);
  correction_.resize(size);
  best_.resize(size);
}

/// after: residual_ = b − K x, scale_ = |K||x| + size on the island, of contacts their largest; of rows that are out neither need be. Rows gather along J and Σ, velocities along the columns
/// of K; only what these have on one side of the diagonal (M, rows that come before their velocities) is added to the other by scattering.
Refinement::Error Refinement::measure(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
                                      const double* b, const double* size, const double* x, std::int64_t& work) {
  for (std::int32_t p = island.first; p < island.last; ++p) {
    residual_[p] = static_cast<long double>(b[p]) - static_cast<long double>(values.diagonal[p]) * x[p];
    scale_[p] = size[p] + std::abs(values.diagonal[p] * x[p]);
  }
  const auto scatter = [&](std::int32_t q, double k, double own) {
    if (own == 0) return;
    residual_[q] -= static_cast<long double>(k) * own;
    scale_[q] += std::abs(k * own);
  };
  for (std::int32_t p = island.first; p < island.last; ++p) {
    const bool row = pattern.is_row(p);
    if (row && !island.crowded) continue;
    const double own = x[p];
    long double residual = residual_[p];
    double scale = scale_[p];
    for (std::int32_t t = pattern.lower_pointers[p]; t < pattern.lower_pointers[p + 1]; ++t) {
      const std::int32_t q = pattern.lower_rows[t];
      const double k = values.lower[t];
      if (k == 0) continue;  // masses of bodies are given as full blocks
      if (!pattern.is_row(q)) scatter(q, k, own);
      if (row || x[q] == 0) continue;  // most rows may be at rest
      residual -= static_cast<long double>(k) * x[q];
      scale += std::abs(k * x[q]);
    }
    residual_[p] = residual;
    scale_[p] = scale;
  }
  const bool alone = values.together.empty();  // no row lends its scale to others
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::int32_t p = pattern.row_position[o];
    if (alone && !factor.in(p)) continue;
    long double residual = residual_[p];
    double scale = scale_[p];
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) {
      const double k = values.row[t], other = x[pattern.row_columns[t]];
      residual -= static_cast<long double>(k) * other;
      scale += std::abs(k * other);
    }
    residual_[p] = residual;
    scale_[p] = scale;
  }
  work += 2 * (pattern.lower_pointers[island.last] - pattern.lower_pointers[island.first]);
  values.largest_together(island, [&](std::int32_t o) -> double& { return scale_[pattern.row_position[o]]; });
  Error worst;
  for (std::int32_t p = island.first; p < island.last; ++p) {
    if (!factor.in(p)) continue;
    const double e = std::abs(static_cast<double>(residual_[p])), relative = scale_[p] > 0 ? e / scale_[p] : e;
    const bool row = pattern.is_row(p);
    double& error = row ? worst.rows : worst.momentum;
    error = relative <= error ? error : relative;  // keeps NaN
    if (!row || relative <= noisy) continue;
    ++worst.off;
    worst.largest_off = std::max(worst.largest_off, e);
  }
  return worst;
}

/// A velocity far below the rounding of momentum, in a row that is still off, is 0: the row holds it exactly there. So is the impulse of a soft
/// row, whose only term it is once the velocities are 0, where momentum does not feel it.
void Refinement::stop(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor, double* x) {
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::int32_t p = pattern.row_position[o];
    if (!factor.in(p) || std::abs(static_cast<double>(residual_[p])) <= noisy * scale_[p]) continue;
    bool felt = false;
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) {
      const std::int32_t q = pattern.row_columns[t];
      const double lost = 1e-3 * rounding * scale_[q];
      felt |= std::abs(values.row[t] * x[p]) > lost;
      if (!pattern.is_row(q) && std::abs(values.diagonal[q] * x[q]) <= lost) x[q] = 0;
    }
    if (!felt && values.diagonal[p] != 0) x[p] = 0;
  }
}

/// A velocity that its row holds near 0 comes out as rounding of the impulses around it, far larger than the row's own terms. So once the momentum
/// residual is rounding it is left out of the right-hand side: then the correction is as small as the rows' residuals and leaves
/// momentum as it is (M δv = Jᵀδγ).
double Refinement::solve(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
                         const double* b, const double* size, double* x, std::int64_t& steps, std::int64_t& work, bool from_x) {
  const auto of = [&](auto* data) { return slice(data, island.first, island.last); };
  const auto look = [&] { return measure(island, pattern, values, factor, b, size, x, work); };
  // a row at rest has the error 1 until it is exactly at rest: its w tells whether it gets there
  const auto better = [](const Error& now, const Error& before) {
    return now.largest() < before.largest() || now.off < before.off || now.largest_off < 0.1 * before.largest_off;
  };
  bool zero = !from_x;
  for (std::int32_t p = island.first; p < island.last && !from_x; ++p) {
    if (factor.in(p)) x[p] = 0;
    zero &= x[p] == 0;
  }
  Error error;
  if (zero)
    std::transform(b + island.first, b + island.last, residual_.begin() + island.first, [](double whole) { return static_cast<long double>(whole); });
  else
    error = look();
  if (from_x && error.largest() <= done) return error.largest();
  // before: residual_ is that of x.  after: the same.
  const auto stop_what_is_lost = [&] {
    of(best_.data()) = of(x);
    stop(island, pattern, values, factor, x);
    const Error now = look();
    if (better(now, error)) {
      error = now;
    } else {
      of(x) = of(best_.data());
      look();
    }
  };
  bool stopped = false;
  double momentum_before = infinity;
  for (int step = from_x; step <= most_steps; ++step) {
    of(best_.data()) = of(x);
    const bool rows_alone = step > 0 && (error.momentum <= settled || error.momentum > 0.5 * momentum_before);
    for (std::int32_t p = island.first; p < island.last; ++p)
      correction_[p] = rows_alone && !pattern.is_row(p) ? 0.0 : static_cast<double>(residual_[p]);
    factor.solve(island, correction_.data(), work);  // 0 on what is out
    of(x) += of(correction_.data());
    steps += step > 0;
    const Error now = look();
    if (step > 0 && !better(now, error)) {
      of(x) = of(best_.data());
      if (error.off > 0) look();  // for what follows
      break;
    }
    if (!rows_alone) momentum_before = step > 0 ? error.momentum : infinity;
    error = now;
    // most of what is off is at rest, and a step along the rows alone has brought it below the rounding of momentum
    if (rows_alone && error.off > 0 && !std::exchange(stopped, true)) stop_what_is_lost();
    if (error.largest() <= done) return error.largest();
  }
  if (error.off > 0) stop_what_is_lost();
  return error.largest();
}

}  // namespace mlcp
