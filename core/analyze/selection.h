#pragma once
#include "assemble/mask.h"
#include "assemble/problem.h"

namespace mlcp {

/// The part of a problem that is solved for: velocities of dynamic bodies and enabled rows.
/// A node is a velocity j (node j) or a row i (node n + i).
struct Selection {
  Array<std::uint8_t> velocity;  ///< n: 1 if dynamic
  Array<std::uint8_t> row;       ///< m: 1 if enabled
  explicit Selection(const Memory& memory) : velocity(memory), row(memory) {}

  void take(const Problem& problem, const Mask* enabled);
  bool has(std::int32_t node) const {
    const auto n = static_cast<std::int32_t>(velocity.size());
    return node < n ? velocity[node] != 0 : row[node - n] != 0;
  }
};

}  // namespace mlcp
