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

ActiveSet::State ActiveSet::starting(const Problem& problem, std::int32_t row, const Mask* mask) {
  const double lo = problem.lo[row], hi = problem.hi[row];
  const State rests = resting(lo, hi);
  if (rests == out || (mask ? mask->state[row] == MLCP_ROW_ACTIVE && lo < hi : lo < 0 && hi > 0)) return active;
  return mask && mask->state[row] == MLCP_ROW_AT_UPPER && hi < infinity ? at_upper : rests;
}

void ActiveSet::start(const Problem& problem, const KktPattern& pattern, const KktValues& values, const Mask* enabled,
                      const Mask* mask) {
  for (std::int32_t o = 0; o < pattern.rows(); ++o) {
    const std::int32_t p = pattern.row_position[o], i = pattern.node[p] - problem.n();
    const double lo = values.lo[o], hi = values.hi[o];
    const State s = enabled && enabled->state[i] == MLCP_ROW_DISABLED ? disabled : starting(problem, i, mask);
    state[o] = s;
    deferred[o] = 0;
    x[p] = s == active && mask && !mask->impulse.empty() ? -mask->impulse[i] : resting_x(s, lo, hi);
  }
}

bool ActiveSet::violated(std::int32_t o) const {
  switch (state[o]) {
    case at_lower: return w[o] < -tolerance[o];
    case at_upper: return w[o] > tolerance[o];
    case out: return std::abs(w[o]) > tolerance[o];
    default: return false;
  }
}

mlcp_row_state row_state(std::uint8_t state) {
  switch (state) {
    case ActiveSet::at_lower: return MLCP_ROW_AT_LOWER;
    case ActiveSet::at_upper: return MLCP_ROW_AT_UPPER;
    case ActiveSet::disabled: return MLCP_ROW_DISABLED;
    default: return MLCP_ROW_ACTIVE;
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
    set.tolerance[o] = relative * scale;
  }
  values.largest_together(island, [&](std::int32_t o) -> double& { return set.tolerance[o]; });
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if (set.deferred[o] || values.lo[o] == values.hi[o]) set.tolerance[o] = infinity;
}

}  // namespace mlcp
