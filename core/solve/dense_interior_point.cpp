#include "solve/dense_interior_point.h"

#include <algorithm>
#include <cmath>

#include "memory/slice.h"

namespace mlcp {
namespace {

constexpr int most_steps = 40;
constexpr double to_the_boundary = 0.995;
/// Of the first gap: what the path is followed down to.
constexpr double reduced_gap = 1e-17;
/// Added to the compliance of every row, around the point of each step, so that dependent rows do no harm: this part of the gap, in units of the margin,
/// but within these parts of aᵢ. It lets rows miss by as much as impulses move, times itself; slacks that are to tell rows apart, of stacked boxes with
/// rounded data 1e-10 of what others have, would be lost in that if it did not fall with the gap.
constexpr double proximal = 1e-3, most_proximal = 1e-9, least_proximal = 1e-13;
/// Impulses and slacks start at least this far inside, relative to their mean size.
constexpr double inside = 1;
/// Of aᵢ, on active rows.
constexpr double sharp_epsilon = 1e-8;
/// Rows that the active set of the path has wrong are few, but those that replace them may be wrong too.
constexpr int most_rounds = 6;
constexpr int most_refinements = 5;
/// Rounding of a slack, relative to its terms.
constexpr double rounding = 1e-15;

}  // namespace

void DenseInteriorPoint::rest(std::int32_t i, ActiveSet::State to) {
  s_.state[i] = to;
  s_.gamma[i] = -ActiveSet::resting_x(to, s_.lo[i], s_.hi[i]);
}

void DenseInteriorPoint::take(const Problem& problem, const Mask& start) {
  for (std::int32_t i = 0; i < s_.m; ++i) {
    rest(i, ActiveSet::starting(problem, s_.row[i], &start));
    if (s_.state[i] == ActiveSet::active) s_.gamma[i] = start.impulse[s_.row[i]];
  }
}

/// The softest problem that says anything of all rows: v and γ of M v − Jᵀγ = k, J v + (Σ + a) γ = r.
bool DenseInteriorPoint::first_point() {
  for (std::int32_t i = 0; i < s_.padded_rows(); ++i) {
    const bool live = i < s_.m && movable(i);
    if (i < s_.m) rest(i, ActiveSet::resting(s_.lo[i], s_.hi[i]));
    if (live) s_.state[i] = ActiveSet::active, s_.gamma[i] = 0;
    s_.weight[i] = live ? 1 / (s_.sigma[i] + s_.a[i]) : 0;
  }
  std::fill(s_.v, s_.v + s_.padded_velocities(), 0.0);
  if (!NormalEquations::factor(s_)) return false;
  ++counts_.factorizations;
  NormalEquations::residuals(s_);
  const std::int32_t rows = s_.padded_rows();
  slice(s_.dgamma, 0, rows) = -slice(s_.w, 0, rows);
  NormalEquations::solve(s_);
  slice(s_.v, 0, s_.padded_velocities()) += slice(s_.step, 0, s_.padded_velocities());
  slice(s_.gamma, 0, rows) += slice(s_.dgamma, 0, rows);
  NormalEquations::residuals(s_);
  return true;
}

/// Impulses and slacks are put inside.
void DenseInteriorPoint::centre() {
  double size = 0;
  std::int32_t count = 0;
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (s_.state[i] != ActiveSet::active) continue;
    size += s_.gamma[i] * s_.gamma[i] * s_.a[i] + s_.w[i] * s_.w[i] / s_.a[i];
    ++count;
  }
  const double margin = count > 0 ? inside * std::sqrt(size / count) : 0;
  margin_ = margin > 0 ? margin : 1;
  pairs_ = 0;
  for (std::int32_t i = 0; i < s_.padded_rows(); ++i) {
    s_.slack[i] = s_.slope[i] = 0;
    if (i >= s_.m || s_.state[i] != ActiveSet::active) continue;
    const double lo = s_.lo[i], hi = s_.hi[i], root = std::sqrt(s_.a[i]), apart = std::min(margin / root, 0.25 * (hi - lo));
    s_.gamma[i] = s_.gamma[i] < lo + apart ? lo + apart : s_.gamma[i] > hi - apart ? hi - apart : s_.gamma[i];
    if (lo > -infinity) s_.slack[i] = std::max(s_.w[i], margin * root), ++pairs_;
    if (hi < infinity) s_.slope[i] = std::max(-s_.w[i], margin * root), ++pairs_;
  }
}

/// over := 1/(γ − lo), under := 1/(hi − γ); 0 where there is no bound, and on rows that rest.
void DenseInteriorPoint::find_distances() {
  const std::int32_t m = s_.padded_rows();
  slice(s_.over, 0, m) = (slice(s_.slack, 0, m) > 0).select(1 / (slice(s_.gamma, 0, m) - slice(s_.lo, 0, m)), 0);
  slice(s_.under, 0, m) = (slice(s_.slope, 0, m) > 0).select(1 / (slice(s_.hi, 0, m) - slice(s_.gamma, 0, m)), 0);
}

/// Mean of (γ − lo) s and (hi − γ) t.
double DenseInteriorPoint::gap() const {
  double sum = 0;
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (s_.slack[i] > 0) sum += (s_.gamma[i] - s_.lo[i]) * s_.slack[i];
    if (s_.slope[i] > 0) sum += (s_.hi[i] - s_.gamma[i]) * s_.slope[i];
  }
  return pairs_ > 0 ? sum / pairs_ : 0;
}

/// How far the step (dgamma, change of slack, other of slope) can go, at most 1.
double DenseInteriorPoint::length() const {
  double t = 1;
  const auto keep_positive = [&](double y, double dy) {
    if (y + t * dy < 0) t = -y / dy;
  };
  for (std::int32_t i = 0; i < s_.m; ++i) {
    const double d = s_.dgamma[i];
    if (s_.slack[i] > 0) {
      keep_positive(s_.gamma[i] - s_.lo[i], d);
      keep_positive(s_.slack[i], s_.change[i]);
    }
    if (s_.slope[i] > 0) {
      keep_positive(s_.hi[i] - s_.gamma[i], -d);
      keep_positive(s_.slope[i], s_.other[i]);
    }
  }
  return t;
}

/// Mehrotra's two steps, in the notation of InteriorPoint: with D = Σ + s/(γ − lo) + t/(hi − γ) = W⁻¹,
///     M dv − Jᵀdγ = k − M v + Jᵀγ,   J dv + D dγ = −w + aim − aim of the upper bound,
///     ds = aim − s − s/(γ − lo) dγ,  aim = target/(γ − lo), the second time less the product of the first steps; likewise dt.
bool DenseInteriorPoint::step() {
  const std::int32_t m = s_.padded_rows();
  const auto slack = slice(s_.slack, 0, m), slope = slice(s_.slope, 0, m), over = slice(s_.over, 0, m), under = slice(s_.under, 0, m);
  const auto w = slice(s_.w, 0, m), a = slice(s_.a, 0, m), sigma = slice(s_.sigma, 0, m);
  auto weight = slice(s_.weight, 0, m), dgamma = slice(s_.dgamma, 0, m), change = slice(s_.change, 0, m), other = slice(s_.other, 0, m);
  find_distances();
  const double epsilon = std::clamp(proximal * gap_ / (margin_ * margin_), least_proximal, most_proximal);
  weight = (weight > 0).select(1 / (sigma + epsilon * a + slack * over + slope * under), 0);
  if (!NormalEquations::factor(s_)) return false;
  ++counts_.factorizations;
  dgamma = -w;
  NormalEquations::solve(s_);
  change = -slack - slack * over * dgamma;
  other = -slope + slope * under * dgamma;
  const double t = length();
  double after = 0;
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (s_.slack[i] > 0) after += (s_.gamma[i] + t * s_.dgamma[i] - s_.lo[i]) * (s_.slack[i] + t * s_.change[i]);
    if (s_.slope[i] > 0) after += (s_.hi[i] - s_.gamma[i] - t * s_.dgamma[i]) * (s_.slope[i] + t * s_.other[i]);
  }
  const double ratio = pairs_ > 0 ? after / pairs_ / gap_ : 0, target = ratio * ratio * ratio * gap_;
  change = (target - dgamma * change) * over;
  other = (target + dgamma * other) * under;
  dgamma = -w + change - other;
  NormalEquations::solve(s_);
  change += -slack - slack * over * dgamma;
  other += -slope + slope * under * dgamma;
  const double whole = std::min(1.0, to_the_boundary * length());
  slice(s_.slack, 0, m) += whole * change;
  slice(s_.slope, 0, m) += whole * other;
  slice(s_.gamma, 0, m) += whole * dgamma;
  slice(s_.v, 0, s_.padded_velocities()) += whole * slice(s_.step, 0, s_.padded_velocities());
  ++counts_.pivots;
  return true;
}

/// Until the gap has fallen; rows may still miss, where there is no feasible point, which polish() finds.  false: it does not fall.
bool DenseInteriorPoint::reduce() {
  const double first = gap_ = gap();
  for (int steps = 0;; ++steps) {
    NormalEquations::residuals(s_);
    if (gap_ <= reduced_gap * first) return true;
    if (steps == most_steps || !std::isfinite(gap_) || watch_.look() != MLCP_SOLVED || !step()) return false;
    gap_ = gap();
  }
}

/// Rows are active where γ is further from its bounds than the slack from 0.
void DenseInteriorPoint::settle() {
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (s_.slack[i] > s_.a[i] * (s_.gamma[i] - s_.lo[i]))
      rest(i, ActiveSet::at_lower);
    else if (s_.slope[i] > s_.a[i] * (s_.hi[i] - s_.gamma[i]))
      rest(i, ActiveSet::at_upper);
  }
}

bool DenseInteriorPoint::factor_active() {
  for (std::int32_t i = 0; i < s_.padded_rows(); ++i)
    s_.weight[i] = i < s_.m && s_.state[i] == ActiveSet::active && s_.a[i] > 0 ? 1 / (s_.sigma[i] + sharp_epsilon * s_.a[i]) : 0;
  ++counts_.factorizations;
  return NormalEquations::factor(s_);
}

double DenseInteriorPoint::error_of_active() const {
  double error = 0;
  for (std::int32_t i = 0; i < s_.m; ++i)
    if (s_.weight[i] > 0 && s_.w[i] != 0) error = std::max(error, std::abs(s_.w[i]) / NormalEquations::terms(s_, i));
  return error;
}

/// The point of the active set, as far as refinement gets; residuals are those of the point that is left.
void DenseInteriorPoint::refine() {
  const std::int32_t m = s_.padded_rows();
  NormalEquations::residuals(s_);
  double before = infinity;
  for (int round = 0; round < most_refinements; ++round) {
    slice(s_.dgamma, 0, m) = -slice(s_.w, 0, m);
    NormalEquations::solve(s_);
    slice(s_.v, 0, s_.padded_velocities()) += slice(s_.step, 0, s_.padded_velocities());
    slice(s_.gamma, 0, m) += slice(s_.dgamma, 0, m);
    NormalEquations::residuals(s_);
    ++counts_.refinements;
    const double error = error_of_active();
    if (round > 0 && (error <= rounding || error > 0.5 * before)) return;  // the first one may leave more of the momentum than of the rows
    before = error;
  }
}

/// Rows whose state does not fit change it.  returns how many.
std::int32_t DenseInteriorPoint::flip() {
  std::int32_t flips = 0;
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (s_.state[i] == ActiveSet::active) {
      if (s_.gamma[i] >= s_.lo[i] && s_.gamma[i] <= s_.hi[i]) continue;
      rest(i, s_.gamma[i] < s_.lo[i] ? ActiveSet::at_lower : ActiveSet::at_upper);
    } else {
      if (!movable(i)) continue;  // what no impulse can change is for the measurement to judge
      const double against = s_.state[i] == ActiveSet::at_lower ? -s_.w[i] : s_.state[i] == ActiveSet::at_upper ? s_.w[i] : std::abs(s_.w[i]);
      if (against <= 0 || against <= zero_ * NormalEquations::terms(s_, i)) continue;
      s_.state[i] = ActiveSet::active;
    }
    ++flips;
  }
  return flips;
}

/// false: rows change sides without end.
bool DenseInteriorPoint::polish() {
  for (int round = 0; round < most_rounds; ++round) {
    if (watch_.look() != MLCP_SOLVED || !factor_active()) return false;
    refine();
    if (flip() == 0) return true;
  }
  return false;
}

bool DenseInteriorPoint::solve(const Problem& problem, const Mask* start) {
  if (start && !start->impulse.empty()) {
    take(problem, *start);
    std::fill(s_.v, s_.v + s_.padded_velocities(), 0.0);
    if (polish()) return true;
  }
  if (!first_point()) return false;
  centre();
  if (!reduce()) return false;
  settle();
  return polish();
}

}  // namespace mlcp
