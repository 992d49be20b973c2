#include "support.h"

#include <cstdlib>

namespace capi {

ProblemHandle make_problem(const mlcp_allocator* allocator) {
  mlcp_problem* problem = nullptr;
  EXPECT_EQ(mlcp_problem_create(allocator, &problem), MLCP_OK);
  return ProblemHandle(problem);
}

MaskHandle make_mask(int32_t count, mlcp_row_state state) {
  mlcp_mask* mask = nullptr;
  EXPECT_EQ(mlcp_mask_create(nullptr, count, state, &mask), MLCP_OK);
  return MaskHandle(mask);
}

SolverHandle make_solver(const mlcp_settings* settings) {
  mlcp_solver* solver = nullptr;
  EXPECT_EQ(mlcp_solver_create(settings, nullptr, &solver), MLCP_OK);
  return SolverHandle(solver);
}

Bytes snapshot(const mlcp_problem* problem, const mlcp_solver* solver, const mlcp_mask* enabled, const mlcp_mask* start) {
  size_t size = 0;
  EXPECT_EQ(mlcp_snapshot_write(problem, solver, enabled, start, 0, nullptr, &size, nullptr, 0), MLCP_OK);
  Bytes bytes(size);
  EXPECT_EQ(mlcp_snapshot_write(problem, solver, enabled, start, bytes.size(), bytes.data(), &size, nullptr, 0), MLCP_OK);
  return bytes;
}

Allocator::Allocator() : hooks_{this, reallocate, release} {}

Allocator::~Allocator() {
  EXPECT_EQ(blocks_, 0);
  EXPECT_EQ(bytes_, 0u);
}

void* Allocator::reallocate(void* context, void* block, size_t old_size, size_t new_size) {
  auto& self = *static_cast<Allocator*>(context);
  EXPECT_GT(new_size, 0u);
  EXPECT_EQ(block == nullptr, old_size == 0);
  const int64_t call = self.calls_++;
  if (self.fail_at_ >= 0 && call >= self.fail_at_) return nullptr;
  // always another block, so that a pointer to the old one shows under a sanitizer
  void* fresh = std::malloc(new_size);
  std::memset(fresh, 0xa5, new_size);
  if (block) {
    std::memcpy(fresh, block, old_size < new_size ? old_size : new_size);
    std::free(block);
  }
  self.blocks_ += block == nullptr;
  self.bytes_ += new_size - old_size;
  return fresh;
}

void Allocator::release(void* context, void* block, size_t size) {
  auto& self = *static_cast<Allocator*>(context);
  EXPECT_NE(block, nullptr);
  std::free(block);
  --self.blocks_;
  self.bytes_ -= size;
}

std::vector<double> diagonal_mass(int32_t d, double diagonal) {
  std::vector<double> mass(static_cast<size_t>(d) * d, 0.0);
  for (int32_t j = 0; j < d; ++j) mass[static_cast<size_t>(j) * d + j] = diagonal;
  return mass;
}

int32_t add_body(mlcp_problem* problem, int32_t d, double diagonal) {
  int32_t id = -1;
  EXPECT_EQ(mlcp_problem_bodies_add(problem, 1, d, diagonal_mass(d, diagonal).data(), 0, &id), MLCP_OK);
  return id;
}

int32_t add_row(mlcp_problem* problem, const std::vector<int32_t>& columns, const std::vector<double>& values, uint64_t key) {
  int32_t row = -1;
  EXPECT_EQ(mlcp_problem_row_add(problem, static_cast<int32_t>(columns.size()), columns.data(), values.data(), 0, 0, inf, 0, key,
                                 &row),
            MLCP_OK)
      << mlcp_problem_error(problem);
  return row;
}

namespace {

using View = mlcp_status (*)(const mlcp_problem*, mlcp_matrix_view*);

Matrix copy(const mlcp_problem* problem, View look, bool by_rows) {
  mlcp_matrix_view view;
  mlcp_matrix_view_init(&view, sizeof view);
  EXPECT_EQ(look(problem, &view), MLCP_OK);
  const int32_t outer = by_rows ? view.rows : view.columns;
  EXPECT_EQ(view.pointers[outer], view.entries);
  return {view.rows, view.columns, {view.pointers, view.pointers + outer + 1}, {view.indices, view.indices + view.entries},
          {view.values, view.values + view.entries}};
}

}  // namespace

Matrix mass_of(const mlcp_problem* problem) { return copy(problem, mlcp_problem_mass, false); }
Matrix jacobian_of(const mlcp_problem* problem) { return copy(problem, mlcp_problem_jacobian, true); }
Matrix compliance_of(const mlcp_problem* problem) { return copy(problem, mlcp_problem_compliance, false); }

std::vector<double> dense(const Matrix& a, bool by_rows) {
  std::vector<double> out(static_cast<size_t>(a.rows) * a.columns, 0.0);
  for (int32_t o = 0; o + 1 < static_cast<int32_t>(a.pointers.size()); ++o)
    for (int32_t e = a.pointers[o]; e < a.pointers[o + 1]; ++e) {
      const int32_t i = by_rows ? o : a.indices[e], j = by_rows ? a.indices[e] : o;
      out[static_cast<size_t>(i) * a.columns + j] += a.values[e];
    }
  return out;
}

ProblemHandle make_rich_problem(const mlcp_allocator* allocator) {
  ProblemHandle problem = make_problem(allocator);
  mlcp_problem* p = problem.get();
  add_body(p, 3, 2);
  const int32_t freed = add_body(p, 2, 5);
  const double tilted[] = {4, 1, 1, 3};
  EXPECT_EQ(mlcp_problem_bodies_add(p, 1, 2, tilted, 0, nullptr), MLCP_OK);
  const int32_t pointers[] = {0, 2, 4, 5}, rows[] = {2, 0, 1, 2, 2};
  const double values[] = {0.5, 2, 3, -1, 4};
  EXPECT_EQ(mlcp_problem_body_add_sparse(p, 3, pointers, rows, values, MLCP_LOWER, nullptr), MLCP_OK);
  const double moving[] = {1, -2, 0.25};
  EXPECT_EQ(mlcp_problem_body_set_prescribed(p, add_body(p, 3, 1), moving, 3), MLCP_OK);
  EXPECT_EQ(mlcp_problem_body_remove(p, freed), MLCP_OK);
  std::vector<double> k(mlcp_problem_velocity_count(p));
  for (size_t j = 0; j < k.size(); ++j) k[j] = 0.5 * static_cast<double>(j) - 1;
  EXPECT_EQ(mlcp_problem_set_momentum(p, 0, static_cast<int32_t>(k.size()), k.data()), MLCP_OK);
  add_row(p, {0, 4, 2}, {1, -1, 0.5}, 17);
  add_row(p, {}, {}, 0);
  add_row(p, {6, 3}, {1, 0}, 17);
  EXPECT_EQ(mlcp_problem_row_add(p, 0, nullptr, nullptr, -1, -2, 3, 0.5, 99, nullptr), MLCP_OK);
  const int32_t columns[] = {0, 1, 2, 3, 4}, diagonal[] = {0, 2, 1, 3};
  const double compliance[] = {0.25, 0.125, 0.5, 0.0625};
  EXPECT_EQ(mlcp_problem_set_compliance_matrix(p, 4, columns, diagonal, compliance, MLCP_LOWER), MLCP_ERROR_ARGUMENT);
  const int32_t lower[] = {0, 2, 3, 4, 5}, below[] = {0, 3, 1, 2, 3};
  const double numbers[] = {0.25, 0.125, 0.5, 0.0625, 1};
  EXPECT_EQ(mlcp_problem_set_compliance_matrix(p, 4, lower, below, numbers, MLCP_LOWER), MLCP_OK) << mlcp_problem_error(p);
  return problem;
}

void fill_pile(mlcp_problem* p, int32_t count) {
  ASSERT_EQ(mlcp_problem_clear(p), MLCP_OK);
  for (int32_t i = 0; i < count; ++i) add_body(p, 1, 1 + i % 3);
  std::vector<double> k(count, -1.0);
  ASSERT_EQ(mlcp_problem_set_momentum(p, 0, count, k.data()), MLCP_OK);
  add_row(p, {0}, {1}, 1000);
  for (int32_t i = 1; i < count; ++i) add_row(p, {i - 1, i}, {-1, 1}, 1000 + static_cast<uint64_t>(i));
}

mlcp_report new_report() {
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  return report;
}

std::vector<double> velocities(const mlcp_solver* solver) {
  const double* v = nullptr;
  int32_t count = 0;
  EXPECT_EQ(mlcp_solver_velocities(solver, &v, &count), MLCP_OK);
  return {v, v + count};
}

std::vector<double> impulses(const mlcp_solver* solver) {
  const double* gamma = nullptr;
  int32_t count = 0;
  EXPECT_EQ(mlcp_solver_impulses(solver, &gamma, &count), MLCP_OK);
  return {gamma, gamma + count};
}

}  // namespace capi
