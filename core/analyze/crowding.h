#pragma once
#include "analyze/selection.h"

namespace mlcp {

/// What is crowded: see Crowding.
bool too_many(std::int64_t rows, std::int64_t velocities);

/// Islands with clearly more rows than velocities, and not just a few. There the active rows depend on each other, the proximal method adds ε to every
/// row, and K is quasi-definite: pivots exist in any order (Vanderbei 1995), and the one that fills least eliminates most rows before the
/// velocities that they touch. Elsewhere rows come after their velocities and no ε is needed.
struct Crowding {
  Array<std::uint8_t> crowded;  ///< by node; all 0 if `exact`
  explicit Crowding(const Memory& m) : crowded(m), parent_(m), velocities_(m), rows_(m) {}

  /// exact: the pivoting method is to run, which needs rows after velocities.
  /// cost: nearly O(entries of M, J and Σ).
  void find(const Problem& problem, const Selection& selection, bool exact);
  bool any() const { return any_; }

 private:
  bool any_ = false;
  Array<std::int32_t> parent_, velocities_, rows_;
};

}  // namespace mlcp
