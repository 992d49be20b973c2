#include "analyze/analysis.h"

#include <algorithm>
#include <cassert>

#include "analyze/check_analysis.h"

namespace mlcp {
namespace {

/// A carried order is kept while it has no more entries than this, times those of a new one.
constexpr double more_fill = 1.1;
/// So many more are no matter.
constexpr std::int64_t few_entries = 500;
constexpr std::int32_t longest_pause = 32;

}  // namespace

bool Analysis::covers(const Problem& problem, const Mask* enabled, bool exact) const {
  if (!done_ || exact != exact_ || selection.velocity.size() != problem.momentum.size() || selection.row.size() != problem.r.size()) return false;
  for (std::int32_t j = 0; j < problem.n(); ++j)
    if (static_cast<bool>(selection.velocity[j]) == problem.prescribed(j)) return false;
  std::int32_t analyzed = 0, used = 0;
  for (std::int32_t i = 0; i < problem.m(); ++i) {
    const bool on = !enabled || enabled->state[i] != MLCP_ROW_DISABLED;
    if (on && !selection.row[i]) return false;
    analyzed += selection.row[i];
    used += on;
  }
  if (used < analyzed - analyzed / 4) return false;  // disabled rows must not go on costing
  return remembered_.fits(problem);
}

template <class Order>
void Analysis::run_with(const Problem& problem, const Mask* enabled, bool exact, Order order) {
  done_ = false;
  exact_ = exact;
  selection.take(problem, enabled);
  crowding.find(problem, selection, exact);
  try {
    order();
  } catch (const Stopped&) {
    ordering.clear();
    build(problem, {});
    throw;
  }
  assert(check_analysis(*this));
  remembered_.take(problem);
  done_ = true;
}

void Analysis::run(const Problem& problem, const Mask* enabled, bool exact, std::span<const std::int32_t> imposed, const Poll& poll) {
  run_with(problem, enabled, exact, [&] {
    if (imposed.empty() || !ordering.accept(problem, selection, crowding, imposed)) ordering.compute(problem, selection, crowding, poll);
    build(problem, poll);
    fresh_entries_ = symbolic.entries();
    fresh_rows_ = pattern.rows();
  });
}

void Analysis::run_again(const Problem& problem, const Mask* enabled, bool exact, const Poll& poll) {
  if (!done_ || exact != exact_ || pause_ > 0) {
    pause_ = std::max(0, pause_ - 1);
    return run(problem, enabled, exact, {}, poll);
  }
  run_with(problem, enabled, exact, [&] {
    ordering.carry(problem, selection, crowding, pattern, tree, poll);
    build(problem, poll);
  });
  if (symbolic.entries() <= allowed_entries()) {
    next_pause_ = 1;
    return;
  }
  pause_ = next_pause_;
  next_pause_ = std::min(2 * next_pause_, longest_pause);
  run(problem, enabled, exact, {}, poll);
}

/// What a new order would have for as many rows, and a little.
std::int64_t Analysis::allowed_entries() const {
  const double rows = pattern.rows(), before = fresh_rows_;
  return static_cast<std::int64_t>(more_fill * static_cast<double>(fresh_entries_) * (before > 0 ? rows / before : 0)) + few_entries;
}

/// From the order to everything that follows from it.
void Analysis::build(const Problem& problem, const Poll& poll) {
  if (crowding.any()) {
    pattern.build(problem, ordering.order.span());
    tree.build(pattern);
  } else {
    tree.build(problem, ordering.order.span());
  }
  tree.postorder(sequence_);
  const bool ordered = std::ranges::is_sorted(sequence_);
  if (!ordered) {
    tree.relabel(sequence_.span());
    for (std::int32_t& p : sequence_) p = ordering.order[p];
    ordering.order.assign(sequence_.span());
  }
  if (!ordered || !crowding.any()) pattern.build(problem, ordering.order.span());
  symbolic.build(pattern, tree, crowding, poll);
  parts.build(pattern);
}

}  // namespace mlcp
