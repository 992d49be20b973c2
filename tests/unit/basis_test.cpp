#include "solve/basis.h"

#include <gtest/gtest.h>

#include "support/based.h"
#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

using Set = mlcp::ActiveSet;

/// Three bodies in a line, unilateral rows between them and to the ground, all pressed together.
mlcp::Problem column() {
  mlcp::Problem p = empty_problem();
  for (int b = 0; b < 3; ++b) add_body(p, 1, b + 1);
  set_k(p, Eigen::Vector3d(-1, -2, -3));
  add_row(p, {{0, 1}});
  add_row(p, {{1, 1}, {0, -1}});
  add_row(p, {{2, 1}, {1, -1}});
  return p;
}

TEST(Basis, ActivateAndDeactivateKeepTheFactorInStep) {
  Based b(column());
  b.expect_in_step();
  for (const int row : {1, 0, 2}) EXPECT_TRUE(b.basis.activate(b.island(), b.ordinal(row), b.counts));
  b.expect_in_step();
  b.basis.deactivate(b.island(), b.ordinal(0), Set::at_lower, b.counts);
  EXPECT_EQ(b.state(0), Set::at_lower);
  b.expect_in_step();
  EXPECT_EQ(b.counts.toggles, 4);
  EXPECT_EQ(b.counts.factorizations, 1);
}

TEST(Basis, ARowThatLeavesIsExactlyAtItsBound) {
  const mlcp::Mask start = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE});
  Based b(column(), &start);
  b.basis.solve_point(b.island(), b.counts);
  EXPECT_GT(b.basis.gamma(b.ordinal(0)), 1);
  b.basis.deactivate(b.island(), b.ordinal(0), Set::at_lower, b.counts);
  EXPECT_EQ(b.basis.gamma(b.ordinal(0)), 0);
}

TEST(Basis, AlwaysRefactorizeTogglesNothing) {
  Based b(column(), nullptr, settings(MLCP_PIVOT_DUAL, MLCP_REFACTORIZE_ALWAYS));
  for (const int row : {1, 0, 2}) b.basis.activate(b.island(), b.ordinal(row), b.counts);
  b.basis.deactivate(b.island(), b.ordinal(1), Set::at_lower, b.counts);
  EXPECT_EQ(b.counts.toggles, 0);
  EXPECT_EQ(b.counts.factorizations, 5);
  b.expect_in_step();
}

TEST(Basis, PointOfTheActiveSet) {
  const mlcp::Mask start = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE});
  Based b(column(), &start);
  b.basis.solve_point(b.island(), b.counts);
  EXPECT_DOUBLE_EQ(b.basis.gamma(b.ordinal(0)), 6);
  EXPECT_DOUBLE_EQ(b.basis.gamma(b.ordinal(1)), 5);
  EXPECT_DOUBLE_EQ(b.basis.gamma(b.ordinal(2)), 3);
  for (int o = 0; o < 3; ++o) EXPECT_NEAR(b.basis.set.w[o], 0, 1e-15);
}

TEST(Basis, RestIsExactlyAtTheBound) {
  mlcp::Problem p = column();
  add_row(p, {{0, 1}}, 0, {0.1, 0.3});
  Based b(std::move(p));
  b.basis.rest(b.ordinal(3), Set::at_upper);
  EXPECT_EQ(b.basis.gamma(b.ordinal(3)), 0.3);
  b.basis.rest(b.ordinal(3), Set::at_lower);
  EXPECT_EQ(b.basis.gamma(b.ordinal(3)), 0.1);
}

TEST(Basis, RowsBeyondTheirBoundsRestOnTheSideThatTheyLeft) {
  mlcp::Problem p = empty_problem();
  for (int b = 0; b < 2; ++b) add_body(p, 1, 1);
  set_k(p, Eigen::Vector2d(-5, 5));
  add_row(p, {{0, 1}, {1, 0}}, 0, {-1, 1});
  add_row(p, {{0, 0}, {1, 1}}, 0, {-1, 1});
  const mlcp::Mask start = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE});
  Based b(std::move(p), &start);
  b.basis.solve_point(b.island(), b.counts);
  const std::vector<mlcp::Flip> both{{b.ordinal(0), Set::at_upper}, {b.ordinal(1), Set::at_lower}};
  EXPECT_EQ(b.basis.change(b.island(), both, mlcp::dependent_pivot, b.counts), 0);
  EXPECT_EQ(b.state(0), Set::at_upper);
  EXPECT_EQ(b.state(1), Set::at_lower);
  b.expect_in_step();
}

TEST(Basis, ChangesInBothDirectionsAtOnce) {
  const mlcp::Mask start = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_AT_LOWER, MLCP_ROW_ACTIVE});
  Based b(column(), &start);
  const std::vector<mlcp::Flip> flips{{b.ordinal(0), Set::at_lower}, {b.ordinal(1), Set::active}};
  EXPECT_EQ(b.basis.change(b.island(), flips, mlcp::dependent_pivot, b.counts), 0);
  EXPECT_EQ(b.state(0), Set::at_lower);
  EXPECT_EQ(b.state(1), Set::active);
  EXPECT_EQ(b.state(2), Set::active);
  b.expect_in_step();
}

TEST(Basis, ChangeLeavesADependentRowAtRestAndSaysSo) {
  mlcp::Problem p = column();
  add_row(p, {{0, 1}});  // the first row again
  const mlcp::Mask start = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE, MLCP_ROW_AT_LOWER});
  Based b(std::move(p), &start);
  const std::vector<mlcp::Flip> flips{{b.ordinal(3), Set::active}};
  EXPECT_EQ(b.basis.change(b.island(), flips, mlcp::dependent_pivot, b.counts), 1);
  EXPECT_EQ(b.state(3), Set::at_lower);
  b.expect_in_step();
}

TEST(Basis, DependentRowRestsWhenFactored) {
  mlcp::Problem p = column();
  add_row(p, {{0, 1}});
  const mlcp::Mask start = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE});
  Based b(std::move(p), &start);
  EXPECT_EQ((b.state(0) == Set::active) + (b.state(3) == Set::active), 1);
  b.expect_in_step();
}

TEST(Basis, DependentBilateralRowIsOut) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_row(p, {{0, 1}}, 1, bilateral);
  add_row(p, {{0, 2}}, 2, bilateral);
  Based b(std::move(p));
  EXPECT_EQ((b.state(0) == Set::out) + (b.state(1) == Set::out), 1);
  b.expect_in_step();
}

TEST(Basis, ZeroFollowsTheToleranceWithinRounding) {
  mlcp::Settings s = mlcp::default_settings();
  for (const auto& [tolerance, zero] : {std::pair{1e-3, 1e-13}, {1e-9, 1e-13}, {1e-10, 1e-14}, {1e-15, 2e-15}}) {
    s.tolerance = tolerance;
    EXPECT_DOUBLE_EQ(Based(column(), nullptr, s).basis.zero(), zero);
  }
}

}  // namespace
}  // namespace support
