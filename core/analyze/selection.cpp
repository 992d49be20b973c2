#include "analyze/selection.h"

namespace mlcp {

void Selection::take(const Problem& problem, const Mask* enabled) {
  velocity.resize(problem.n());
  for (std::int32_t j = 0; j < problem.n(); ++j) velocity[j] = !problem.prescribed(j);
  row.assign(problem.m(), 1);
  if (!enabled) return;
  for (std::int32_t i = 0; i < problem.m(); ++i) row[i] = enabled->state[i] != MLCP_ROW_DISABLED;
}

}  // namespace mlcp
