#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "mlcp.h"

namespace capi {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Destroy {
  void operator()(mlcp_problem* p) const { mlcp_problem_destroy(p); }
  void operator()(mlcp_mask* p) const { mlcp_mask_destroy(p); }
  void operator()(mlcp_solver* p) const { mlcp_solver_destroy(p); }
};
using ProblemHandle = std::unique_ptr<mlcp_problem, Destroy>;
using MaskHandle = std::unique_ptr<mlcp_mask, Destroy>;
using SolverHandle = std::unique_ptr<mlcp_solver, Destroy>;
using Bytes = std::vector<unsigned char>;

ProblemHandle make_problem(const mlcp_allocator* allocator = nullptr);
MaskHandle make_mask(int32_t count, mlcp_row_state state = MLCP_ROW_ACTIVE);
SolverHandle make_solver(const mlcp_settings* settings = nullptr);

/// Snapshot bytes: equal exactly when everything that is stored is.
Bytes snapshot(const mlcp_problem* problem, const mlcp_solver* solver = nullptr, const mlcp_mask* enabled = nullptr,
               const mlcp_mask* start = nullptr);

/// Hooks that count, check sizes, and return NULL at the call number `fail_at` (from 0; −1: never) and all after it.
class Allocator {
 public:
  Allocator();
  ~Allocator();
  Allocator(const Allocator&) = delete;
  Allocator& operator=(const Allocator&) = delete;

  const mlcp_allocator* hooks() const { return &hooks_; }
  int64_t calls() const { return calls_; }
  int64_t blocks() const { return blocks_; }
  size_t bytes() const { return bytes_; }
  void fail_at(int64_t call) {
    calls_ = 0;
    fail_at_ = call;
  }

 private:
  static void* reallocate(void* context, void* block, size_t old_size, size_t new_size);
  static void release(void* context, void* block, size_t size);

  mlcp_allocator hooks_;
  int64_t calls_ = 0, fail_at_ = -1, blocks_ = 0;
  size_t bytes_ = 0;
};

/// Dense symmetric d × d with `diagonal` on the diagonal.
std::vector<double> diagonal_mass(int32_t d, double diagonal = 1);
/// One body with that mass; returns its id.
int32_t add_body(mlcp_problem* problem, int32_t d = 3, double diagonal = 1);
/// One row over any velocities with bounds 0, inf.
int32_t add_row(mlcp_problem* problem, const std::vector<int32_t>& columns, const std::vector<double>& values, uint64_t key = 0);
/// Clears the problem and puts a pile into it: `count` bodies of one velocity, each on the one below.
void fill_pile(mlcp_problem* problem, int32_t count);
mlcp_report new_report();
/// Of the last solve, copies.
std::vector<double> velocities(const mlcp_solver* solver);
std::vector<double> impulses(const mlcp_solver* solver);

struct Matrix {
  int32_t rows, columns;
  std::vector<int32_t> pointers, indices;
  std::vector<double> values;
};
Matrix mass_of(const mlcp_problem* problem);
Matrix jacobian_of(const mlcp_problem* problem);
Matrix compliance_of(const mlcp_problem* problem);
/// Row major; `by_rows`: the pointers are those of rows.
std::vector<double> dense(const Matrix& matrix, bool by_rows);

/// A problem with everything in it: dense, sparse and prescribed bodies, a free id, rows with and without entries, keys, Σ.
ProblemHandle make_rich_problem(const mlcp_allocator* allocator = nullptr);

/// The call is refused with this status and a text that contains `part`; the problem is as before.
template <class Call>
void expect_refused(mlcp_problem* problem, mlcp_status status, const char* part, Call call) {
  const Bytes before = snapshot(problem);
  EXPECT_EQ(call(), status);
  EXPECT_NE(std::string(mlcp_problem_error(problem)).find(part), std::string::npos) << mlcp_problem_error(problem);
  EXPECT_EQ(snapshot(problem), before);
}

}  // namespace capi
