#include "analyze/analysis.h"

#include <cassert>

#include "analyze/check_analysis.h"

namespace mlcp {
namespace {

bool same(const Array<std::int32_t>& a, const Array<std::int32_t>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

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
  return same(mass_pointers_, problem.mass.pointers) && same(mass_indices_, problem.mass.indices) &&
         same(jacobian_pointers_, problem.jacobian.pointers) && same(jacobian_indices_, problem.jacobian.indices) &&
         same(sigma_pointers_, problem.compliance.pointers) && same(sigma_indices_, problem.compliance.indices);
}

void Analysis::remember(const Problem& problem) {
  mass_pointers_.assign(problem.mass.pointers.span());
  mass_indices_.assign(problem.mass.indices.span());
  jacobian_pointers_.assign(problem.jacobian.pointers.span());
  jacobian_indices_.assign(problem.jacobian.indices.span());
  sigma_pointers_.assign(problem.compliance.pointers.span());
  sigma_indices_.assign(problem.compliance.indices.span());
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
  remember(problem);
  done_ = true;
}

/// From the order to everything that follows from it.
void Analysis::build(const Problem& problem, const Poll& poll) {
  pattern.build(problem, ordering.order.span());
  tree.build(pattern);
  tree.postorder(sequence_);
  for (std::int32_t& p : sequence_) p = pattern.node[p];
  if (!same(sequence_, ordering.order)) {
    ordering.order.assign(sequence_.span());
    pattern.build(problem, ordering.order.span());
    tree.build(pattern);
  }
  symbolic.build(pattern, tree, crowding, poll);
  parts.build(pattern);
}

}  // namespace mlcp
