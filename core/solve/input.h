#pragma once
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
};

}  // namespace mlcp
