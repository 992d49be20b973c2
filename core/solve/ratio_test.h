#pragma once
#include "solve/basis.h"

namespace mlcp {

/// Where the solution goes when the impulse of the entering row p moves by `sign`: x + t · Workspace::step, w + t · Workspace::slope.
struct Direction {
  double sign = 1;
  double schur = 0;        ///< of the entering row, relative to its a
  bool dependent = false;  ///< the entering row depends on active ones: v does not move, w stays
};

/// The paper's Calcola_step_max.
struct Step {
  double length = infinity;             ///< change of the entering impulse
  std::int32_t blocking = -1;           ///< ordinal; the entering one: it has arrived; −1: nothing blocks
  ActiveSet::State to = ActiveSet::active;  ///< where the blocking row goes
};

/// The longest step that keeps every impulse within its bounds and, by the printed rule, every satisfied row satisfied. Only rows that are
/// satisfied block (Baraff 1994); ties go to the least row index of the caller, so that zero steps cannot cycle.
Step ratio_test(const Island& island, const Basis& basis, const Direction& direction, std::int32_t entering, mlcp_pivot_rule rule);

}  // namespace mlcp
