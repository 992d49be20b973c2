#include "solve/gauss_seidel.h"

#include <gtest/gtest.h>

#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

mlcp::Settings sweeps(double tolerance) {
  mlcp::Settings s = mlcp::default_settings();
  s.method = MLCP_METHOD_PGS;
  s.tolerance = tolerance;
  s.max_iterations = 20000;
  return s;
}

TEST(GaussSeidel, ReachesATenthOfAPercentOnMostChains) {
  int solved = 0;
  for (int seed = 0; seed < 30; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, 6, 3, 1);
    const Solution s = solve(p, sweeps(1e-3));
    const DenseErrors e = errors_of(dense(p), widen(s.v), widen(s.gamma));
    ASSERT_EQ(s.report.outcome, std::max(e.momentum, e.constraints) <= 1e-3L ? MLCP_SOLVED : MLCP_ITERATION_LIMIT) << "seed " << seed;
    ASSERT_EQ(s.report.method, MLCP_METHOD_PGS);
    ASSERT_EQ(s.report.factorizations, 0);
    solved += s.report.outcome == MLCP_SOLVED;
  }
  EXPECT_GE(solved, 25);
}

TEST(GaussSeidel, OneContactTakesOneSweep) {
  mlcp::Problem p = empty_problem();
  Random random(1);
  add_body(p, random_mass(random, 6, false));
  set_k(p, -Eigen::VectorXd::Ones(6));
  add_row(p, {{0, 1}, {3, 0.5}});
  const Solution s = solve(p, sweeps(1e-12));
  EXPECT_EQ(fault(dense(p), s), "");
}

TEST(GaussSeidel, LimitIsAnHonestStatus) {
  Random random(3);
  const mlcp::Problem p = random_chain(random, 60, 3, 1);
  mlcp::Settings how = sweeps(1e-14);
  how.max_iterations = 16;
  const Solution s = solve(p, how);
  EXPECT_EQ(s.report.outcome, MLCP_ITERATION_LIMIT);
  EXPECT_GT(s.report.largest_error, 1e-14);
}

TEST(GaussSeidel, LargeMassPartsGoToNewton) {
  mlcp::Problem p = empty_problem();
  Random random(5);
  add_sparse_body(p, random_mass(random, 80, false));
  set_k(p, -Eigen::VectorXd::Ones(80));
  for (int j = 0; j < 10; ++j) add_row(p, {{j, 1}});
  const Solution s = solve(p, sweeps(1e-9));
  EXPECT_EQ(s.report.method, MLCP_METHOD_NEWTON);
  EXPECT_EQ(fault(dense(p), s), "");
}

TEST(GaussSeidel, ImpulsesOfTheStartMaskSaveSweeps) {
  Random random(8);
  const mlcp::Problem p = random_chain(random, 30, 3, 1);
  mlcp::Settings how = sweeps(1e-4);
  mlcp::Solver solver(how, mlcp::Memory());
  const Solution cold = solve(solver, p);
  mlcp::Mask start = mask_of(cold.state);
  start.impulse.assign(std::span<const double>(cold.gamma));
  const Solution warm = solve(p, how, nullptr, &start);
  EXPECT_EQ(warm.report.pivots, 0);
  EXPECT_GT(cold.report.pivots, 0);
}

/// A sweep over a large island takes long enough: no more of them once the time is over.
TEST(GaussSeidel, AGuessEndsWithTheTime) {
  Random random(3);
  const mlcp::Problem p = random_chain(random, 200, 3, 1);
  mlcp::Settings how = mlcp::default_settings();
  how.method = MLCP_METHOD_NEWTON;
  EXPECT_GT(solve(p, how).report.pivots, 10);
  how.max_seconds = 1e-12;
  const Solution s = solve(p, how);
  EXPECT_EQ(s.report.outcome, MLCP_TIME_LIMIT);
  EXPECT_LE(s.report.pivots, s.report.islands);
}

}  // namespace
}  // namespace support
