#include "assemble/bodies.h"
#include "assemble/compliance.h"
#include "assemble/contacts.h"
#include "assemble/layout.h"
#include "assemble/rows.h"
#include "assemble/validate.h"
#include "assemble/values.h"
#include "report/bytes.h"
#include "report/snapshot_payload.h"

namespace mlcp {

namespace {

/// Numbers on their way from the bytes to the calls that check them.
struct Scratch {
  Array<std::int32_t> pointers, indices;
  Array<double> values;
  explicit Scratch(const Memory& memory) : pointers(memory), indices(memory), values(memory) {}
};

/// Rows that stand for one row of a contact inside, at most.
constexpr std::int32_t most_rows_inside = 6;

/// What is being read, for the text of an error.
struct Place {
  const char* section = "settings";
  std::int32_t body = -1;
};

/// One of the two values that a byte may have.
bool read_flag(ByteReader& from) {
  const std::uint8_t flag = from.u8();
  if (flag > 1) throw Error(MLCP_ERROR_FORMAT, "a flag is %d", flag);
  return flag == 1;
}

void read_settings(ByteReader& from, std::uint32_t version, Settings& settings) {
  settings.method = from.i32();
  settings.pivot_rule = from.i32();
  settings.refactorize = from.i32();
  settings.trace = from.i32();
  settings.tolerance = from.f64();
  settings.max_iterations = from.i64();
  settings.max_work = from.i64();
  settings.max_seconds = from.f64();
  if (version >= 2) {
    settings.impulses = from.i32();
    settings.canonical = from.i32();
    settings.warm_start = from.i32();
    settings.num_threads = from.i32();
    settings.facets = from.i32();
    settings.max_shifts = from.i32();
  }
  check_settings(settings);
}

/// Pointers, indices and values of a matrix with `outer` compressed columns (rows).
void read_matrix(ByteReader& from, std::size_t outer, Scratch& to) {
  const std::int32_t entries = from.count(sizeof(std::int32_t) + sizeof(double));
  from.i32s(outer + 1, to.pointers);
  if (to.pointers.back() != entries)
    throw Error(MLCP_ERROR_FORMAT, "a matrix has %d entries, not %d", to.pointers.back(), entries);
  from.i32s(entries, to.indices);
  from.f64s(entries, to.values);
}

std::int32_t read_mass(ByteReader& from, std::int32_t dimension, std::uint8_t kind, Scratch& scratch, Problem& problem) {
  if (kind > 1 + MLCP_UPPER) throw Error(MLCP_ERROR_FORMAT, "a mass is stored in way %d", kind);
  std::int32_t id = 0;
  if (kind > 0) {
    read_matrix(from, dimension, scratch);
    return body_add_sparse(problem, dimension, scratch.pointers.data(), scratch.indices.data(), scratch.values.data(), kind - 1);
  }
  from.f64s(std::size_t(dimension) * dimension, scratch.values);
  bodies_add(problem, 1, dimension, scratch.values.data(), 0, &id);
  return id;
}

void read_bodies(const Memory& memory, ByteReader& from, Scratch& scratch, Problem& problem, Place& place) {
  const std::int32_t count = from.count(sizeof(std::int32_t));
  Array<std::uint8_t> used(memory);
  used.assign(count, 0);
  for (std::int32_t i = 0; i < count; ++i) {
    place = {"body", i};
    const std::int32_t dimension = from.i32();
    if (dimension == 0) continue;
    check_count("dimension", dimension);
    used[i] = 1;
    const std::uint8_t kind = from.u8();
    const bool prescribed = read_flag(from);
    const std::int32_t id = read_mass(from, dimension, kind, scratch, problem);
    if (!prescribed) continue;
    from.f64s(dimension, scratch.values);
    body_set_prescribed(problem, id, scratch.values.data(), dimension);
  }
  if (count > 0 && !used.back()) throw Error(MLCP_ERROR_FORMAT, "it is free, but the last one");
  spread_ids(problem, used.span());
  place = {"momentum"};
  from.f64s(problem.n(), scratch.values);
  set_momentum(problem, 0, problem.n(), scratch.values.data());
}

void read_rows(const Memory& memory, ByteReader& from, Scratch& scratch, Problem& problem) {
  const std::int32_t m = from.count(4 * sizeof(double));
  Array<double> r(memory), lo(memory), hi(memory);
  Array<std::uint64_t> key(memory);
  for (Array<double>* a : {&r, &lo, &hi}) from.f64s(m, *a);
  from.u64s(m, key);
  read_matrix(from, m, scratch);
  rows_add_csr(problem, m, scratch.pointers.data(), scratch.indices.data(), scratch.values.data(),
               {r.data(), lo.data(), hi.data(), nullptr, key.data()});
  read_matrix(from, m, scratch);
  set_compliance_matrix(problem, {m, scratch.pointers.data(), scratch.indices.data(), scratch.values.data(), MLCP_FULL});
}

/// Declaring contacts sets the bounds of their tangents; those of MLCP_FRICTION_BOX were read with the rows and come back after it.
void read_contacts(const Memory& memory, ByteReader& from, Problem& problem) {
  const std::int32_t count = from.count(4 * sizeof(std::int32_t) + sizeof(double));
  Array<std::int32_t> row(memory), dimension(memory), facets(memory);
  Array<mlcp_friction> model(memory);
  Array<double> mu(memory), lo(problem.lo), hi(problem.hi);
  for (std::int32_t c = 0; c < count; ++c) {
    row.push_back(from.i32());
    dimension.push_back(from.i32());
    model.push_back(from.i32());
    facets.push_back(from.i32());
    mu.push_back(from.f64());
  }
  for (std::int32_t first = 0, last = 0; first < count; first = last) {
    while (last < count && dimension[last] == dimension[first]) ++last;
    contacts_declare(problem, last - first, dimension[first], row.data() + first,
                     {model.data() + first, mu.data() + first, nullptr, facets.data() + first});
  }
  for (const Contact& c : problem.contacts)
    if (c.model == MLCP_FRICTION_BOX) rows_set_bounds(problem, c.row + 1, c.dimension - 1, &lo[c.row + 1], &hi[c.row + 1]);
  const std::int32_t couplings = from.count(2 * sizeof(std::int32_t));
  for (std::int32_t c = 0; c < couplings; ++c) {
    const std::int32_t coupled = from.i32(), normal = from.i32();
    rows_set_findex(problem, coupled, 1, &normal);
  }
}

bool read_mask(ByteReader& from, std::uint32_t version, std::int32_t rows, Mask& mask) {
  if (!read_flag(from)) return false;
  const bool keyed = read_flag(from), moved = version >= 2 && read_flag(from);
  const auto states = from.bytes(rows);
  mask_resize(mask, rows, MLCP_ROW_DISABLED);
  mask_set(mask, 0, rows, states.data());
  if (keyed) from.u64s(rows, mask.key);
  if (moved) {
    from.f64s(rows, mask.impulse);
    check_finite("impulses", mask.impulse.data(), rows);
  }
  if (version >= 2 && read_flag(from)) {
    from.f64s(rows, mask.slip);
    check_finite("slip", mask.slip.data(), rows);
  }
  return true;
}

/// Each index once; whether it is an order for the pattern, the next analysis tells.
void read_ordering(ByteReader& from, Problem& problem, Array<std::int32_t>& ordering) {
  const std::int64_t size = problem.n() + std::int64_t(problem.m()) * (problem.contacts.empty() ? 1 : most_rows_inside);
  from.i32s(from.count(sizeof(std::int32_t)), ordering);
  problem.work.marker.start(size);
  for (std::int32_t i : ordering)
    if (i < 0 || i >= size || !problem.work.marker.insert(i)) throw Error(MLCP_ERROR_FORMAT, "the ordering is none: %d", i);
}

void read_sections(const Memory& memory, ByteReader& from, std::uint32_t version, Snapshot& out, Place& place) {
  Scratch scratch(memory);
  read_settings(from, version, out.settings);
  place = {"bodies"};
  read_bodies(memory, from, scratch, out.problem, place);
  place = {"rows"};
  read_rows(memory, from, scratch, out.problem);
  place = {"contacts"};
  if (version >= 2) read_contacts(memory, from, out.problem);
  place = {"enabled mask"};
  out.has_enabled = read_mask(from, version, out.problem.m(), out.enabled);
  place = {"start mask"};
  out.has_start = read_mask(from, version, out.problem.m(), out.start);
  place = {"ordering"};
  read_ordering(from, out.problem, out.ordering);
  place = {"end"};
  if (from.left() > 0) throw Error(MLCP_ERROR_FORMAT, "%zu bytes are left", from.left());
}

}  // namespace

void read_payload(const Memory& memory, std::span<const std::uint8_t> payload, std::uint32_t version, Snapshot& out) {
  ByteReader from(payload);
  Place place;
  try {
    read_sections(memory, from, version, out, place);
  } catch (const Error& e) {
    char body[16] = "";
    if (place.body >= 0) std::snprintf(body, sizeof body, " %d", place.body);
    throw Error(MLCP_ERROR_FORMAT, "the snapshot is not legal: %s%s, at byte %zu unpacked: %s", place.section, body,
                from.offset(), e.text);
  }
}

}  // namespace mlcp
