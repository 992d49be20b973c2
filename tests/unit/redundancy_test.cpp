#include "solve/redundancy.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

int count(const Solution& s) { return std::accumulate(s.redundant.begin(), s.redundant.end(), 0); }

/// A table on legs at these places: height and two tilts. Loaded off its diagonals, so that three legs bear.
mlcp::Problem table(const std::vector<std::pair<double, double>>& legs) {
  mlcp::Problem p = empty_problem();
  add_body(p, 3, 1);
  set_k(p, Eigen::Vector3d(-1, -0.3, -0.1));
  for (const auto& [x, y] : legs) add_row(p, {{0, 1}, {1, x}, {2, y}});
  return p;
}

const std::vector<std::pair<double, double>> four_legs{{1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

TEST(Redundancy, FourthLegOfATable) {
  const Solution s = solve(table(four_legs), settings());
  EXPECT_EQ(fault(dense(table(four_legs)), s), "");
  EXPECT_EQ(count(s), s.report.redundant_rows);
  EXPECT_EQ(count(s), 1);
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(s.redundant[i] && s.state[i] == MLCP_ROW_ACTIVE);
  }
}

TEST(Redundancy, NewtonFindsTheLegToo) {
  const Solution s = solve(table(four_legs));
  EXPECT_EQ(fault(dense(table(four_legs)), s), "");
  EXPECT_EQ(s.report.method, MLCP_METHOD_NEWTON);
  EXPECT_EQ(count(s), 1);
}

TEST(Redundancy, ThreeLegsNeedEachOther) {
  EXPECT_EQ(count(solve(table({{2, 0}, {-1, 2}, {-1, -2}}))), 0);
}

TEST(Redundancy, OpenContactIsNotRedundant) {
  mlcp::Problem p = table(four_legs);
  add_row(p, {{0, 1}}, -1);  // depends on the others, but does not hold
  const Solution s = solve(p);
  EXPECT_EQ(s.redundant[4], 0);
}

TEST(Redundancy, DuplicateJoint) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 1);
  for (int i = 0; i < 3; ++i) add_row(p, {{0, 1}, {1, 1}}, 1, bilateral);
  const Solution s = solve(p);
  EXPECT_EQ(s.report.outcome, MLCP_SOLVED);
  EXPECT_EQ(count(s), 2);
}

TEST(Redundancy, ComplianceMakesEveryLegBear) {
  mlcp::Problem p = empty_problem();
  add_body(p, 3, 1);
  set_k(p, Eigen::Vector3d(-1, 0, 0));
  for (const auto& [x, y] : four_legs) add_row(p, {{0, 1}, {1, x}, {2, y}}, 0, unilateral, 1e-3);
  const Solution s = solve(p);
  EXPECT_EQ(count(s), 0);
  for (const double g : s.gamma) EXPECT_NEAR(g, s.gamma[0], 1e-12);
}

TEST(Redundancy, ZeroRowThatHolds) {
  mlcp::Problem p = empty_problem();
  add_row(p, {}, 0);
  add_row(p, {}, -1);
  const Solution s = solve(p);
  EXPECT_EQ(s.redundant[0], 1);
  EXPECT_EQ(s.redundant[1], 0) << "open";
}

TEST(Redundancy, DisabledRowIsNot) {
  mlcp::Problem p = table({{1, 0}, {1, 0}});
  const mlcp::Mask enabled = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_DISABLED});
  EXPECT_EQ(count(solve(p, &enabled)), 0);
}

}  // namespace
}  // namespace support
