#include "report/bytes.h"
#include "report/snapshot_payload.h"

namespace mlcp {

namespace {

std::span<const double> part(const Array<double>& a, std::int32_t first, std::int32_t count) {
  return a.span().subspan(first, count);
}

void write_settings(const Settings& settings, ByteWriter& to) {
  to.i32(settings.method);
  to.i32(settings.pivot_rule);
  to.i32(settings.refactorize);
  to.i32(settings.trace);
  to.f64(settings.tolerance);
  to.i64(settings.max_iterations);
  to.i64(settings.max_work);
  to.f64(settings.max_seconds);
  to.i32(settings.impulses);
  to.i32(settings.canonical);
  to.i32(settings.warm_start);
  to.i32(settings.num_threads);
  to.i32(settings.facets);
  to.i32(settings.max_shifts);
}

/// The mass as it was given. The caller's entries stand first in every column, in his order.
void write_sparse_mass(const Problem& problem, const Body& body, std::int32_t id, ByteWriter& to) {
  const std::int32_t first = problem.mass.pointers[body.offset];
  const std::int64_t slot = problem.mass_slot_start[id];
  const auto entries = body.diagonal ? body.dimension : static_cast<std::int32_t>((problem.mass_slot_start[id + 1] - slot) / 2);
  const auto position = [&](std::int32_t e) { return body.diagonal ? e : problem.mass_slot[slot + 2 * std::int64_t(e)]; };
  to.u32(entries);
  to.i32(0);
  for (std::int32_t j = 0, e = 0; j < body.dimension; ++j) {
    while (e < entries && position(e) < problem.mass.pointers[body.offset + j + 1] - first) ++e;
    to.i32(e);
  }
  for (std::int32_t e = 0; e < entries; ++e) to.i32(problem.mass.indices[first + position(e)] - body.offset);
  for (std::int32_t e = 0; e < entries; ++e) to.f64(problem.mass.values[first + position(e)]);
}

void write_bodies(const Problem& problem, ByteWriter& to) {
  const auto count = static_cast<std::int32_t>(problem.bodies.size());
  to.u32(count);
  for (std::int32_t id = 0; id < count; ++id) {
    const Body& body = problem.bodies[id];
    to.i32(body.dimension);
    if (body.dimension == 0) continue;
    to.u8(static_cast<std::uint8_t>(body.sparse));
    to.u8(static_cast<std::uint8_t>(body.prescribed));
    if (body.sparse)
      write_sparse_mass(problem, body, id, to);
    else
      to.f64s(part(problem.mass.values, problem.mass.pointers[body.offset], body.dimension * body.dimension));
    if (body.prescribed) to.f64s(part(problem.given_velocity, body.offset, body.dimension));
  }
  to.f64s(problem.momentum.span());
}

void write_matrix(const SparseArrays& a, ByteWriter& to) {
  to.u32(static_cast<std::uint32_t>(a.values.size()));
  to.i32s(a.pointers.span());
  to.i32s(a.indices.span());
  to.f64s(a.values.span());
}

void write_rows(const Problem& problem, ByteWriter& to) {
  to.u32(problem.m());
  for (const Array<double>* a : {&problem.r, &problem.lo, &problem.hi}) to.f64s(a->span());
  to.u64s(problem.key.span());
  write_matrix(problem.jacobian, to);
  write_matrix(problem.compliance, to);
}

void write_contacts(const Problem& problem, ByteWriter& to) {
  to.u32(static_cast<std::uint32_t>(problem.contacts.size()));
  for (const Contact& c : problem.contacts) {
    to.i32(c.row);
    to.i32(c.dimension);
    to.i32(c.model);
    to.i32(c.facets);
    to.f64(c.mu);
  }
  to.u32(static_cast<std::uint32_t>(problem.couplings.size()));
  for (const Coupling& c : problem.couplings) {
    to.i32(c.row);
    to.i32(c.normal);
  }
}

void write_mask(const Mask* mask, ByteWriter& to) {
  to.u8(mask ? 1 : 0);
  if (!mask) return;
  to.u8(mask->key.empty() ? 0 : 1);
  to.u8(mask->impulse.empty() ? 0 : 1);
  to.bytes(mask->state.span());
  to.u64s(mask->key.span());
  to.f64s(mask->impulse.span());
  to.u8(mask->slip.empty() ? 0 : 1);
  to.f64s(mask->slip.span());
}

/// With contacts the order is that of the rows inside, which are more.
bool fits(std::span<const std::int32_t> ordering, const Problem& problem) {
  return !problem.contacts.empty() ||
         std::all_of(ordering.begin(), ordering.end(), [&](std::int32_t i) { return i < problem.n() + problem.m(); });
}

}  // namespace

void write_payload(const SnapshotSource& source, Array<std::uint8_t>& out) {
  ByteWriter to(out);
  write_settings(source.settings, to);
  write_bodies(source.problem, to);
  write_rows(source.problem, to);
  write_contacts(source.problem, to);
  write_mask(source.enabled, to);
  write_mask(source.start, to);
  const auto ordering = fits(source.ordering, source.problem) ? source.ordering : std::span<const std::int32_t>{};
  to.u32(static_cast<std::uint32_t>(ordering.size()));
  to.i32s(ordering);
}

}  // namespace mlcp
