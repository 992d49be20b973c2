#include "solve/basis.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include "memory/slice.h"

namespace mlcp {
namespace {

/// A point whose backward error is above this after refinement stands on a factor that has drifted.
constexpr double drifted = 1e-13;
/// Worse than this, even on a fresh factor: active rows depend on each other and their pivots are rounding. Larger ones are given up then.
constexpr double unsolved = 1e-10;
/// A refined point worse than this has velocities that ought to be 0 and are rounding: a body at rest under large impulses.
constexpr double off = 1e-13;
/// What making them 0 may cost, and what counts as such.
constexpr double stilled = 1e-14, rounding = 16 * 2.2e-16;

}  // namespace

void Basis::prepare(const Problem& problem, const Analysis& analysis, const Settings& settings) {
  settings_ = &settings;
  pattern = &analysis.pattern;
  values.load(problem, *pattern);
  set.prepare(*pattern);
  factor.prepare(*pattern, analysis.symbolic, values);
  refinement.prepare(pattern->size());
  response.prepare(analysis.parts, *pattern);
  work.prepare(*pattern);
  factor_work_.resize(pattern->size());
  toggled_.resize(pattern->size());
}

/// Entries of row o, of J and Σ, are not what they were.
bool Basis::row_moves(const Problem& problem, std::int32_t o) const {
  const std::int32_t p = position(o), s = pattern->diagonal_source[p];
  if (values.diagonal[p] != (s < 0 ? 0.0 : -problem.compliance.values[s])) return true;
  for (std::int32_t t = pattern->row_pointers[o]; t < pattern->row_pointers[o + 1]; ++t) {
    const std::int32_t e = pattern->row_source[t];
    if (values.row[t] != (pattern->is_row(pattern->row_columns[t]) ? -problem.compliance.values[e] : problem.jacobian.values[e])) return true;
  }
  return false;
}

void Basis::reload(const Problem& problem, std::span<std::uint8_t> changed, std::span<double> epsilon, Counts& counts) {
  const auto& islands = factor.symbolic().islands;
  for (std::size_t s = 0; s < islands.size(); ++s) {
    changed[s] = 0;
    for (std::int32_t o = islands[s].first_row; o < islands[s].last_row; ++o) {
      if (!row_moves(problem, o)) continue;
      changed[s] = 1;
      if (epsilon[s] < 0 || !factor.in(position(o))) continue;
      rest(o, ActiveSet::resting(values.lo[o], values.hi[o]));
      if (factor.remove(position(o), counts.work) != FactorStatus::ok) epsilon[s] = -1;
      count_toggle(islands[s], counts);
    }
  }
  // b, bounds: those of before stand in scratch of the methods
  std::copy(values.b.begin(), values.b.end(), work.rhs.begin());
  std::copy(values.lo.begin(), values.lo.end(), work.slack.begin());
  std::copy(values.hi.begin(), values.hi.end(), work.slope.begin());
  values.load(problem, *pattern);
  for (std::size_t s = 0; s < islands.size(); ++s) {
    const Island& island = islands[s];
    for (std::int32_t o = island.first_row; o < island.last_row && !changed[s]; ++o)
      changed[s] = values.b[position(o)] != work.rhs[position(o)] || values.lo[o] != work.slack[o] || values.hi[o] != work.slope[o];
    if (epsilon[s] > 0) values.regularise(*pattern, island, epsilon[s], 0);
  }
}

void Basis::rest(std::int32_t o, ActiveSet::State to) {
  set.state[o] = to;
  set.x[position(o)] = ActiveSet::resting_x(to, values.lo[o], values.hi[o]);
}

bool Basis::refactorize(const Island& island, double drop, Counts& counts) {
  const auto begin = std::chrono::steady_clock::now();
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    set.wanted[position(o)] = set.state[o] == ActiveSet::active;
  const std::int64_t before = counts.work;
  const FactorStatus status = factor.factorize(island, set.wanted.data(), drop, counts.work);
  factor_work_[island.first] = counts.work - before;
  toggled_[island.first] = 0;
  ++counts.factorizations;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if (set.state[o] == ActiveSet::active && !factor.in(position(o))) rest(o, ActiveSet::resting(values.lo[o], values.hi[o]));
  counts.seconds_factorize += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return status == FactorStatus::ok;
}

void Basis::count_toggle(const Island& island, Counts& counts) {
  ++counts.toggles;
  ++toggled_[island.first];
}

bool Basis::activate(const Island& island, std::int32_t o, Counts& counts) {
  set.state[o] = ActiveSet::active;
  if (settings_->refactorize == MLCP_REFACTORIZE_ALWAYS || factor.insert(position(o), counts.work) != FactorStatus::ok)
    refactorize(island, lost_pivot, counts);
  else
    count_toggle(island, counts);
  return set.state[o] == ActiveSet::active;
}

void Basis::deactivate(const Island& island, std::int32_t o, ActiveSet::State to, Counts& counts) {
  rest(o, to);
  if (settings_->refactorize == MLCP_REFACTORIZE_ALWAYS || factor.remove(position(o), counts.work) != FactorStatus::ok)
    refactorize(island, lost_pivot, counts);
  else
    count_toggle(island, counts);
}

std::int32_t Basis::change(const Island& island, std::span<const Flip> flips, double drop, Counts& counts) {
  const Symbolic& symbolic = factor.symbolic();
  std::int64_t toggles = 0;  // upper bound of the entries that toggling touches
  for (const Flip& f : flips)
    if ((f.to == ActiveSet::active) != (set.state[f.o] == ActiveSet::active)) toggles += symbolic.path_entries[position(f.o)];
  bool fresh = settings_->refactorize == MLCP_REFACTORIZE_ALWAYS || toggles > factor_work_[island.first];
  // rows leave before others come in: the factor is never nearer to singular than at the end
  for (const Flip& f : flips) {
    const bool in = set.state[f.o] == ActiveSet::active;
    if (f.to == ActiveSet::active) continue;
    rest(f.o, static_cast<ActiveSet::State>(f.to));
    if (fresh || !in) continue;
    fresh = factor.remove(position(f.o), counts.work) != FactorStatus::ok;
    count_toggle(island, counts);
  }
  for (const Flip& f : flips) {
    if (f.to != ActiveSet::active || set.state[f.o] == ActiveSet::active) continue;
    const auto back = static_cast<ActiveSet::State>(set.state[f.o]);
    set.state[f.o] = ActiveSet::active;
    if (fresh) continue;
    const FactorStatus status = factor.insert(position(f.o), counts.work, drop);
    if (status == FactorStatus::dependent) rest(f.o, back);
    fresh = status == FactorStatus::small_pivot;
    count_toggle(island, counts);
  }
  if (fresh) refactorize(island, drop, counts);
  std::int32_t refused = 0;
  for (const Flip& f : flips) refused += f.to == ActiveSet::active && set.state[f.o] != ActiveSet::active;
  return refused;
}

bool Basis::check(const Island& island) const {
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if ((set.state[o] == ActiveSet::active) != factor.in(position(o))) return false;
  return true;
}

void Basis::look_at_slacks(const Island& island, Counts& counts) {
  slacks(island, *pattern, values, set.x.data(), set.w.data());
  slack_tolerances(island, *pattern, values, zero(), set);
  counts.work += 2 * (pattern->row_pointers[island.last_row] - pattern->row_pointers[island.first_row]);
}

std::int32_t Basis::violations(const Island& island) const {
  std::int32_t count = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) count += set.violated(o);
  return count;
}

/// Velocities whose momentum |Mⱼⱼ vⱼ| is a few roundings of its own terms, or, widely, of the largest of the island, become 0. So do, widely, impulses √a γ that are
/// a few roundings of the largest, or of what a right-hand side asks for: alone on a velocity without mass they are all there is of its momentum.
/// returns whether one has changed.
bool Basis::still(const Island& island, bool widely) {
  double largest = 0;
  for (std::int32_t p = island.first; p < island.last; ++p)
    if (!pattern->is_row(p)) largest = std::max(largest, refinement.scale(p));
  bool changed = false;
  for (std::int32_t p = island.first; p < island.last; ++p) {
    if (pattern->is_row(p) || set.x[p] == 0 || values.diagonal[p] == 0 || std::abs(values.diagonal[p] * set.x[p]) > rounding * (widely ? largest : refinement.scale(p))) continue;
    set.x[p] = 0;
    changed = true;
  }
  if (!widely) return changed;
  double most = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) most = std::max({most, values.root_a[o] * std::abs(gamma(o)), values.size[position(o)] / values.root_a[o]});
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const double size = values.root_a[o] * std::abs(gamma(o));
    if (set.state[o] != ActiveSet::active || size == 0 || size > rounding * most) continue;
    set.x[position(o)] = 0;
    changed = true;
  }
  return changed;
}

double Basis::refine(const Island& island, Counts& counts, bool from_x) {
  double error = refinement.solve(island, *pattern, values, factor, values.b.data(), values.size.data(), set.x.data(),
                                  counts.refinements, counts.work, from_x);
  look_at_slacks(island, counts);
  std::int32_t wrong = violations(island);
  auto point = slice(work.point.data(), island.first, island.last);
  auto x = slice(set.x.data(), island.first, island.last);
  for (const bool widely : {false, true}) {
    if (error <= off && wrong == 0) break;
    point = x;
    if (!still(island, widely)) continue;
    const double now = refinement.error(island, *pattern, values, factor, values.b.data(), values.size.data(), set.x.data(), counts.work);
    look_at_slacks(island, counts);
    const std::int32_t now_wrong = violations(island);
    if (now <= std::max(error, stilled) && now_wrong <= wrong) {
      error = now;
      wrong = now_wrong;
    } else {
      x = point;
      look_at_slacks(island, counts);
    }
  }
  return error;
}

void Basis::solve_point(const Island& island, Counts& counts) {
  assert(check(island));
  // a direction that overflowed may have left its mark on rows at rest
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if (set.state[o] != ActiveSet::active) rest(o, static_cast<ActiveSet::State>(set.state[o]));
  double error = refine(island, counts);
  if (!(error <= drifted) && toggled_[island.first] > 0) {
    ++counts.drifts;
    refactorize(island, lost_pivot, counts);
    error = refine(island, counts);
  }
  for (double drop = 100 * lost_pivot; !(error <= unsolved) && drop <= dependent_pivot; drop *= 100) {
    refactorize(island, drop, counts);
    error = refine(island, counts);
  }
}

}  // namespace mlcp
