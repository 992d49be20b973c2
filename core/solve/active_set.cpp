#include "solve/active_set.h"

#include <cmath>

namespace mlcp {

void ActiveSet::prepare(const KktPattern& pattern) {
  state.assign(pattern.rows(), at_lower);
  deferred.assign(pattern.rows(), 0);
  w.assign(pattern.rows(), 0.0);
  tolerance.assign(pattern.rows(), 0.0);
  x.assign(pattern.size(), 0.0);
  wanted.assign(pattern.size(), 0);
}

ActiveSet::State ActiveSet::resting(double lo, double hi) {
  return lo > -infinity ? at_lower : hi < infinity ? at_upper : out;
}

double ActiveSet::resting_x(State state, double lo, double hi) {
  return state == at_lower ? -lo : state == at_upper ? -hi : 0.0;
}

ActiveSet::State ActiveSet::asked(const KktValues& values, const Mask* enabled, const Mask* mask, std::int32_t o, std::int32_t i) const {
  const double lo = values.lo[o], hi = values.hi[o];
  const mlcp_row_state in_mask = mask ? mask->state[i] : static_cast<mlcp_row_state>(MLCP_ROW_DISABLED);
  const State s = resting(lo, hi);
  if (enabled && enabled->state[i] == MLCP_ROW_DISABLED) return disabled;
  if (s == out || (in_mask == MLCP_ROW_ACTIVE && lo < hi) || (!mask && lo < 0 && hi > 0)) return active;
  return in_mask == MLCP_ROW_AT_UPPER && hi < infinity ? at_upper : s;
}

void ActiveSet::start(const Problem& problem, const KktPattern& pattern, const KktValues& values, const Mask* enabled,
                      const Mask* mask) {
  for (std::int32_t o = 0; o < pattern.rows(); ++o) {
    const std::int32_t p = pattern.row_position[o], i = pattern.node[p] - problem.n();
    const State s = asked(values, enabled, mask, o, i);
    state[o] = s;
    deferred[o] = 0;
    x[p] = s == active && mask && !mask->impulse.empty() ? -mask->impulse[i] : resting_x(s, values.lo[o], values.hi[o]);
  }
}

void slacks(const Island& island, const KktPattern& pattern, const KktValues& values, const double* x, double* w) {
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::int32_t p = pattern.row_position[o];
    double sum = values.diagonal[p] * x[p] - values.b[p];
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t)
      sum += values.row[t] * x[pattern.row_columns[t]];
    w[o] = sum;
  }
}

void slack_tolerances(const Island& island, const KktPattern& pattern, const KktValues& values, double relative, ActiveSet& set) {
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::int32_t p = pattern.row_position[o];
    double scale = std::abs(values.diagonal[p] * set.x[p]) + values.size[p];
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t)
      scale += std::abs(values.row[t] * set.x[pattern.row_columns[t]]);
    set.tolerance[o] = set.deferred[o] || values.lo[o] == values.hi[o] ? infinity : relative * scale;
  }
}

}  // namespace mlcp
