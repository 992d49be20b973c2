#include "solve/basis.h"

#include <algorithm>
#include <cassert>
#include <chrono>

namespace mlcp {
namespace {

/// A point whose backward error is above this after refinement stands on a factor that has drifted.
constexpr double drifted = 1e-13;
/// Worse than this, even on a fresh factor: active rows depend on each other and their pivots are rounding. Larger ones are given up then.
constexpr double unsolved = 1e-10;

}  // namespace

void Basis::prepare(const Problem& problem, const Analysis& analysis, const Settings& settings) {
  settings_ = &settings;
  pattern = &analysis.pattern;
  values.load(problem, *pattern);
  set.prepare(*pattern);
  factor.prepare(*pattern, analysis.symbolic, values);
  refinement.prepare(pattern->size());
  factor_work_.assign(pattern->rows() + 1, 0);
  toggled_.assign(pattern->rows() + 1, 0);
}

double Basis::zero() const { return std::clamp(settings_->tolerance * 1e-4, 2e-15, 1e-13); }

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
  factor_work_[island.first_row] = counts.work - before;
  toggled_[island.first_row] = 0;
  ++counts.factorizations;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if (set.state[o] == ActiveSet::active && !factor.in(position(o))) rest(o, ActiveSet::resting(values.lo[o], values.hi[o]));
  counts.seconds_factorize += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return status == FactorStatus::ok;
}

void Basis::count_toggle(const Island& island, Counts& counts) {
  ++counts.toggles;
  ++toggled_[island.first_row];
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

void Basis::deactivate_all(const Island& island, std::span<const std::int32_t> rows, Counts& counts) {
  const auto side = [&](std::int32_t o) { return gamma(o) > values.hi[o] ? ActiveSet::at_upper : ActiveSet::at_lower; };
  const Symbolic& symbolic = factor.symbolic();
  std::int64_t toggles = 0;  // upper bound of the entries that toggling touches
  for (const std::int32_t o : rows)
    for (std::int32_t j = position(o); j >= 0; j = symbolic.parent[j]) toggles += symbolic.pointers[j + 1] - symbolic.pointers[j];
  if (toggles <= factor_work_[island.first_row]) {
    for (const std::int32_t o : rows)  // a refactorization on the way may have put some at rest
      if (set.state[o] == ActiveSet::active) deactivate(island, o, side(o), counts);
    return;
  }
  for (const std::int32_t o : rows) rest(o, side(o));
  refactorize(island, lost_pivot, counts);
}

bool Basis::check(const Island& island) const {
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if ((set.state[o] == ActiveSet::active) != factor.in(position(o))) return false;
  return true;
}

void Basis::solve_point(const Island& island, Counts& counts) {
  assert(check(island));
  // a direction that overflowed may have left its mark on rows at rest
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if (set.state[o] != ActiveSet::active) rest(o, static_cast<ActiveSet::State>(set.state[o]));
  const auto refined = [&] {
    return refinement.solve(island, *pattern, values, factor, values.b.data(), values.size.data(), set.x.data(), counts.refinements, counts.work);
  };
  double error = refined();
  if (!(error <= drifted) && toggled_[island.first_row] > 0) {
    ++counts.drifts;
    refactorize(island, lost_pivot, counts);
    error = refined();
  }
  for (double drop = 100 * lost_pivot; !(error <= unsolved) && drop <= dependent_pivot; drop *= 100) {
    refactorize(island, drop, counts);
    error = refined();
  }
  slacks(island, *pattern, values, set.x.data(), set.w.data());
  slack_tolerances(island, *pattern, values, zero(), set);
  counts.work += 2 * (pattern->row_pointers[island.last_row] - pattern->row_pointers[island.first_row]);
}

}  // namespace mlcp
