#pragma once
#include <cstddef>

#include "assemble/problem.h"

/// Bodies and their masses. Every call: checks, then room, then changes; fails with Error or bad_alloc, nothing changed.
namespace mlcp {

/// masses: count dense d × d matrices, stride_bytes apart, 0: packed. ids: count entries or NULL.
void bodies_add(Problem& problem, std::int32_t count, std::int32_t dimension, const double* masses, std::ptrdiff_t stride_bytes,
                std::int32_t* ids);
/// Compressed columns. Returns the id.
std::int32_t body_add_sparse(Problem& problem, std::int32_t dimension, const std::int32_t* column_pointers,
                             const std::int32_t* row_indices, const double* values, mlcp_triangle triangle);
/// `count` numbers in the order in which the body's mass was given.
void body_set_mass(Problem& problem, std::int32_t body, const double* mass, std::int64_t count);
/// fails: STATE while a row refers to it.
void body_remove(Problem& problem, std::int32_t body);

void body_set_prescribed(Problem& problem, std::int32_t body, const double* velocity, std::int32_t count);
void body_set_dynamic(Problem& problem, std::int32_t body);
void set_momentum(Problem& problem, std::int32_t first, std::int32_t count, const double* k);

/// The body with that id; fails: RANGE. `name` is the argument's.
const Body& body_at(const Problem& problem, std::int32_t id, const char* name = "body", std::int64_t index = -1);

}  // namespace mlcp
