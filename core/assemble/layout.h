#pragma once
#include "assemble/problem.h"

/// Where bodies stand in v, k and M. Velocities are ordered by body id, so a body at a reused id moves those behind it.
namespace mlcp {

/// What every new body brings: velocities, entries of M, entries of mass_slot.
struct BodyShape {
  std::int32_t dimension;
  std::int64_t entries, slots;
};

/// work.index: the ids that `count` new bodies get, ascending: free ones first, then new ones.
/// cost: O(count), with free ids O(ids).
void choose_ids(Problem& problem, std::int32_t count);

/// Makes room for bodies at the ids in work.index.
/// after: k = 0, given velocity 0; mass.pointers of a new body's first column set, the rest of its mass for the caller to fill.
/// fails: Error (RANGE), bad_alloc; nothing changed.
/// cost:  O(count); with reused ids O(n + entries of M and J).
void open_bodies(Problem& problem, const BodyShape& shape);

/// before: no row refers to the body.      cost: O(n + entries of M and J).
void close_body(Problem& problem, std::int32_t body);

/// Gives bodies 0, 1, … the ids at which used[id] ≠ 0, ascending.
/// before: as many bodies as there are such ids, no id free; the last id is used.
void spread_ids(Problem& problem, std::span<const std::uint8_t> used);

}  // namespace mlcp
