#pragma once
#include "handles.h"
#include "report/snapshot.h"

namespace mlcp {

/// What a solve with these handles depends on; solver, enabled and start may be NULL.
inline SnapshotSource source_of(const Problem& problem, const mlcp_solver* solver, const Settings& defaults, const mlcp_mask* enabled,
                                const mlcp_mask* start) {
  const Mask* carried = solver ? solver->solver.found_start(problem) : nullptr;
  return {problem, solver ? solver->solver.settings() : defaults,
          solver ? solver->solver.ordering() : std::span<const int32_t>{}, mask_of(enabled), start ? &start->mask : carried};
}

}  // namespace mlcp
