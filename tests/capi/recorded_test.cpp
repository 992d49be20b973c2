// Steps of our own scenes that were hard once, as they were recorded.
#include "support.h"

using namespace capi;

namespace {

mlcp_report solve(const char* name) {
  char why[256];
  mlcp_problem* loaded = nullptr;
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  EXPECT_EQ(mlcp_snapshot_load((std::string(MLCP_RECORDED_FOLDER "/") + name).c_str(), nullptr, &loaded, nullptr, nullptr, nullptr, why, sizeof why), MLCP_OK) << why;
  if (!loaded) return report;
  const ProblemHandle problem(loaded);
  const SolverHandle solver = make_solver();
  EXPECT_EQ(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, &report), MLCP_OK);
  return report;
}

/// A cascade of bodies that has come to rest: three generators for every velocity, nearly all of them at work, and contacts where one generator has
/// no velocity but rounding. It was thousands of pivots before rows of a contact were measured together; interior points need few steps.
TEST(Recorded, SettledHeapTakesNoPivots) {
  const mlcp_report report = solve("settled_heap.mlcp");
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_LE(report.largest_error, 1e-9);
  EXPECT_EQ(report.fallbacks, 0);
  EXPECT_LE(report.pivots, 400);
  EXPECT_GE(report.contacts_sticking + report.contacts_sliding, 250);
}

/// A linkage whose motor holds it against a stop: impulses of 1 N s, velocities that are 0, and one joint that carries 6e-29 N s. Double precision does not
/// hold that; extended precision does, unless what is so small passes for rounding.
TEST(Recorded, StalledLinkageKeepsItsSmallestImpulse) {
  const mlcp_report report = solve("stalled_linkage.mlcp");
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_LE(report.largest_error, 1e-12);
}

/// Friction pyramids as plain rows, 114 on 36 velocities, hardly infeasible: pivots from where Newton had got to led to impulses that no double balances,
/// which ended as a limit. From rows at rest they end in a proof.
TEST(Recorded, HardlyInfeasiblePyramidsEndInAProof) {
  const mlcp_report report = solve("hardly_infeasible_pyramids.mlcp");
  EXPECT_EQ(report.outcome, MLCP_INFEASIBLE);
}

}  // namespace
