#include "support.h"

using namespace capi;

TEST(SolverMemory, EveryAllocationOfASolveMayFail) {
  ProblemHandle problem = make_problem();
  fill_pile(problem.get(), 12);
  SolverHandle plain = make_solver();
  ASSERT_EQ(mlcp_solve(plain.get(), problem.get(), nullptr, nullptr, nullptr), MLCP_OK);
  Allocator allocator;
  mlcp_solver* solver = nullptr;
  for (int64_t n = 0; !solver && n < 1000; ++n) {
    allocator.fail_at(n);
    if (mlcp_solver_create(nullptr, allocator.hooks(), &solver) != MLCP_OK) {
      EXPECT_EQ(allocator.blocks(), 0);
    }
  }
  ASSERT_NE(solver, nullptr);
  SolverHandle owner(solver);
  mlcp_status status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY && n < 10000; ++n) {
    allocator.fail_at(n);
    status = mlcp_solve(solver, problem.get(), nullptr, nullptr, nullptr);
  }
  ASSERT_EQ(status, MLCP_OK) << mlcp_solver_error(solver);
  EXPECT_EQ(velocities(solver), velocities(plain.get()));
  EXPECT_EQ(impulses(solver), impulses(plain.get()));
}

TEST(SolverMemory, AStepAsLargeAsTheLastAllocatesNothing) {
  Allocator allocator;
  ProblemHandle problem = make_problem(allocator.hooks());
  mlcp_solver* raw = nullptr;
  mlcp_mask* start = nullptr;
  ASSERT_EQ(mlcp_solver_create(nullptr, allocator.hooks(), &raw), MLCP_OK);
  ASSERT_EQ(mlcp_mask_create(allocator.hooks(), 0, MLCP_ROW_ACTIVE, &start), MLCP_OK);
  SolverHandle solver(raw);
  MaskHandle mask(start);
  for (int step = 0; step < 4; ++step) {
    if (step == 2) allocator.fail_at(0);
    fill_pile(problem.get(), 30);
    const mlcp_mask* last = start;
    if (step > 0) {
      ASSERT_EQ(mlcp_solver_mask(raw, &last), MLCP_OK);
    }
    ASSERT_EQ(mlcp_mask_carry(start, problem.get(), last, MLCP_ROW_AT_LOWER), MLCP_OK);
    ASSERT_EQ(mlcp_solve(raw, problem.get(), nullptr, start, nullptr), MLCP_OK) << mlcp_solver_error(raw);
  }
  EXPECT_EQ(allocator.calls(), 0);
}

TEST(SolverMemory, TrimKeepsTheResults) {
  ProblemHandle problem = make_problem();
  fill_pile(problem.get(), 10);
  SolverHandle solver = make_solver();
  ASSERT_EQ(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, nullptr), MLCP_OK);
  const std::vector<double> v = velocities(solver.get());
  ASSERT_EQ(mlcp_solver_trim(solver.get()), MLCP_OK);
  EXPECT_EQ(velocities(solver.get()), v);
  ASSERT_EQ(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, nullptr), MLCP_OK);
  EXPECT_EQ(velocities(solver.get()), v);
}
