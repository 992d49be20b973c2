#include "assemble/layout.h"

#include "assemble/validate.h"

namespace mlcp {

namespace {

void check_room(const Problem& problem, std::int64_t count, const BodyShape& shape) {
  check_index_space(problem.n() + count * shape.dimension, problem.m());
  check_entries("M", std::int64_t(problem.mass.values.size()) + count * shape.entries);
  check_entries("M", std::int64_t(problem.mass_slot.size()) + count * shape.slots);
}

void reserve_room(Problem& problem, std::size_t count, const BodyShape& shape) {
  const std::size_t velocities = problem.momentum.size() + count * shape.dimension;
  const std::size_t entries = problem.mass.values.size() + count * shape.entries;
  problem.bodies.reserve(problem.bodies.size() + count);
  problem.mass_slot_start.reserve(problem.bodies.size() + count + 1);
  problem.body_of.reserve(velocities);
  problem.momentum.reserve(velocities);
  problem.given_velocity.reserve(velocities);
  problem.mass.pointers.reserve(velocities + 1);
  problem.mass.indices.reserve(entries);
  problem.mass.values.reserve(entries);
  problem.mass_slot.reserve(problem.mass_slot.size() + count * shape.slots);
  problem.work.marker.reserve(velocities);
}

template <class T>
void move_up(Array<T>& a, std::int64_t first, std::int64_t count, std::int64_t by) {
  if (count > 0 && by > 0) std::memmove(a.data() + first + by, a.data() + first, count * sizeof(T));
}

template <class T>
void erase(Array<T>& a, std::int64_t first, std::int64_t count) {
  const std::int64_t behind = std::int64_t(a.size()) - first - count;
  if (behind > 0 && count > 0) std::memmove(a.data() + first, a.data() + first + count, behind * sizeof(T));
  a.resize(a.size() - count);
}

/// Ends of the runs that are still to be placed, in the new numbering.
struct Ends {
  std::int64_t velocity, entry, slot;
};

/// Moves an old body behind `before` new ones. `end`: of its runs; afterwards their starts.
void move_body(Problem& problem, std::int32_t id, std::int64_t before, const BodyShape& shape, Ends& end) {
  Body& body = problem.bodies[id];
  const std::int64_t by = before * shape.dimension, entry_by = before * shape.entries, slot_by = before * shape.slots;
  auto& [pointers, indices, values] = problem.mass;
  if (body.dimension > 0) {
    const std::int64_t entry_first = pointers[body.offset], entries = end.entry - entry_by - entry_first;
    const std::int64_t slot_first = problem.mass_slot_start[id], slots = end.slot - slot_by - slot_first;
    for (std::int64_t p = entry_first; p < entry_first + entries; ++p) indices[p] += static_cast<std::int32_t>(by);
    move_up(indices, entry_first, entries, entry_by);
    move_up(values, entry_first, entries, entry_by);
    move_up(problem.mass_slot, slot_first, slots, slot_by);
    move_up(problem.momentum, body.offset, body.dimension, by);
    move_up(problem.given_velocity, body.offset, body.dimension, by);
    move_up(problem.body_of, body.offset, body.dimension, by);
    for (std::int64_t c = body.offset + body.dimension; c-- > body.offset;)
      pointers[c + by] = static_cast<std::int32_t>(pointers[c] + entry_by);
    body.offset += static_cast<std::int32_t>(by);
    end = {end.velocity - body.dimension, entry_first + entry_by, slot_first + slot_by};
  }
  problem.mass_slot_start[id] = end.slot;
}

/// The same for a new body.
void put_body(Problem& problem, std::int32_t id, const BodyShape& shape, Ends& end) {
  end = {end.velocity - shape.dimension, end.entry - shape.entries, end.slot - shape.slots};
  problem.bodies[id] = {static_cast<std::int32_t>(end.velocity), shape.dimension, 0, 0};
  problem.mass.pointers[end.velocity] = static_cast<std::int32_t>(end.entry);
  problem.mass_slot_start[id] = end.slot;
  std::fill_n(problem.body_of.data() + end.velocity, shape.dimension, id);
  std::fill_n(problem.momentum.data() + end.velocity, shape.dimension, 0.0);
  std::fill_n(problem.given_velocity.data() + end.velocity, shape.dimension, 0.0);
}

/// Room at the end of every array, and the ends in it. before: reserve_room.
Ends grow(Problem& problem, std::size_t ids, std::int64_t count, const BodyShape& shape) {
  const Ends end{problem.n() + count * shape.dimension, std::int64_t(problem.mass.values.size()) + count * shape.entries,
                 std::int64_t(problem.mass_slot.size()) + count * shape.slots};
  problem.bodies.resize(ids, Body{});
  problem.mass_slot_start.resize(ids + 1, end.slot);
  problem.mass_slot_start[ids] = end.slot;
  problem.body_of.resize(end.velocity);
  problem.momentum.resize(end.velocity);
  problem.given_velocity.resize(end.velocity);
  problem.mass.pointers.resize(end.velocity + 1);
  problem.mass.pointers[end.velocity] = static_cast<std::int32_t>(end.entry);
  problem.mass.indices.resize(end.entry);
  problem.mass.values.resize(end.entry);
  problem.mass_slot.resize(end.slot);
  return end;
}

/// Columns of J, for bodies whose id is above a new one.
void renumber_columns(Problem& problem, std::int32_t dimension) {
  const Array<std::int32_t>& ids = problem.work.index;
  for (std::int32_t& column : problem.jacobian.indices) {
    const std::int32_t body = problem.body_of[column];
    column += dimension * static_cast<std::int32_t>(std::lower_bound(ids.begin(), ids.end(), body) - ids.begin());
  }
}

}  // namespace

void choose_ids(Problem& problem, std::int32_t count) {
  Array<std::int32_t>& ids = problem.work.index;
  ids.resize(count);
  const auto total = static_cast<std::int32_t>(problem.bodies.size());
  std::int32_t chosen = 0;
  if (problem.free_ids > 0)
    for (std::int32_t id = 0; id < total && chosen < count; ++id)
      if (problem.bodies[id].dimension == 0) ids[chosen++] = id;
  for (std::int32_t id = total; chosen < count; ++id) ids[chosen++] = id;
}

void open_bodies(Problem& problem, const BodyShape& shape) {
  const Array<std::int32_t>& ids = problem.work.index;
  auto before = static_cast<std::int64_t>(ids.size());
  if (before == 0) return;
  check_room(problem, before, shape);
  reserve_room(problem, before, shape);
  const auto old_count = static_cast<std::int32_t>(problem.bodies.size()), new_count = std::max(old_count, ids.back() + 1);
  if (ids[0] < old_count) renumber_columns(problem, shape.dimension);
  Ends end = grow(problem, new_count, before, shape);
  // from the last id down to the first new one: what is moved never covers what has still to move
  for (std::int32_t id = new_count - 1; before > 0; --id) {
    if (ids[before - 1] == id) {
      put_body(problem, id, shape, end);
      --before;
      problem.free_ids -= id < old_count;
    } else {
      move_body(problem, id, before, shape, end);
    }
  }
}

void close_body(Problem& problem, std::int32_t id) {
  const std::int32_t first = problem.bodies[id].offset, d = problem.bodies[id].dimension;
  auto& [pointers, indices, values] = problem.mass;
  const std::int32_t entry = pointers[first], entries = pointers[first + d] - entry;
  erase(indices, entry, entries);
  erase(values, entry, entries);
  for (std::size_t p = entry; p < indices.size(); ++p) indices[p] -= d;
  erase(pointers, first, d);
  for (std::size_t j = first; j < pointers.size(); ++j) pointers[j] -= entries;

  const std::int64_t slot = problem.mass_slot_start[id], slots = problem.mass_slot_start[id + 1] - slot;
  erase(problem.mass_slot, slot, slots);
  for (std::size_t b = std::size_t(id) + 1; b < problem.mass_slot_start.size(); ++b) problem.mass_slot_start[b] -= slots;
  erase(problem.momentum, first, d);
  erase(problem.given_velocity, first, d);
  erase(problem.body_of, first, d);
  for (std::int32_t& column : problem.jacobian.indices) column -= column > first ? d : 0;

  problem.bodies[id] = Body{};
  ++problem.free_ids;
  for (std::size_t b = std::size_t(id) + 1; b < problem.bodies.size(); ++b)
    if (problem.bodies[b].dimension > 0) problem.bodies[b].offset -= d;
  while (!problem.bodies.empty() && problem.bodies.back().dimension == 0) {
    problem.bodies.pop_back();
    problem.mass_slot_start.pop_back();
    --problem.free_ids;
  }
}

void spread_ids(Problem& problem, std::span<const std::uint8_t> used) {
  const std::size_t bodies = problem.bodies.size();
  problem.bodies.reserve(used.size());
  problem.mass_slot_start.reserve(used.size() + 1);
  problem.bodies.resize(used.size());
  problem.mass_slot_start.resize(used.size() + 1);
  problem.mass_slot_start[used.size()] = problem.mass_slot_start[bodies];
  std::size_t from = bodies;
  for (std::size_t id = used.size(); id-- > 0;) {
    if (used[id]) {
      const Body body = problem.bodies[--from];
      problem.mass_slot_start[id] = problem.mass_slot_start[from];
      problem.bodies[id] = body;
      std::fill_n(problem.body_of.data() + body.offset, body.dimension, static_cast<std::int32_t>(id));
    } else {
      problem.mass_slot_start[id] = problem.mass_slot_start[id + 1];
      problem.bodies[id] = Body{};
    }
  }
  problem.free_ids = static_cast<std::int32_t>(used.size() - bodies);
}

}  // namespace mlcp
