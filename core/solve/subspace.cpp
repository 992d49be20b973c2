#include "solve/subspace.h"

#include <algorithm>
#include <cmath>

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
    const double gamma = basis_.gamma(o);
    if (basis_.set.state[o] == ActiveSet::disabled || !(gamma > k.lo[o] && gamma < k.hi[o] && basis_.response.diagonal[o] > 0)) continue;
    const std::int32_t p = pattern.row_position[o];
    double w = basis_.response.rows().product(o, basis_.response.velocity.data()) + (k.diagonal[p] * x[p] - k.b[p]);
    for (std::int32_t t = basis_.response.parts().beside[o]; t < pattern.row_pointers[o + 1]; ++t) w += k.row[t] * x[pattern.row_columns[t]];
    basis_.work.slack[o] = -w;
    basis_.work.slope[o] = -w * basis_.response.inverse[o];
    basis_.work.free[island.first_row + count++] = o;
  }
  return count;
}

/// With the direction p in work.slope: response.direction = M⁻¹Jᵀp, work.image = A p.     returns pᵀA p.
double Subspace::apply(const Island& island, std::span<const std::int32_t> free) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  const MassResponse::Rows rows = basis_.response.rows();
  const std::int32_t *position = pattern.row_position.data(), *beside = basis_.response.parts().beside.data(), *row_end = pattern.row_pointers.data() + 1;
  const double *diagonal = k.diagonal.data(), *p = basis_.work.slope.data();
  double *step = basis_.work.step.data(), *velocity = basis_.response.direction.data(), *image = basis_.work.image.data();
  basis_.response.clear_direction(island);
  for (const std::int32_t o : free) {
    step[position[o]] = -p[o];
    rows.add(o, p[o], velocity);
  }
  double curvature = 0;
  for (const std::int32_t o : free) {
    double sum = rows.product(o, velocity) + diagonal[position[o]] * step[position[o]];
    for (std::int32_t t = beside[o]; t < row_end[o]; ++t) sum += k.row[t] * step[pattern.row_columns[t]];
    image[o] = sum;
    curvature += sum * p[o];
  }
  counts_.work += 2 * (pattern.row_pointers[island.last_row] - pattern.row_pointers[island.first_row]);
  return curvature;
}

/// Impulses beyond their bounds go to them, and the velocities with them.
void Subspace::put_back(std::span<const std::int32_t> free) {
  const KktValues& k = basis_.values;
  for (const std::int32_t o : free) {
    const double gamma = basis_.gamma(o), within = std::clamp(gamma, k.lo[o], k.hi[o]);
    if (gamma == within) continue;
    basis_.set.x[basis_.position(o)] = -within;
    basis_.response.rows().add(o, within - gamma, basis_.response.velocity.data());
  }
}

void Subspace::minimise(const Island& island, int steps) {
  const std::span<const std::int32_t> free(basis_.work.free.data() + island.first_row, static_cast<std::size_t>(collect(island)));
  double *r = basis_.work.slack.data(), *direction = basis_.work.slope.data(), *x = basis_.set.x.data();
  const double *image = basis_.work.image.data(), *inverse = basis_.response.inverse.data();
  slice(basis_.work.step.data(), island.first, island.last) = 0;
  double now = 0;  // rᵀD⁻¹r
  for (const std::int32_t o : free) now += r[o] * direction[o];
  const double enough = reduced * now;
  for (int s = 0; s < steps && now > enough; ++s) {
    const double curvature = apply(island, free), length = now / curvature;
    if (!(curvature > 0) || !std::isfinite(length)) break;  // rounded data may have none
    basis_.response.advance(island, length);
    double next = 0;
    for (const std::int32_t o : free) {
      x[basis_.position(o)] -= length * direction[o];
      r[o] -= length * image[o];
      next += r[o] * (r[o] * inverse[o]);
    }
    const double kept = next / now;
    for (const std::int32_t o : free) direction[o] = r[o] * inverse[o] + kept * direction[o];
    now = next;
  }
  put_back(free);
}

}  // namespace mlcp
