#include "solve/subspace.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "memory/slice.h"

namespace mlcp {
namespace {

/// Of rᵀD⁻¹r: what is left is below what rows change sides for.
constexpr double reduced = 1e-12;

}  // namespace

/// after: rows between their bounds stand in work.free, their residuals −w in work.slack and D⁻¹r in work.slope.     returns how many there are.
std::int32_t Subspace::collect(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  const double* x = basis_.set.x.data();
  std::int32_t count = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const double gamma = basis_.gamma(o), a = basis_.response.diagonal[o];
    if (basis_.set.state[o] == ActiveSet::disabled || !(gamma > k.lo[o] && gamma < k.hi[o] && a > 0)) continue;
    const std::int32_t p = pattern.row_position[o];
    double w = k.diagonal[p] * x[p] - k.b[p];
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) w += k.row[t] * x[pattern.row_columns[t]];
    basis_.work.slack[o] = -w;
    basis_.work.slope[o] = -w / a;
    basis_.work.free[island.first_row + count++] = o;
  }
  return count;
}

/// With the direction p in work.slope: work.step = (M⁻¹Jᵀp, −p), work.image = A p.     returns pᵀA p.
double Subspace::apply(const Island& island, std::int32_t count) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  const std::span<const std::int32_t> free(basis_.work.free.data() + island.first_row, static_cast<std::size_t>(count));
  double* step = basis_.work.step.data();
  slice(step, island.first, island.last) = 0;
  for (const std::int32_t o : free) {
    step[pattern.row_position[o]] = -basis_.work.slope[o];
    basis_.response.add(o, basis_.work.slope[o], step);
  }
  double curvature = 0;
  for (const std::int32_t o : free) {
    const std::int32_t p = pattern.row_position[o];
    double image = k.diagonal[p] * step[p];
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) image += k.row[t] * step[pattern.row_columns[t]];
    basis_.work.image[o] = image;
    curvature += image * basis_.work.slope[o];
  }
  counts_.work += 2 * (pattern.row_pointers[island.last_row] - pattern.row_pointers[island.first_row]);
  return curvature;
}

/// Impulses beyond their bounds go to them, and the velocities with them.
void Subspace::put_back(const Island& island, std::int32_t count) {
  const KktValues& k = basis_.values;
  double* x = basis_.set.x.data();
  for (std::int32_t f = 0; f < count; ++f) {
    const std::int32_t o = basis_.work.free[island.first_row + f];
    const double gamma = basis_.gamma(o), within = std::clamp(gamma, k.lo[o], k.hi[o]);
    if (gamma == within) continue;
    x[basis_.position(o)] = -within;
    basis_.response.add(o, within - gamma, x);
  }
}

void Subspace::minimise(const Island& island, int steps) {
  const std::int32_t count = collect(island);
  const std::span<const std::int32_t> free(basis_.work.free.data() + island.first_row, static_cast<std::size_t>(count));
  double *r = basis_.work.slack.data(), *direction = basis_.work.slope.data();
  const double *image = basis_.work.image.data(), *diagonal = basis_.response.diagonal.data();
  double now = 0;  // rᵀD⁻¹r
  for (const std::int32_t o : free) now += r[o] * direction[o];
  const double enough = reduced * now;
  for (int s = 0; s < steps && now > enough; ++s) {
    const double curvature = apply(island, count);
    if (!(curvature > 0) || !std::isfinite(now / curvature)) break;  // rounded data may have none
    const double length = now / curvature;
    slice(basis_.set.x.data(), island.first, island.last) += length * slice(basis_.work.step.data(), island.first, island.last);
    double next = 0;
    for (const std::int32_t o : free) {
      r[o] -= length * image[o];
      next += r[o] * r[o] / diagonal[o];
    }
    const double kept = next / now;
    for (const std::int32_t o : free) direction[o] = r[o] / diagonal[o] + kept * direction[o];
    now = next;
  }
  put_back(island, count);
}

}  // namespace mlcp
