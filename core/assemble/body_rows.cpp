#include "assemble/bodies.h"
#include "assemble/row_input.h"
#include "assemble/rows.h"
#include "assemble/validate.h"

namespace mlcp {

namespace {

/// Blocks of J on one side, a or b.
struct Side {
  const char *body_name, *jacobian_name;
  Integers<std::int32_t> body;
  Numbers jacobian;
  std::ptrdiff_t number_size;
  bool packed;

  /// The block of row i; `before`: numbers of the rows ahead of it.
  Numbers block(std::int64_t i, std::int64_t before) const {
    Numbers at = jacobian;
    at.data = static_cast<const char*>(jacobian.data) + (packed ? before * number_size : i * jacobian.stride);
    at.stride = number_size;
    return at;
  }
};

struct BodyRows {
  std::int32_t count;
  Side a, b;
  RowFields fields;
};

/// mlcp_rows or mlcp_rows_f32: the same fields in another precision.
template <class Rows>
BodyRows body_rows(const Rows& rows) {
  const auto side = [&](const char* body_name, const char* jacobian_name, const std::int32_t* body, const auto* jacobian,
                        std::ptrdiff_t stride) {
    const std::ptrdiff_t body_stride = rows.body_stride ? rows.body_stride : std::ptrdiff_t(sizeof *body);
    return Side{body_name, jacobian_name,     {body, body_stride, MLCP_WORLD}, numbers(jacobian, 0, stride), sizeof *jacobian,
                stride == 0};
  };
  const std::ptrdiff_t key_stride = rows.key_stride ? rows.key_stride : std::ptrdiff_t(sizeof *rows.key);
  return {rows.count,
          side("body_a", "jacobian_a", rows.body_a, rows.jacobian_a, rows.jacobian_a_stride),
          side("body_b", "jacobian_b", rows.body_b, rows.jacobian_b, rows.jacobian_b_stride),
          {numbers(rows.r, 0, rows.value_stride), numbers(rows.lo, 0, rows.value_stride),
           numbers(rows.hi, infinity, rows.value_stride), numbers(rows.compliance, 0, rows.value_stride),
           {rows.key, key_stride, 0}}};
}

/// Returns the number of entries of row i on this side.
std::int32_t check_side(const Problem& problem, const Side& side, std::int32_t i, std::int64_t before) {
  const std::int32_t id = side.body[i];
  if (id == MLCP_WORLD) return 0;
  const std::int32_t d = body_at(problem, id, side.body_name, i).dimension;
  if (!side.jacobian.data)
    throw Error(MLCP_ERROR_NULL, "%s is NULL, but %s[%d] = %d is not the world", side.jacobian_name, side.body_name, i, id);
  const Numbers block = side.block(i, before);
  for (std::int32_t e = 0; e < d; ++e)
    if (!std::isfinite(block[e]))
      throw Error(MLCP_ERROR_ARGUMENT, "%s of row %d: number %d = %g is not finite", side.jacobian_name, i, e, block[e]);
  return d;
}

/// before: checked and reserved. Returns the number of entries.
std::int32_t append_side(Problem& problem, const Side& side, std::int32_t i, std::int64_t before) {
  const std::int32_t id = side.body[i];
  if (id == MLCP_WORLD) return 0;
  const Body& body = problem.bodies[id];
  const Numbers block = side.block(i, before);
  for (std::int32_t e = 0; e < body.dimension; ++e) {
    problem.jacobian.indices.push_back(body.offset + e);
    problem.jacobian.values.push_back(block[e]);
  }
  return body.dimension;
}

std::int32_t add(Problem& problem, const BodyRows& rows) {
  check_count("count", rows.count);
  std::int64_t before_a = 0, before_b = 0;
  for (std::int32_t i = 0; i < rows.count; ++i) {
    const std::int32_t entries_a = check_side(problem, rows.a, i, before_a), entries_b = check_side(problem, rows.b, i, before_b);
    if (rows.a.body[i] == rows.b.body[i] && rows.a.body[i] != MLCP_WORLD)
      throw Error(MLCP_ERROR_ARGUMENT, "body_b[%d] = %d is body_a[%d] too", i, rows.b.body[i], i);
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

}  // namespace

std::int32_t rows_add(Problem& problem, const mlcp_rows& rows) { return add(problem, body_rows(rows)); }
std::int32_t rows_add(Problem& problem, const mlcp_rows_f32& rows) { return add(problem, body_rows(rows)); }

}  // namespace mlcp
