#include "analyze/analysis.h"

#include <algorithm>
#include <cassert>

#include "analyze/check_analysis.h"

namespace mlcp {

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

void Analysis::run(const Problem& problem, const Mask* enabled, bool exact, std::span<const std::int32_t> imposed, const Poll& poll) {
  done_ = false;
  exact_ = exact;
  selection.take(problem, enabled);
  crowding.find(problem, selection, exact);
  try {
    if (imposed.empty() || !ordering.accept(problem, selection, crowding, imposed)) ordering.compute(problem, selection, crowding, poll);
    build(problem, poll);
  } catch (const Stopped&) {
    ordering.clear();
    build(problem, {});
    throw;
  }
  assert(check_analysis(*this));
  remembered_.take(problem);
  done_ = true;
}

/// From the order to everything that follows from it.
void Analysis::build(const Problem& problem, const Poll& poll) {
  pattern.build(problem, ordering.order.span());
  tree.build(pattern);
  tree.postorder(sequence_);
  for (std::int32_t& p : sequence_) p = pattern.node[p];
  if (!std::ranges::equal(sequence_, ordering.order)) {
    ordering.order.assign(sequence_.span());
    pattern.build(problem, ordering.order.span());
    tree.build(pattern);
  }
  symbolic.build(pattern, tree, crowding, poll);
  parts.build(pattern);
}

}  // namespace mlcp
