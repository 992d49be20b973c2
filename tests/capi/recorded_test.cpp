// Steps of our own scenes that were hard once, as they were recorded.
#include "support.h"

using namespace capi;

namespace {

/// A cascade of bodies that has come to rest: three generators for every velocity, nearly all of them at work, and contacts where one generator has
/// no velocity but rounding. It was thousands of pivots before rows of a contact were measured together; interior points need few steps.
TEST(Recorded, SettledHeapTakesNoPivots) {
  char why[256];
  mlcp_problem* loaded = nullptr;
  ASSERT_EQ(mlcp_snapshot_load(MLCP_RECORDED_FOLDER "/settled_heap.mlcp", nullptr, &loaded, nullptr, nullptr, nullptr, why, sizeof why), MLCP_OK) << why;
  const ProblemHandle problem(loaded);
  const SolverHandle solver = make_solver();
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  ASSERT_EQ(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, &report), MLCP_OK);
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_LE(report.largest_error, 1e-9);
  EXPECT_EQ(report.fallbacks, 0);
  EXPECT_LE(report.pivots, 400);
  EXPECT_GE(report.contacts_sticking + report.contacts_sliding, 250);
}

}  // namespace
