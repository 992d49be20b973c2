#include "assemble/storage.h"

#include "assemble/validate.h"

namespace mlcp {

namespace {

void trim(SparseArrays& a) {
  a.pointers.trim();
  a.indices.trim();
  a.values.trim();
}

void clear(SparseArrays& a) {
  a.pointers.resize(1);
  a.indices.clear();
  a.values.clear();
}

void trim(EditWorkspace& work) {
  work.marker.trim();
  for (Array<std::int32_t>* a : {&work.index, &work.slot}) {
    a->clear();
    a->trim();
  }
  work.value.clear();
  work.value.trim();
  for (SparseArrays* a : {&work.expanded, &work.sorted}) {
    clear(*a);
    trim(*a);
  }
}

}  // namespace

void reserve(Problem& problem, std::int32_t bodies, std::int32_t velocities, std::int32_t rows, std::int64_t entries) {
  check_count("bodies", bodies);
  check_count("velocities", velocities);
  check_count("rows", rows);
  check_count("entries", entries);
  check_index_space(velocities, rows);
  check_entries("J", entries);
  const std::int64_t mean = bodies > 0 ? (std::int64_t(velocities) + bodies - 1) / bodies : 0;
  const std::int64_t dimension = std::clamp<std::int64_t>(mean, 6, 64);
  const std::int64_t mass_entries = std::min<std::int64_t>(velocities * dimension, std::numeric_limits<std::int32_t>::max());
  problem.bodies.reserve(bodies);
  problem.mass_slot_start.reserve(std::size_t(bodies) + 1);
  problem.body_of.reserve(velocities);
  problem.momentum.reserve(velocities);
  problem.given_velocity.reserve(velocities);
  problem.mass.pointers.reserve(std::size_t(velocities) + 1);
  problem.mass.indices.reserve(mass_entries);
  problem.mass.values.reserve(mass_entries);
  problem.jacobian.pointers.reserve(std::size_t(rows) + 1);
  problem.jacobian.indices.reserve(entries);
  problem.jacobian.values.reserve(entries);
  problem.compliance.pointers.reserve(std::size_t(rows) + 1);
  problem.compliance.indices.reserve(rows);
  problem.compliance.values.reserve(rows);
  problem.diagonal.reserve(rows);
  problem.r.reserve(rows);
  problem.lo.reserve(rows);
  problem.hi.reserve(rows);
  problem.key.reserve(rows);
  problem.contacts.reserve(rows / 2);
  problem.work.marker.reserve(std::max(velocities, rows));
  problem.work.index.reserve(std::max(bodies, rows));
  if (bodies > 0) problem.work.value.reserve(std::max<std::int64_t>(velocities, 2 * dimension * dimension));
}

void trim(Problem& problem) {
  trim(problem.mass);
  trim(problem.jacobian);
  trim(problem.compliance);
  for (Array<std::int32_t>* a : {&problem.body_of, &problem.mass_slot, &problem.diagonal}) a->trim();
  for (Array<double>* a : {&problem.momentum, &problem.given_velocity, &problem.r, &problem.lo, &problem.hi}) a->trim();
  problem.bodies.trim();
  problem.mass_slot_start.trim();
  problem.key.trim();
  problem.contacts.trim();
  problem.couplings.trim();
  trim(problem.work);
}

void clear(Problem& problem) {
  for (SparseArrays* a : {&problem.mass, &problem.jacobian, &problem.compliance}) clear(*a);
  for (Array<std::int32_t>* a : {&problem.body_of, &problem.mass_slot, &problem.diagonal}) a->clear();
  for (Array<double>* a : {&problem.momentum, &problem.given_velocity, &problem.r, &problem.lo, &problem.hi}) a->clear();
  problem.bodies.clear();
  problem.mass_slot_start.resize(1);
  problem.key.clear();
  problem.contacts.clear();
  problem.couplings.clear();
  problem.free_ids = 0;
}

}  // namespace mlcp
