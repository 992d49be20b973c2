#pragma once
#include <span>

#include "assemble/mask.h"
#include "assemble/problem.h"
#include "solve/settings.h"

namespace mlcp {

/// What a solve is about; none of it changes while it runs.
struct SolveInput {
  const Problem& problem;
  const Mask* enabled;  ///< NULL: every row
  const Settings& settings;
  double contradiction = 0;  ///< backward errors up to this, of rows that depend on each other, may stay: what tries to remove them costs most
  /// Rows with the same number, not negative, are generators of one contact, whose error is relative to the largest of them: one that the motion of the
  /// others holds at 0 has a scale of its own that is rounding. Empty: each row for itself.
  std::span<const std::int32_t> contact_of_row = {};

  /// The solve is one step of an iteration on friction: rows that depend on each other share their load, since one that rests in a step and
  /// carries all of it in the next keeps the iteration from settling.
  bool follows_shifts = false;
};

}  // namespace mlcp
