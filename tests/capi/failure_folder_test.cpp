// Solves that fail leave snapshots, which fail again in the same way.
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "support.h"

using namespace capi;

namespace {

namespace fs = std::filesystem;

/// A body between a floor that rises and a ceiling: no velocity will do.
ProblemHandle make_squeezed() {
  ProblemHandle problem = make_problem();
  add_body(problem.get(), 1, 2);
  add_body(problem.get(), 3, 1);
  const double k[] = {1, 0.1, -0.2, 0.3}, one = 1, minus = -1;
  const int32_t column = 0;
  EXPECT_EQ(mlcp_problem_set_momentum(problem.get(), 0, 4, k), MLCP_OK);
  EXPECT_EQ(mlcp_problem_row_add(problem.get(), 1, &column, &one, 0.5, 0, inf, 0, 1, nullptr), MLCP_OK);
  EXPECT_EQ(mlcp_problem_row_add(problem.get(), 1, &column, &minus, 0.25, 0, inf, 0, 2, nullptr), MLCP_OK);
  add_row(problem.get(), {1, 2}, {1, 0.3}, 3);
  return problem;
}

struct FailureFolderTest : testing::Test {
  std::string folder = testing::TempDir() + "mlcp_failures_XXXXXX";
  ProblemHandle problem = make_squeezed();
  mlcp_report report;

  FailureFolderTest() {
    EXPECT_NE(mkdtemp(folder.data()), nullptr);
    mlcp_report_init(&report, sizeof report);
  }
  ~FailureFolderTest() override {
    unsetenv("MLCP_FAILURES");
    unsetenv("MLCP_FAILURES_LIMIT");
    fs::remove_all(folder);
  }
  mlcp_outcome solve(const SolverHandle& solver) {
    EXPECT_EQ(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, &report), MLCP_OK) << mlcp_solver_error(solver.get());
    return report.outcome;
  }
  long files() const { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); }
  std::string file(const char* name) const { return folder + "/" + name; }
};

std::vector<double> all_results(const mlcp_solver* solver) {
  std::vector<double> all;
  for (auto get : {mlcp_solver_velocities, mlcp_solver_impulses, mlcp_solver_slacks}) {
    const double* data = nullptr;
    int32_t count = 0;
    EXPECT_EQ(get(solver, &data, &count), MLCP_OK);
    all.insert(all.end(), data, data + count);
  }
  return all;
}

}  // namespace

TEST_F(FailureFolderTest, ASolveThatFailsLeavesASnapshotThatFailsWithTheSameBits) {
  SolverHandle solver = make_solver();
  ASSERT_EQ(mlcp_solver_keep_failures(solver.get(), folder.c_str(), 5), MLCP_OK);
  for (int step = 0; step < 3; ++step) {  // the later ones start warm, by keys
    ASSERT_EQ(solve(solver), MLCP_INFEASIBLE);
    const std::string path = mlcp_solver_failure_file(solver.get());
    EXPECT_EQ(path, file(("failure-000" + std::to_string(step) + ".mlcp").c_str()));
    mlcp_problem* p = nullptr;
    mlcp_solver* s = nullptr;
    mlcp_mask *enabled = nullptr, *start = nullptr;
    ASSERT_EQ(mlcp_snapshot_load(path.c_str(), nullptr, &p, &s, &enabled, &start, nullptr, 0), MLCP_OK);
    ProblemHandle problem_owner(p);
    SolverHandle solver_owner(s);
    MaskHandle enabled_owner(enabled), start_owner(start);
    mlcp_report again;
    mlcp_report_init(&again, sizeof again);
    ASSERT_EQ(mlcp_solve(s, p, enabled, start, &again), MLCP_OK);
    EXPECT_EQ(again.outcome, MLCP_INFEASIBLE);
    EXPECT_EQ(again.pivots, report.pivots);
    EXPECT_EQ(all_results(s), all_results(solver.get()));
  }
  EXPECT_EQ(files(), 3);
}

TEST_F(FailureFolderTest, ALentMaskAsStartIsKeptAsItWas) {
  SolverHandle solver = make_solver();
  ASSERT_EQ(solve(solver), MLCP_INFEASIBLE);
  ASSERT_EQ(mlcp_solver_keep_failures(solver.get(), folder.c_str(), 1), MLCP_OK);
  const mlcp_mask* lent = nullptr;
  mlcp_mask *copy = nullptr, *kept = nullptr;
  ASSERT_EQ(mlcp_solver_mask(solver.get(), &lent), MLCP_OK);
  ASSERT_EQ(mlcp_mask_clone(nullptr, lent, &copy), MLCP_OK);
  MaskHandle before(copy);
  mlcp_row_state other[3] = {MLCP_ROW_ACTIVE, MLCP_ROW_AT_LOWER, MLCP_ROW_ACTIVE};
  ASSERT_EQ(mlcp_mask_set(copy, 0, 3, other), MLCP_OK);
  ASSERT_EQ(mlcp_solve(solver.get(), problem.get(), nullptr, copy, nullptr), MLCP_OK);
  ASSERT_EQ(mlcp_snapshot_load(mlcp_solver_failure_file(solver.get()), nullptr, nullptr, nullptr, nullptr, &kept, nullptr, 0), MLCP_OK);
  MaskHandle owner(kept);
  EXPECT_EQ(mlcp_mask_equal(kept, copy), 1);
}

TEST_F(FailureFolderTest, TheLimitCountsFilesWhoeverMadeThemAndNoneIsReplaced) {
  const std::string strange = file("failure-0001.mlcp");
  std::FILE* mine = std::fopen(strange.c_str(), "w");
  std::fputs("mine", mine);
  std::fclose(mine);
  SolverHandle first = make_solver(), second = make_solver();
  for (const SolverHandle* solver : {&first, &second}) ASSERT_EQ(mlcp_solver_keep_failures(solver->get(), folder.c_str(), 3), MLCP_OK);
  for (int step = 0; step < 4; ++step)
    for (const SolverHandle* solver : {&first, &second}) ASSERT_EQ(solve(*solver), MLCP_INFEASIBLE);
  EXPECT_EQ(files(), 3);
  EXPECT_EQ(fs::file_size(strange), 4u);
  EXPECT_STREQ(mlcp_solver_failure_file(first.get()), "");
}

TEST_F(FailureFolderTest, NothingIsKeptOfASolveThatSucceedsOrWithoutAFolder) {
  SolverHandle solver = make_solver();
  ASSERT_EQ(solve(solver), MLCP_INFEASIBLE);
  EXPECT_STREQ(mlcp_solver_failure_file(solver.get()), "");
  ASSERT_EQ(mlcp_solver_keep_failures(solver.get(), folder.c_str(), 3), MLCP_OK);
  ASSERT_EQ(solve(solver), MLCP_INFEASIBLE);
  EXPECT_STRNE(mlcp_solver_failure_file(solver.get()), "");
  const int32_t ceiling = 1;
  ASSERT_EQ(mlcp_problem_rows_remove(problem.get(), 1, &ceiling), MLCP_OK);
  ASSERT_EQ(solve(solver), MLCP_SOLVED);
  EXPECT_STREQ(mlcp_solver_failure_file(solver.get()), "");
  problem = make_squeezed();
  ASSERT_EQ(mlcp_solver_keep_failures(solver.get(), nullptr, 0), MLCP_OK);
  ASSERT_EQ(solve(solver), MLCP_INFEASIBLE);
  EXPECT_EQ(files(), 1);
}

TEST_F(FailureFolderTest, TheEnvironmentNamesTheFolderOfNewSolvers) {
  SolverHandle old = make_solver();
  ASSERT_EQ(setenv("MLCP_FAILURES", folder.c_str(), 1), 0);
  for (const char* limit : {"2", "many", "-1", ""}) {
    ASSERT_EQ(setenv("MLCP_FAILURES_LIMIT", limit, 1), 0);
    SolverHandle solver = make_solver();
    for (int step = 0; step < 15; ++step) ASSERT_EQ(solve(solver), MLCP_INFEASIBLE);
    EXPECT_EQ(files(), std::string(limit) == "2" ? 2 : 10) << limit;
  }
  fs::remove_all(folder);
  ASSERT_EQ(solve(old), MLCP_INFEASIBLE);
  EXPECT_STREQ(mlcp_solver_failure_file(old.get()), "");
}

TEST_F(FailureFolderTest, AFileThatCannotBeWrittenIsNoFailureOfTheSolve) {
  SolverHandle solver = make_solver();
  ASSERT_EQ(mlcp_solver_keep_failures(solver.get(), file("missing").c_str(), 3), MLCP_OK);
  EXPECT_EQ(solve(solver), MLCP_INFEASIBLE);
  EXPECT_STREQ(mlcp_solver_failure_file(solver.get()), "");
  ASSERT_EQ(mkdir(file("missing").c_str(), 0777), 0);
  EXPECT_EQ(solve(solver), MLCP_INFEASIBLE);
  EXPECT_EQ(mlcp_solver_failure_file(solver.get()), file("missing/failure-0000.mlcp")) << "a number that was not used is not lost";
}

TEST_F(FailureFolderTest, MemoryThatRunsOutWhileItIsWrittenIsNoFailureOfTheSolve) {
  Allocator allocator;
  mlcp_solver* raw = nullptr;
  ASSERT_EQ(mlcp_solver_create(nullptr, allocator.hooks(), &raw), MLCP_OK);
  SolverHandle solver(raw);
  ASSERT_EQ(mlcp_solver_keep_failures(raw, folder.c_str(), 1), MLCP_OK);
  ASSERT_EQ(mlcp_solver_keep_failures(raw, file("missing").c_str(), 1), MLCP_OK);
  for (int step = 0; step < 3; ++step) ASSERT_EQ(solve(solver), MLCP_INFEASIBLE);  // what a warm solve needs is there
  ASSERT_EQ(mlcp_solver_keep_failures(raw, folder.c_str(), 1), MLCP_OK);
  for (int64_t n = 0; files() == 0; ++n) {
    ASSERT_LT(n, 1000);
    allocator.fail_at(n);
    ASSERT_EQ(solve(solver), MLCP_INFEASIBLE) << n;
  }
  EXPECT_STRNE(mlcp_solver_failure_file(raw), "");
}

TEST_F(FailureFolderTest, BadArguments) {
  SolverHandle solver = make_solver();
  EXPECT_EQ(mlcp_solver_keep_failures(nullptr, folder.c_str(), 1), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_solver_keep_failures(solver.get(), folder.c_str(), -1), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_solver_keep_failures(solver.get(), folder.c_str(), 10001), MLCP_ERROR_ARGUMENT);
  EXPECT_NE(std::string(mlcp_solver_error(solver.get())).find("limit = 10001"), std::string::npos);
  EXPECT_EQ(mlcp_solver_keep_failures(solver.get(), "", 1), MLCP_ERROR_ARGUMENT);
  EXPECT_STREQ(mlcp_solver_failure_file(nullptr), "");
}
