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
};

}  // namespace mlcp
