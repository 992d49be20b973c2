#include "assemble/bodies.h"

#include "assemble/layout.h"
#include "assemble/symmetric.h"
#include "assemble/validate.h"

namespace mlcp {

namespace {

void read_mass(const double* masses, std::ptrdiff_t stride_bytes, std::int32_t body, std::size_t size, double* out) {
  const char* from = reinterpret_cast<const char*>(masses) + stride_bytes * body;
  std::memcpy(out, from, size * sizeof(double));
}

void write_dense(const double* mass, std::int32_t d, double* out) {
  for (std::int32_t j = 0; j < d; ++j)
    for (std::int32_t i = j; i < d; ++i)
      out[std::size_t(j) * d + i] = out[std::size_t(i) * d + j] =
          middle(mass[std::size_t(j) * d + i], mass[std::size_t(i) * d + j]);
}

void check_sparse_diagonal(const char* name, std::span<const double> diagonal) {
  for (std::size_t j = 0; j < diagonal.size(); ++j)
    if (diagonal[j] < 0) throw Error(MLCP_ERROR_ARGUMENT, "%s: diagonal entry %d = %.17g is negative", name, static_cast<int>(j), diagonal[j]);
}

void check_diagonal(const char* name, const double* values, std::int32_t size) {
  bool right = true;
  for (std::int32_t j = 0; j < size; ++j) right &= (values[j] >= 0) & (values[j] < infinity);
  if (right) return;
  check_finite(name, values, size);
  check_sparse_diagonal(name, {values, static_cast<std::size_t>(size)});
}

void set_sparse_mass(Problem& problem, const Body& body, std::int32_t id, const double* values, std::int64_t count) {
  if (body.diagonal) {
    check_length("count", count, body.dimension);
    check_diagonal("mass", values, body.dimension);
    std::copy_n(values, count, problem.mass.values.data() + problem.mass.pointers[body.offset]);
    return;
  }
  const std::int64_t slot = problem.mass_slot_start[id];
  check_length("count", count, (problem.mass_slot_start[id + 1] - slot) / 2);
  const std::int32_t* pointers = problem.mass.pointers.data() + body.offset;
  const std::int32_t first = pointers[0], entries = pointers[body.dimension] - first;
  const SymmetricPattern pattern{body.dimension, pointers, problem.mass.indices.data() + first, body.offset,
                                 problem.mass_slot.data() + slot, count, body.sparse - 1};
  double* const mass = problem.mass.values.data() + first;
  if (entries == count && mirrored(pattern, values)) {
    std::copy_n(values, count, mass);
    return;
  }
  check_finite("mass", values, count);
  Array<double>& scratch = problem.work.value;
  scratch.resize(std::size_t(body.dimension) + entries);
  const std::span<double> out = scratch.span().subspan(body.dimension);
  expand_values("mass", pattern, values, scratch.data(), out);
  check_sparse_diagonal("mass", scratch.span().first(body.dimension));
  std::copy(out.begin(), out.end(), mass);
}

/// The pattern of a diagonal, which the caller need not have.
std::int32_t add_diagonal(Problem& problem, const SymmetricInput& mass) {
  check_diagonal("values", mass.values, mass.size);
  choose_ids(problem, 1);
  open_bodies(problem, {mass.size, mass.size, 0});
  const std::int32_t id = problem.work.index[0];
  Body& body = problem.bodies[id];
  body.sparse = 1 + mass.triangle;
  body.diagonal = 1;
  auto& [pointers, indices, numbers] = problem.mass;
  const std::int32_t entry = pointers[body.offset];
  for (std::int32_t j = 0; j < mass.size; ++j) {
    pointers[body.offset + j] = entry + j;
    indices[entry + j] = body.offset + j;
  }
  std::copy_n(mass.values, mass.size, numbers.data() + entry);
  return id;
}

}  // namespace

const Body& body_at(const Problem& problem, std::int32_t id, const char* name, std::int64_t index) {
  if (id >= 0 && std::size_t(id) < problem.bodies.size() && problem.bodies[id].dimension > 0) return problem.bodies[id];
  if (index < 0) throw Error(MLCP_ERROR_RANGE, "%s = %d is not a body", name, id);
  throw Error(MLCP_ERROR_RANGE, "%s[%lld] = %d is not a body", name, static_cast<long long>(index), id);
}

void bodies_add(Problem& problem, std::int32_t count, std::int32_t dimension, const double* masses, std::ptrdiff_t stride_bytes,
                std::int32_t* ids) {
  check_count("count", count);
  if (dimension < 1) throw Error(MLCP_ERROR_ARGUMENT, "dimension = %d is not positive", dimension);
  check_array("masses", masses, count);
  const std::int64_t size = std::int64_t(dimension) * dimension;
  check_entries("M", size);
  check_entries("M", std::int64_t(problem.mass.values.size()) + count * size);
  check_index_space(problem.n() + std::int64_t(count) * dimension, problem.m());
  if (count == 0) return;
  if (stride_bytes == 0) stride_bytes = static_cast<std::ptrdiff_t>(size * sizeof(double));
  Array<double>& scratch = problem.work.value;
  scratch.resize(2 * size);
  for (std::int32_t b = 0; b < count; ++b) {
    read_mass(masses, stride_bytes, b, size, scratch.data());
    check_dense_mass({"masses", b}, scratch.data(), dimension, scratch.data() + size);
  }
  choose_ids(problem, count);
  open_bodies(problem, {dimension, size, 0});
  const std::int32_t diagonal = dimension == 1;
  for (std::int32_t b = 0; b < count; ++b) {
    const std::int32_t id = problem.work.index[b], first = problem.bodies[id].offset, entry = problem.mass.pointers[first];
    problem.bodies[id].diagonal = diagonal;
    for (std::int32_t j = 0; j < dimension; ++j) {
      problem.mass.pointers[first + j] = entry + j * dimension;
      for (std::int32_t i = 0; i < dimension; ++i) problem.mass.indices[entry + j * dimension + i] = first + i;
    }
    read_mass(masses, stride_bytes, b, size, scratch.data());
    write_dense(scratch.data(), dimension, problem.mass.values.data() + entry);
    if (ids) ids[b] = id;
  }
}

std::int32_t body_add_sparse(Problem& problem, std::int32_t dimension, const std::int32_t* column_pointers,
                             const std::int32_t* row_indices, const double* values, mlcp_triangle triangle) {
  if (dimension < 1) throw Error(MLCP_ERROR_ARGUMENT, "dimension = %d is not positive", dimension);
  EditWorkspace& work = problem.work;
  const SymmetricInput mass{dimension, column_pointers, row_indices, values, triangle};
  if (is_diagonal(mass)) return add_diagonal(problem, mass);
  expand(mass, work);
  check_sparse_diagonal("values", work.value.span());
  choose_ids(problem, 1);
  open_bodies(problem, {dimension, std::int64_t(work.expanded.values.size()), std::int64_t(work.slot.size())});

  const std::int32_t id = work.index[0];
  Body& body = problem.bodies[id];
  body.sparse = 1 + triangle;
  auto& [pointers, indices, numbers] = problem.mass;
  const std::int32_t entry = pointers[body.offset];
  for (std::int32_t j = 0; j < dimension; ++j) pointers[body.offset + j] = entry + work.expanded.pointers[j];
  for (std::size_t e = 0; e < work.expanded.values.size(); ++e) {
    indices[entry + e] = body.offset + work.expanded.indices[e];
    numbers[entry + e] = work.expanded.values[e];
  }
  std::copy(work.slot.begin(), work.slot.end(), problem.mass_slot.data() + problem.mass_slot_start[id]);
  return id;
}

void body_set_mass(Problem& problem, std::int32_t id, const double* mass, std::int64_t count) {
  const Body body = body_at(problem, id);
  check_count("count", count);
  check_array("mass", mass, count);
  if (body.sparse) return set_sparse_mass(problem, body, id, mass, count);
  const std::int64_t size = std::int64_t(body.dimension) * body.dimension;
  check_length("count", count, size);
  problem.work.value.resize(size);
  check_dense_mass({"mass"}, mass, body.dimension, problem.work.value.data());
  write_dense(mass, body.dimension, problem.mass.values.data() + problem.mass.pointers[body.offset]);
}

void body_remove(Problem& problem, std::int32_t id) {
  const Body& body = body_at(problem, id);
  for (std::int32_t row = 0; row < problem.m(); ++row)
    for (std::int32_t e = problem.jacobian.pointers[row]; e < problem.jacobian.pointers[row + 1]; ++e)
      if (problem.body_of[problem.jacobian.indices[e]] == id)
        throw Error(MLCP_ERROR_STATE, "body = %d cannot be removed: row %d refers to velocity %d of it", id, row,
                    problem.jacobian.indices[e] - body.offset);
  close_body(problem, id);
}

void body_set_prescribed(Problem& problem, std::int32_t id, const double* velocity, std::int32_t count) {
  const Body& body = body_at(problem, id);
  check_length("count", count, body.dimension);
  check_array("velocity", velocity, count);
  check_finite("velocity", velocity, count);
  problem.bodies[id].prescribed = 1;
  std::copy_n(velocity, count, problem.given_velocity.data() + body.offset);
}

void body_set_dynamic(Problem& problem, std::int32_t id) {
  const Body& body = body_at(problem, id);
  problem.bodies[id].prescribed = 0;
  std::fill_n(problem.given_velocity.data() + body.offset, body.dimension, 0.0);
}

void set_momentum(Problem& problem, std::int32_t first, std::int32_t count, const double* k) {
  check_range(first, count, problem.n());
  check_array("k", k, count);
  check_finite("k", k, count);
  std::copy_n(k, count, problem.momentum.data() + first);
}

}  // namespace mlcp
