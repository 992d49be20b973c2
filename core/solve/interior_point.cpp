#include "solve/interior_point.h"

#include <algorithm>
#include <cmath>

#include "memory/slice.h"

namespace mlcp {
namespace {

constexpr int most_steps = 60;
/// So many steps, one after the other, that leave more than half of what rows miss: there may be no feasible point, or it is much further away than the start.
constexpr int patience = 8;
constexpr double to_the_boundary = 0.995;
/// Of the size that slacks have in the beginning: rows that miss by more may contradict each other.
constexpr double feasible = 1e-8;
/// Of aᵢ, added to the compliance of every row: a proximal term around the point of each step, so that dependent rows do no harm and nothing is biased. Rows
/// miss by as much as impulses move, times itself; those that start far away move far.
constexpr double proximal = 1e-9, proximal_of_far = 1e-13;
/// Impulses and slacks start at least this far inside, relative to their mean size.
constexpr double inside = 0.1, far_inside = 100;

}  // namespace

/// The other rows rest: they are disabled, nothing can move them, or their bounds are equal.
bool InteriorPoint::live(std::int32_t o) const { return basis_.set.state[o] == ActiveSet::active; }

/// Mean of (γ − lo) s and (hi − γ) t.
double InteriorPoint::gap(const Island& island) const {
  const KktValues& k = basis_.values;
  double sum = 0;
  std::int32_t count = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (!live(o)) continue;
    const double gamma = basis_.gamma(o);
    if (k.lo[o] > -infinity) sum += (gamma - k.lo[o]) * basis_.work.slack[o], ++count;
    if (k.hi[o] < infinity) sum += (k.hi[o] - gamma) * basis_.work.slope[o], ++count;
  }
  return count > 0 ? sum / count : 0;
}

bool InteriorPoint::start(const Island& island, double delta, bool far) {
  delta_ = delta;
  proximal_ = far ? proximal_of_far : proximal;
  const KktValues& k = basis_.values;
  ActiveSet& set = basis_.set;
  slacks(island, *basis_.pattern, k, set.x.data(), set.w.data());
  double size = 0;
  std::int32_t count = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (set.state[o] == ActiveSet::disabled || !(k.a[o] > 0) || k.lo[o] == k.hi[o]) continue;
    set.state[o] = ActiveSet::active;
    size += basis_.gamma(o) * basis_.gamma(o) * k.a[o] + set.w[o] * set.w[o] / k.a[o];
    ++count;
  }
  const double margin = count > 0 ? (far ? far_inside : inside) * std::sqrt(size / count) : 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (!live(o)) continue;
    const double root = k.root_a[o], apart = std::min(margin / root, 0.25 * (k.hi[o] - k.lo[o]));
    double gamma = basis_.gamma(o);
    gamma = gamma < k.lo[o] + apart ? k.lo[o] + apart : gamma > k.hi[o] - apart ? k.hi[o] - apart : gamma;
    set.x[basis_.position(o)] = -gamma;
    basis_.work.slack[o] = k.lo[o] > -infinity ? std::max(set.w[o], margin * root) : 0;
    basis_.work.slope[o] = k.hi[o] < infinity ? std::max(-set.w[o], margin * root) : 0;
  }
  first_gap_ = gap_ = gap(island);
  margin_ = margin > 0 ? (far ? inside / far_inside : 1) * margin : 1;
  find_residual(island);
  return std::isfinite(first_gap_);
}

bool InteriorPoint::factorize(const Island& island) {
  KktValues& k = basis_.values;
  k.regularise(*basis_.pattern, island, proximal_, delta_);
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (!live(o)) continue;
    const double gamma = basis_.gamma(o);
    if (k.lo[o] > -infinity) k.factored[basis_.position(o)] -= basis_.work.slack[o] / (gamma - k.lo[o]);
    if (k.hi[o] < infinity) k.factored[basis_.position(o)] -= basis_.work.slope[o] / (k.hi[o] - gamma);
  }
  return basis_.refactorize(island, 0, counts_);
}

/// work.point := b − K x, and by how much rows are not what their slacks say, in units of the margin that they started with. Steps of exact arithmetic
/// would leave 1 − their length of it; the proximal term leaves more where impulses grow without bounds, as they do if there is no solution.
void InteriorPoint::find_residual(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  const double* x = basis_.set.x.data();
  double* residual = basis_.work.point.data();
  for (std::int32_t p = island.first; p < island.last; ++p) residual[p] = k.b[p] - k.diagonal[p] * x[p];
  for (std::int32_t p = island.first; p < island.last; ++p)
    for (std::int32_t t = pattern.lower_pointers[p]; t < pattern.lower_pointers[p + 1]; ++t) {
      const std::int32_t q = pattern.lower_rows[t];
      residual[p] -= k.lower[t] * x[q];
      residual[q] -= k.lower[t] * x[p];
    }
  counts_.work += 2 * (pattern.lower_pointers[island.last] - pattern.lower_pointers[island.first]);
  infeasibility_ = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (!live(o)) continue;
    const double missing = std::abs(residual[basis_.position(o)] + basis_.work.slack[o] - basis_.work.slope[o]) / (margin_ * k.root_a[o]);
    infeasibility_ = missing <= infeasibility_ ? infeasibility_ : missing;  // keeps NaN
  }
}

/// What (γ − lo) s or (hi − γ) t is to become, over the distance from the bound: µ, the second time less the product of the first steps.
double InteriorPoint::aim(std::int32_t o, double target, bool second, bool upper) const {
  const double gamma = basis_.gamma(o), sign = upper ? -1 : 1;
  const double distance = upper ? basis_.values.hi[o] - gamma : gamma - basis_.values.lo[o], s = upper ? basis_.work.slope[o] : basis_.work.slack[o];
  if (!second) return target / distance;
  const double dy = -sign * basis_.work.step[basis_.position(o)], ds = -s - s / distance * dy;
  return (target - dy * ds) / distance;
}

/// The step of the slack that goes with a step dγ.
double InteriorPoint::slack_step(std::int32_t o, double dgamma, double target, bool second, bool upper) const {
  const double gamma = basis_.gamma(o), sign = upper ? -1 : 1;
  const double distance = upper ? basis_.values.hi[o] - gamma : gamma - basis_.values.lo[o], s = upper ? basis_.work.slope[o] : basis_.work.slack[o];
  return aim(o, target, second, upper) - s - s / distance * sign * dgamma;
}

/// The step towards (γ − lo) s = target, into work.step, or the second time, with the products of the first one made up for, into work.rhs:
///     M dv − Jᵀdγ = k − M v + Jᵀγ,   J dv + (Σ + s/(γ − lo) + t/(hi − γ)) dγ = −w + aim − aim of the upper bound
void InteriorPoint::solve(const Island& island, double target, bool second) {
  const KktValues& k = basis_.values;
  double* rhs = second ? basis_.work.rhs.data() : basis_.work.step.data();
  slice(rhs, island.first, island.last) = slice(basis_.work.point.data(), island.first, island.last);
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    double& r = rhs[basis_.position(o)];
    if (!live(o)) {
      r = 0;
      continue;
    }
    if (k.lo[o] > -infinity) r += aim(o, target, second, false);
    if (k.hi[o] < infinity) r -= aim(o, target, second, true);
  }
  basis_.factor.solve(island, rhs, counts_.work);
}

/// How far the step can go, at most 1.
double InteriorPoint::length(const Island& island, const double* step, double target, bool second) const {
  const KktValues& k = basis_.values;
  double t = 1;
  const auto keep_positive = [&](double y, double dy) {
    if (dy < 0 && y + t * dy < 0) t = -y / dy;
  };
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (!live(o)) continue;
    const double gamma = basis_.gamma(o), d = -step[basis_.position(o)];
    if (k.lo[o] > -infinity) {
      keep_positive(gamma - k.lo[o], d);
      keep_positive(basis_.work.slack[o], slack_step(o, d, target, second, false));
    }
    if (k.hi[o] < infinity) {
      keep_positive(k.hi[o] - gamma, -d);
      keep_positive(basis_.work.slope[o], slack_step(o, d, target, second, true));
    }
  }
  return t;
}

/// gap() after the first step, of that length.
double InteriorPoint::gap_after(const Island& island, double t) const {
  const KktValues& k = basis_.values;
  double sum = 0;
  std::int32_t count = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (!live(o)) continue;
    const double gamma = basis_.gamma(o), d = -basis_.work.step[basis_.position(o)];
    if (k.lo[o] > -infinity) sum += (gamma + t * d - k.lo[o]) * (basis_.work.slack[o] + t * slack_step(o, d, 0, false, false)), ++count;
    if (k.hi[o] < infinity) sum += (k.hi[o] - gamma - t * d) * (basis_.work.slope[o] + t * slack_step(o, d, 0, false, true)), ++count;
  }
  return count > 0 ? sum / count : 0;
}

void InteriorPoint::move(const Island& island, double t, double target) {
  const KktValues& k = basis_.values;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (!live(o)) continue;
    const double d = -basis_.work.rhs[basis_.position(o)];
    const double ds = k.lo[o] > -infinity ? slack_step(o, d, target, true, false) : 0, dt = k.hi[o] < infinity ? slack_step(o, d, target, true, true) : 0;
    basis_.work.slack[o] += t * ds;
    basis_.work.slope[o] += t * dt;
  }
  slice(basis_.set.x.data(), island.first, island.last) += t * slice(basis_.work.rhs.data(), island.first, island.last);
}

void InteriorPoint::settle(const Island& island) {
  const KktValues& k = basis_.values;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (!live(o)) continue;
    const double gamma = basis_.gamma(o), a = k.a[o];
    if (k.lo[o] > -infinity && basis_.work.slack[o] > a * (gamma - k.lo[o]))
      basis_.rest(o, ActiveSet::at_lower);
    else if (k.hi[o] < infinity && basis_.work.slope[o] > a * (k.hi[o] - gamma))
      basis_.rest(o, ActiveSet::at_upper);
  }
}

bool InteriorPoint::reduce(const Island& island, double part) {
  const auto reached = [&] { return gap_ <= part * first_gap_ && infeasibility_ <= feasible; };
  double halved = infeasibility_;  // when it was last half of what it had been
  for (int step = 0, left = patience; step < most_steps && left > 0 && !reached(); ++step) {
    stopped_ = limits_.check(counts_, 0);
    if (stopped_ != MLCP_SOLVED) return false;
    if (!factorize(island)) return false;
    solve(island, 0, false);
    const double t = length(island, basis_.work.step.data(), 0, false);
    const double ratio = gap_after(island, t) / gap_, target = ratio * ratio * ratio * gap_;
    solve(island, target, true);
    const double whole = std::min(1.0, to_the_boundary * length(island, basis_.work.rhs.data(), target, true));
    move(island, whole, target);
    gap_ = gap(island);
    find_residual(island);
    ++counts_.pivots;
    if (!std::isfinite(gap_)) return false;
    const bool nearer = infeasibility_ <= std::max(0.5 * halved, feasible);
    left = nearer ? patience : left - 1;
    if (nearer) halved = infeasibility_;
  }
  settle(island);
  return reached();
}

}  // namespace mlcp
