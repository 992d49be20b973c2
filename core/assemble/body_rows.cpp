#include "assemble/body_rows.h"

#include "assemble/bodies.h"
#include "assemble/rows.h"
#include "assemble/validate.h"

namespace mlcp {

Numbers BodySide::block(std::int64_t i, std::int64_t before, std::int32_t dimension) const {
  const std::ptrdiff_t size = jacobian.size();
  const std::ptrdiff_t offset =
      packed ? before * size : i / body.group * jacobian.stride + i % body.group * dimension * size;
  Numbers at = jacobian;
  at.data = static_cast<const char*>(jacobian.data) + offset;
  at.stride = size;
  return at;
}

namespace {

/// mlcp_rows or mlcp_rows_f32: the same fields in another precision.
template <class Rows>
BodyRows body_rows(const Rows& rows) {
  return {rows.count,
          body_side("body_a", "jacobian_a", rows.body_a, rows.body_stride, rows.jacobian_a, rows.jacobian_a_stride),
          body_side("body_b", "jacobian_b", rows.body_b, rows.body_stride, rows.jacobian_b, rows.jacobian_b_stride),
          {numbers(rows.r, 0, rows.value_stride), numbers(rows.lo, 0, rows.value_stride),
           numbers(rows.hi, infinity, rows.value_stride), numbers(rows.compliance, 0, rows.value_stride),
           integers(rows.key, std::uint64_t(0), rows.key_stride)}};
}

/// Returns the number of entries of row i on this side.
std::int32_t check_side(const Problem& problem, const BodySide& side, std::int32_t i, std::int64_t before) {
  const std::int32_t id = side.body[i];
  if (id == MLCP_WORLD) return 0;
  const std::int32_t d = body_at(problem, id, side.body_name, i / side.body.group).dimension;
  if (!side.jacobian.data)
    throw Error(MLCP_ERROR_NULL, "%s is NULL, but %s[%d] = %d is not the world", side.jacobian_name, side.body_name, i / side.body.group, id);
  const Numbers block = side.block(i, before, d);
  for (std::int32_t e = 0; e < d; ++e)
    if (!std::isfinite(block[e]))
      throw Error(MLCP_ERROR_ARGUMENT, "%s of row %d: number %d = %g is not finite", side.jacobian_name, i, e, block[e]);
  return d;
}

/// before: checked and reserved. Returns the number of entries.
std::int32_t append_side(Problem& problem, const BodySide& side, std::int32_t i, std::int64_t before) {
  const std::int32_t id = side.body[i];
  if (id == MLCP_WORLD) return 0;
  const Body& body = problem.bodies[id];
  const Numbers block = side.block(i, before, body.dimension);
  for (std::int32_t e = 0; e < body.dimension; ++e) {
    problem.jacobian.indices.push_back(body.offset + e);
    problem.jacobian.values.push_back(block[e]);
  }
  return body.dimension;
}

}  // namespace

std::int32_t body_rows_add(Problem& problem, const BodyRows& rows) {
  std::int64_t before_a = 0, before_b = 0;
  for (std::int32_t i = 0; i < rows.count; ++i) {
    const std::int32_t entries_a = check_side(problem, rows.a, i, before_a), entries_b = check_side(problem, rows.b, i, before_b);
    if (rows.a.body[i] == rows.b.body[i] && rows.a.body[i] != MLCP_WORLD)
      throw Error(MLCP_ERROR_ARGUMENT, "body_b[%d] = %d is body_a[%d] too", i / rows.b.body.group, rows.b.body[i], i / rows.a.body.group);
    check_fields(rows.fields, i, entries_a + entries_b > 0);
    before_a += entries_a;
    before_b += entries_b;
  }
  reserve_rows(problem, rows.count, before_a + before_b);

  const std::int32_t first = problem.m();
  before_a = before_b = 0;
  for (std::int32_t i = 0; i < rows.count; ++i) {
    before_a += append_side(problem, rows.a, i, before_a);
    before_b += append_side(problem, rows.b, i, before_b);
    problem.jacobian.pointers.push_back(static_cast<std::int32_t>(problem.jacobian.values.size()));
  }
  append_fields(problem, rows.fields, rows.count);
  return first;
}

std::int32_t rows_add(Problem& problem, const mlcp_rows& rows) {
  check_count("count", rows.count);
  return body_rows_add(problem, body_rows(rows));
}
std::int32_t rows_add(Problem& problem, const mlcp_rows_f32& rows) {
  check_count("count", rows.count);
  return body_rows_add(problem, body_rows(rows));
}

}  // namespace mlcp
