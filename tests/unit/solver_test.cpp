#include "solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assemble/bodies.h"
#include "assemble/rows.h"
#include "assemble/values.h"
#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

mlcp::Problem body_on_the_ground() {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 2);
  set_k(p, Eigen::VectorXd::Constant(1, -2));
  add_row(p, {{0, 1}});
  return p;
}

/// One island that is solved, one that is squeezed, one whose mass is indefinite.
mlcp::Problem three_islands() {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 2);
  add_body(p, 1, 1);
  add_sparse_body(p, (Eigen::Matrix2d() << 1, 2, 2, 1).finished());
  set_k(p, Eigen::Vector4d(-2, 0, 1, 1));
  add_row(p, {{0, 1}});
  add_row(p, {{1, 1}}, 1);
  add_row(p, {{1, -1}}, 1);
  add_row(p, {{2, 1}, {3, 1}});
  return p;
}

TEST(Solver, EmptyProblem) {
  const Solution s = solve(empty_problem());
  EXPECT_EQ(s.report.outcome, MLCP_SOLVED);
  EXPECT_EQ(s.report.islands, 0);
  EXPECT_EQ(s.report.worst_row, -1);
  EXPECT_EQ(s.report.worst_velocity, -1);
}

TEST(Solver, BodiesWithoutRows) {
  mlcp::Problem p = empty_problem();
  Random random(1);
  add_body(p, 3, 2);
  add_body(p, random_mass(random, 4, false));
  add_sparse_body(p, random_mass(random, 20, true));
  set_k(p, Eigen::VectorXd::LinSpaced(27, -1, 1));
  const Solution s = solve(p);
  EXPECT_EQ(fault(dense(p), s), "");
  EXPECT_LE(difference(s.v, velocities(dense(p), Vector(0))), 1e-14);
}

TEST(Solver, RowsWithoutBodies) {
  mlcp::Problem p = empty_problem();
  for (int i = 0; i < 3; ++i) add_row(p, {}, -i);
  const Solution s = solve(p);
  EXPECT_EQ(s.report.outcome, MLCP_SOLVED);
  EXPECT_EQ(s.report.islands, 3);
}

TEST(Solver, EachIslandHasItsOwnOutcome) {
  const Solution s = solve(three_islands());
  EXPECT_EQ(s.report.islands, 3);
  EXPECT_EQ(s.report.islands_failed, 2);
  EXPECT_EQ(s.report.outcome, MLCP_NOT_POSITIVE_DEFINITE) << "the worst speaks for all";
  EXPECT_EQ(s.report.worst_body, 2);
  EXPECT_EQ(s.island_outcome[s.row_island[0]], MLCP_SOLVED);
  EXPECT_EQ(s.island_outcome[s.row_island[1]], MLCP_INFEASIBLE);
  EXPECT_EQ(s.row_island[1], s.row_island[2]);
  EXPECT_EQ(s.island_outcome[s.row_island[3]], MLCP_NOT_POSITIVE_DEFINITE);
  EXPECT_NEAR(s.v[0], 0, 1e-15) << "a bad island spoils no other";
  EXPECT_EQ(s.gamma[0], 2);
  EXPECT_EQ(certificate_fault(dense(three_islands()), s.certificate_row, s.certificate_y), "");
  for (const double v : s.v) EXPECT_TRUE(std::isfinite(v));
}

TEST(Solver, IndefiniteMassOfAFreeBodyIsNamed) {
  mlcp::Problem p = body_on_the_ground();
  add_sparse_body(p, Eigen::MatrixXd::Zero(1, 1));
  const Solution s = solve(p);
  EXPECT_EQ(s.report.outcome, MLCP_NOT_POSITIVE_DEFINITE);
  EXPECT_EQ(s.report.worst_body, 1);
}

TEST(Solver, PrescribedBodyMayHaveAnyMass) {
  mlcp::Problem p = three_islands();
  prescribe(p, 2, {1, 1});
  EXPECT_EQ(solve(p).report.outcome, MLCP_INFEASIBLE);
  prescribe(p, 1, {0});
  const Solution s = solve(p);
  EXPECT_EQ(s.v[2], 1);
  EXPECT_EQ(s.report.worst_body, -1);
}

TEST(Solver, DisabledRowsAreNotThere) {
  const mlcp::Problem p = three_islands();
  const mlcp::Mask enabled = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_DISABLED, MLCP_ROW_ACTIVE, MLCP_ROW_DISABLED});
  const Solution s = solve(p, &enabled);
  EXPECT_EQ(s.state[1], MLCP_ROW_DISABLED);
  EXPECT_EQ(s.row_island[1], -1);
  EXPECT_EQ(s.gamma[1], 0);
  EXPECT_EQ(s.report.enabled_rows, 2);
  EXPECT_NEAR(s.v[1], -1, 1e-15);
}

TEST(Solver, MaskOfTheWrongLengthIsRefused) {
  const mlcp::Problem p = body_on_the_ground();
  const mlcp::Mask wrong = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE});
  EXPECT_THROW(solve(p, &wrong), mlcp::Error);
  EXPECT_THROW(solve(p, nullptr, &wrong), mlcp::Error);
}

TEST(Solver, AnalysisIsKeptWhileThePatternStays) {
  mlcp::Solver solver(mlcp::default_settings(), mlcp::Memory());
  mlcp::Problem p = body_on_the_ground();
  EXPECT_EQ(solve(solver, p).report.analyzed, 1);
  set_k(p, Eigen::VectorXd::Constant(1, 5));
  const Solution s = solve(solver, p);
  EXPECT_EQ(s.report.analyzed, 0);
  EXPECT_EQ(s.v[0], 2.5);
  add_row(p, {{0, 1}});
  EXPECT_EQ(solve(solver, p).report.analyzed, 1);
}

TEST(Solver, OrderingCanBeImposedAndReadBack) {
  Random random(3);
  const mlcp::Problem p = random_chain(random, 5, 2, 1);
  mlcp::Solver first(mlcp::default_settings(), mlcp::Memory()), second(mlcp::default_settings(), mlcp::Memory());
  EXPECT_TRUE(first.ordering().empty());
  const Solution a = solve(first, p);
  second.impose_ordering(first.ordering());
  const Solution b = solve(second, p);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.gamma, b.gamma);
  EXPECT_TRUE(std::equal(first.ordering().begin(), first.ordering().end(), second.ordering().begin(), second.ordering().end()));
}

TEST(Solver, SameInputSameBits) {
  Random random(4);
  const mlcp::Problem p = random_chain(random, 30, 3, 1);
  const Solution a = solve(p), b = solve(p);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.gamma, b.gamma);
  EXPECT_EQ(a.report.work, b.report.work);
}

TEST(Solver, IterationLimitTellsTheTruth) {
  Random random(5);
  const mlcp::Problem p = random_chain(random, 30, 3, 1);
  mlcp::Settings how = settings();
  how.max_iterations = 1;
  const Solution s = solve(p, how);
  EXPECT_EQ(s.report.outcome, MLCP_ITERATION_LIMIT);
  EXPECT_EQ(s.report.pivots, 1);
  EXPECT_GT(s.report.largest_error, how.tolerance);
  const DenseErrors e = errors_of(dense(p), widen(s.v), widen(s.gamma));
  EXPECT_NEAR(s.report.constraint_error, static_cast<double>(e.constraints), 1e-12);
}

TEST(Solver, WorkLimitIsTheSameEverywhere) {
  Random random(6);
  const mlcp::Problem p = random_chain(random, 30, 3, 1);
  mlcp::Settings how = settings();
  how.max_work = solve(p, how).report.work / 2;
  const Solution s = solve(p, how), t = solve(p, how);
  EXPECT_EQ(s.report.outcome, MLCP_WORK_LIMIT);
  EXPECT_EQ(s.v, t.v);
}

TEST(Solver, LooseToleranceAcceptsWhatALimitLeft) {
  Random random(5);
  const mlcp::Problem p = random_chain(random, 30, 3, 1);
  mlcp::Settings how = mlcp::default_settings();
  how.max_iterations = 1;
  how.tolerance = 10;
  EXPECT_EQ(solve(p, how).report.outcome, MLCP_SOLVED) << "an error within the tolerance is a solution";
}

TEST(Solver, TraceHasEveryPivot) {
  Random random(7);
  const mlcp::Problem p = random_chain(random, 20, 2, 1);
  mlcp::Settings how = settings();
  EXPECT_TRUE(solve(p, how).trace.empty());
  how.trace = 1;
  const Solution s = solve(p, how);
  ASSERT_EQ(static_cast<std::int64_t>(s.trace.size()), s.report.pivots);
  ASSERT_FALSE(s.trace.empty());
  for (const mlcp_pivot& t : s.trace) {
    EXPECT_GE(t.entering, 0);
    EXPECT_LT(t.entering, p.m());
    EXPECT_EQ(t.island, s.row_island[t.entering]);
    EXPECT_TRUE(t.dependent || t.blocking != t.entering || t.schur > 0);
    EXPECT_LT(t.violation * t.step, 1e-300) << "the impulse moves against the violation";
  }
}

TEST(Solver, CountsAddUp) {
  Random random(8);
  const mlcp::Problem p = random_chain(random, 20, 2, 1);
  mlcp::Settings with_toggles = settings(), without = settings(MLCP_PIVOT_DUAL, MLCP_REFACTORIZE_ALWAYS);
  with_toggles.method = without.method = MLCP_METHOD_SIMPLEX;
  const Solution toggled = solve(p, with_toggles), fresh = solve(p, without);
  EXPECT_GT(toggled.report.toggles, 0);
  EXPECT_EQ(fresh.report.toggles, 0);
  EXPECT_GT(fresh.report.factorizations, toggled.report.factorizations);
  EXPECT_GT(fresh.report.work, toggled.report.work);
  EXPECT_EQ(toggled.report.enabled_rows, p.m());
  EXPECT_EQ(toggled.report.active_rows, std::count(toggled.state.begin(), toggled.state.end(), MLCP_ROW_ACTIVE));
}

TEST(Solver, KeysComeBackWithTheMask) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_row(p, {{0, 1}}, 0, unilateral, 0, 77);
  mlcp::Solver solver(mlcp::default_settings(), mlcp::Memory());
  solve(solver, p);
  ASSERT_EQ(solver.result().mask.key.size(), 1u);
  EXPECT_EQ(solver.result().mask.key[0], 77u);
}

}  // namespace
}  // namespace support
