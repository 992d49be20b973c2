#include "solve/proximal.h"

#include <algorithm>
#include <cmath>

#include "memory/slice.h"

namespace mlcp {

void Proximal::enter(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  coupled_ = false;
  for (std::int32_t t = pattern.row_pointers[island.first_row]; t < pattern.row_pointers[island.last_row] && !coupled_; ++t)
    coupled_ = pattern.is_row(pattern.row_columns[t]);
}

bool Proximal::soften(const Island& island, double epsilon, double delta, double drop) {
  epsilon_ = epsilon;
  basis_.values.regularise(*basis_.pattern, island, epsilon, delta);
  return basis_.refactorize(island, drop, counts_);
}

void Proximal::center_here(const Island& island) {
  const KktValues& k = basis_.values;
  slice(basis_.work.center.data(), island.first, island.last) = slice(basis_.set.x.data(), island.first, island.last);
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    basis_.work.center[basis_.position(o)] = -std::clamp(basis_.gamma(o), k.lo[o], k.hi[o]);
}

void Proximal::newton_point(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  double *x = basis_.set.x.data(), *rhs = basis_.work.rhs.data();
  const auto of = [&](auto& array) { return slice(array.data(), island.first, island.last); };
  of(basis_.work.rhs) = of(k.b);
  if (epsilon_ > 0) of(basis_.work.rhs) += (of(k.factored) - of(k.diagonal)) * of(basis_.work.center);
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::int32_t p = pattern.row_position[o];
    if (basis_.set.state[o] == ActiveSet::active || x[p] == 0) continue;
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) rhs[pattern.row_columns[t]] -= k.row[t] * x[p];
  }
  basis_.factor.solve(island, rhs, counts_.work);
  for (std::int32_t p = island.first; p < island.last; ++p)
    if (basis_.factor.in(p)) x[p] = rhs[p];
}

std::span<const Flip> Proximal::flips_of_full_step(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  ActiveSet& set = basis_.set;
  slacks(island, pattern, k, set.x.data(), set.w.data());
  slack_tolerances(island, pattern, k, basis_.zero(), set);
  counts_.work += 2 * (pattern.row_pointers[island.last_row] - pattern.row_pointers[island.first_row]);
  return flips(island, epsilon_);
}

std::span<const Flip> Proximal::flips(const Island& island, double epsilon) {
  const KktValues& k = basis_.values;
  const ActiveSet& set = basis_.set;
  Flip* flips = basis_.work.flips.data() + island.first_row;
  std::size_t count = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::uint8_t state = set.state[o];
    const double gamma = basis_.gamma(o);
    if (state == ActiveSet::active) {
      if (gamma < k.lo[o]) flips[count++] = {o, ActiveSet::at_lower};
      if (gamma > k.hi[o]) flips[count++] = {o, ActiveSet::at_upper};
      continue;
    }
    if (state == ActiveSet::disabled || !(k.a[o] > 0)) continue;
    double w = set.w[o];
    if (epsilon > 0) w += epsilon * k.a[o] * (gamma + basis_.work.center[basis_.position(o)]);
    const double zero = set.tolerance[o];
    if (state == ActiveSet::at_lower ? w < -zero : state == ActiveSet::at_upper ? w > zero : std::abs(w) > zero)
      flips[count++] = {o, ActiveSet::active};
  }
  return {flips, count};
}

std::span<const Flip> Proximal::largest(std::span<const Flip> flips, std::size_t count) {
  Flip* first = basis_.work.flips.data() + (flips.data() - basis_.work.flips.data());
  const auto distance = [&](const Flip& f) {
    const double root = basis_.values.root_a[f.o], gamma = basis_.gamma(f.o);
    return f.to == ActiveSet::active       ? std::abs(basis_.set.w[f.o]) / root
           : f.to == ActiveSet::at_lower ? root * (basis_.values.lo[f.o] - gamma)
                                           : root * (gamma - basis_.values.hi[f.o]);
  };
  std::nth_element(first, first + (count - 1), first + flips.size(), [&](const Flip& a, const Flip& b) {
    const double da = distance(a), db = distance(b);
    return da > db || (da == db && a.o < b.o);
  });
  return {first, count};
}

double Proximal::impulse(std::int32_t o, double slack) const {
  const KktValues& k = basis_.values;
  const double e = epsilon_ * k.a[o], sigma = coupled_ ? 0.0 : -k.diagonal[basis_.position(o)];
  const double gamma = (-e * basis_.work.center[basis_.position(o)] - slack) / (sigma + e);
  return gamma < k.lo[o] ? k.lo[o] : gamma > k.hi[o] ? k.hi[o] : gamma;
}

/// w at the point of the descent
void Proximal::find_slacks(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  const double* x = basis_.work.point.data();
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::int32_t p = pattern.row_position[o];
    double w = (coupled_ ? k.diagonal[p] * x[p] : 0.0) - k.b[p];
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) w += k.row[t] * x[pattern.row_columns[t]];
    basis_.work.slack[o] = w;
  }
}

void Proximal::start_descent(const Island& island) {
  slice(basis_.work.point.data(), island.first, island.last) = slice(basis_.set.x.data(), island.first, island.last);
  find_slacks(island);
}

std::span<const Flip> Proximal::flips_of_descent(const Island& island) {
  const KktValues& k = basis_.values;
  Flip* flips = basis_.work.flips.data() + island.first_row;
  std::size_t count = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (basis_.set.state[o] == ActiveSet::disabled || !(k.a[o] > 0)) continue;
    const double gamma = impulse(o, basis_.work.slack[o]);
    // an infinite bound is never reached, also where an infeasible problem drives impulses to overflow
    const auto to = gamma <= k.lo[o] && k.lo[o] > -infinity  ? ActiveSet::at_lower
                    : gamma >= k.hi[o] && k.hi[o] < infinity ? ActiveSet::at_upper
                                                             : ActiveSet::active;
    if ((to == ActiveSet::active) != (basis_.set.state[o] == ActiveSet::active))
      flips[count++] = {o, to};
    else if (to != ActiveSet::active)
      basis_.rest(o, to);
  }
  return {flips, count};
}

/// The minimum of f on point + t · step. f' is continuous, increasing and linear between the bounds of rows: Newton's method on it,
/// kept within the interval that holds the root, ends on the exact piece after a few passes over the rows.
double Proximal::search(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  const double *x = basis_.work.point.data(), *d = basis_.work.step.data(), *slack = basis_.work.slack.data();
  double* slope = basis_.work.slope.data();
  double linear = 0, quadratic = 0;  // of the smooth part: dᵀ(M v − k) + dᵀΣu, dᵀM d + dᵀΣd
  for (std::int32_t p = island.first; p < island.last; ++p) {
    const bool row = pattern.is_row(p);
    if (row && !coupled_) continue;
    const double sign = row ? -1 : 1;  // K holds −Σ
    const double delta = row ? 0 : k.factored[p] - k.diagonal[p];
    linear += sign * d[p] * (k.diagonal[p] * x[p] + delta * (x[p] - basis_.work.center[p]) - (row ? 0 : k.b[p]));
    quadratic += sign * d[p] * (k.diagonal[p] + delta) * d[p];
    for (std::int32_t t = pattern.lower_pointers[p]; t < pattern.lower_pointers[p + 1]; ++t) {
      const std::int32_t q = pattern.lower_rows[t];
      if (pattern.is_row(q) != row) continue;
      linear += sign * k.lower[t] * (d[p] * x[q] + d[q] * x[p]);
      quadratic += sign * k.lower[t] * 2 * d[p] * d[q];
    }
  }
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::int32_t p = pattern.row_position[o];
    double s = coupled_ ? k.diagonal[p] * d[p] : 0.0;
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) s += k.row[t] * d[pattern.row_columns[t]];
    slope[o] = s;
  }
  double low = 0, high = infinity, t = 1;
  constexpr int most_passes = 60;
  for (int pass = 0; pass < most_passes; ++pass) {
    double f = linear + quadratic * t, g = quadratic;
    for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
      if (basis_.set.state[o] == ActiveSet::disabled || !(k.a[o] > 0)) continue;
      const double gamma = impulse(o, slack[o] + t * slope[o]);
      f -= gamma * slope[o];
      if (gamma > k.lo[o] && gamma < k.hi[o])
        g += slope[o] * slope[o] / (epsilon_ * k.a[o] + (coupled_ ? 0.0 : -k.diagonal[basis_.position(o)]));
    }
    counts_.work += island.last_row - island.first_row;
    (f < 0 ? low : high) = t;
    double next = g > 0 ? t - f / g : f < 0 ? 2 * t : 0.5 * t;
    if (std::abs(next - t) <= 1e-10 * t) return next;
    if (!(next > low && next < high)) next = high < infinity ? 0.5 * (low + high) : 2 * t;
    t = next;
  }
  return t;
}

double Proximal::descend(const Island& island) {
  newton_point(island);
  auto point = slice(basis_.work.point.data(), island.first, island.last);
  auto step = slice(basis_.work.step.data(), island.first, island.last);
  step = slice(basis_.set.x.data(), island.first, island.last) - point;
  const double t = search(island);
  point += t * step;
  find_slacks(island);
  counts_.work += 2 * (basis_.pattern->row_pointers[island.last_row] - basis_.pattern->row_pointers[island.first_row]);
  return t;
}

double Proximal::recenter(const Island& island) {
  double moved = 0;
  double *center = basis_.work.center.data(), *x = basis_.set.x.data();
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (basis_.set.state[o] == ActiveSet::disabled || !(basis_.values.a[o] > 0)) continue;
    const std::int32_t p = basis_.position(o);
    const double gamma = impulse(o, basis_.work.slack[o]);
    moved = std::max(moved, std::abs(gamma + center[p]) * basis_.values.root_a[o]);
    basis_.work.point[p] = -gamma;
  }
  slice(center, island.first, island.last) = slice(basis_.work.point.data(), island.first, island.last);
  slice(x, island.first, island.last) = slice(basis_.work.point.data(), island.first, island.last);
  return moved;
}

}  // namespace mlcp
