#pragma once
#include "assemble/row_input.h"

/// Rows between two bodies, one by one or in groups (a contact) that share bodies and key.
namespace mlcp {

/// Blocks of J on one side, a or b.
struct BodySide {
  const char *body_name, *jacobian_name;
  Integers<std::int32_t> body;
  Numbers jacobian;  ///< `stride` bytes from one group to the next
  bool packed;       ///< one block behind the other, the world taking none

  /// The block of row i, `dimension` numbers; `before`: numbers of the rows ahead of it.
  Numbers block(std::int64_t i, std::int64_t before, std::int32_t dimension) const;
};

template <class Number>
BodySide body_side(const char* body_name, const char* jacobian_name, const std::int32_t* body, std::ptrdiff_t body_stride,
                   const Number* jacobian, std::ptrdiff_t jacobian_stride, std::int32_t group = 1) {
  return {body_name, jacobian_name, integers(body, std::int32_t(MLCP_WORLD), body_stride, group),
          numbers(jacobian, 0, jacobian_stride), jacobian_stride == 0};
}

struct BodyRows {
  std::int32_t count;  ///< of rows
  BodySide a, b;
  RowFields fields;
};

/// Returns the index of the first row. fails: Error, bad_alloc; nothing changed.
std::int32_t body_rows_add(Problem& problem, const BodyRows& rows);

}  // namespace mlcp
