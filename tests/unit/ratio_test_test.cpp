#include "solve/ratio_test.h"

#include <gtest/gtest.h>

#include "support/build.h"

namespace support {
namespace {

using Set = mlcp::ActiveSet;

/// Rows on one body in the order given, active ones with an impulse; directions by hand.
struct Rows {
  mlcp::Problem problem = empty_problem();
  mlcp::Analysis analysis{mlcp::Memory()};
  mlcp::Basis basis{mlcp::Memory()};
  mlcp::Direction direction;
  mlcp::Settings settings = mlcp::default_settings();

  explicit Rows(const std::vector<Bounds>& bounds) {
    add_body(problem, 1, 1);
    for (const Bounds& b : bounds) add_row(problem, {{0, 1}}, 0, b);
    analysis.run(problem, nullptr, true, {});
    basis.prepare(problem, analysis, settings);
    basis.work.step.assign(analysis.pattern.size(), 0.0);
    basis.work.slope.assign(problem.m(), 0.0);
    for (int i = 0; i < problem.m(); ++i) basis.set.tolerance[ordinal(i)] = bounds[i].lo == bounds[i].hi ? mlcp::infinity : 1e-12;
  }
  int ordinal(int row) const { return analysis.pattern.row_ordinal[analysis.pattern.position[problem.n() + row]]; }
  void place(int row, Set::State state, double gamma, double w) {
    basis.set.state[ordinal(row)] = state;
    basis.set.x[basis.position(ordinal(row))] = -gamma;
    basis.set.w[ordinal(row)] = w;
  }
  void move(int row, double gamma, double w) {
    basis.work.step[basis.position(ordinal(row))] = -gamma;
    basis.work.slope[ordinal(row)] = w;
  }
  mlcp::Step step(int entering, mlcp_pivot_rule rule = MLCP_PIVOT_DUAL) {
    mlcp::Step s = mlcp::ratio_test(analysis.symbolic.islands[0], basis, direction, ordinal(entering), rule);
    if (s.blocking >= 0) s.blocking = analysis.pattern.node[basis.position(s.blocking)] - problem.n();
    return s;
  }
};

void expect_step(const mlcp::Step& s, double length, int blocking, Set::State to) {
  EXPECT_DOUBLE_EQ(s.length, length);
  EXPECT_EQ(s.blocking, blocking);
  EXPECT_EQ(s.to, to);
}

TEST(RatioTest, EnteringRowArrives) {
  Rows r({unilateral});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 2);
  expect_step(r.step(0), 1.5, 0, Set::active);
}

TEST(RatioTest, EnteringRowReachesItsFarBound) {
  Rows r({{0, 1}});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 2);
  expect_step(r.step(0), 1, 0, Set::at_upper);
}

TEST(RatioTest, EnteringFromAbove) {
  Rows r({{-1, 1}});
  r.place(0, Set::at_upper, 1, 3);
  r.direction.sign = -1;
  r.move(0, -1, -2);
  expect_step(r.step(0), 1.5, 0, Set::active);
  r.place(0, Set::at_upper, 1, 30);
  expect_step(r.step(0), 2, 0, Set::at_lower);
}

TEST(RatioTest, ImpulseThatFallsToItsBoundBlocks) {
  Rows r({unilateral, unilateral});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 1);
  r.place(1, Set::active, 2, 0);
  r.move(1, -1, 0);
  expect_step(r.step(0), 2, 1, Set::at_lower);
}

TEST(RatioTest, ImpulseThatRisesToItsBoundBlocks) {
  Rows r({unilateral, {0, 4}});
  r.place(0, Set::at_lower, 0, -30);
  r.move(0, 1, 1);
  r.place(1, Set::active, 2, 0);
  r.move(1, 2, 0);
  expect_step(r.step(0), 1, 1, Set::at_upper);
}

TEST(RatioTest, BilateralRowNeverBlocks) {
  Rows r({unilateral, bilateral});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 1);
  r.place(1, Set::active, 2, 0);
  r.move(1, -100, 0);
  expect_step(r.step(0), 3, 0, Set::active);
}

TEST(RatioTest, DependentRowMayGoOnForEver) {
  Rows r({unilateral, unilateral});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 1e-16);  // rounding
  r.direction.dependent = true;
  r.place(1, Set::active, 2, 0);
  r.move(1, 1, 0);
  EXPECT_EQ(r.step(0).blocking, -1);
  r.move(1, -1, 0);
  expect_step(r.step(0), 2, 1, Set::at_lower);
}

TEST(RatioTest, SlopeOfRoundingDoesNotBlock) {
  Rows r({unilateral, unilateral});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 1);
  r.place(1, Set::active, 0, 0);
  r.move(1, -1e-14, 0);
  expect_step(r.step(0), 3, 0, Set::active);
}

TEST(RatioTest, ImpulseAlreadyBeyondItsBoundBlocksAtOnce) {
  Rows r({unilateral, unilateral});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 1);
  r.place(1, Set::active, -1e-18, 0);
  r.move(1, -1, 0);
  expect_step(r.step(0), 0, 1, Set::at_lower);
}

TEST(RatioTest, TiesGoToTheLeastRowAndToTheEnteringOneFirst) {
  Rows r({unilateral, unilateral, unilateral, unilateral});
  r.place(3, Set::at_lower, 0, -30);
  r.move(3, 1, 1);
  for (const int i : {2, 0, 1}) {
    r.place(i, Set::active, 2, 0);
    r.move(i, -1, 0);
  }
  expect_step(r.step(3), 2, 0, Set::at_lower);
  r.place(3, Set::at_lower, 0, -2);
  expect_step(r.step(3), 2, 3, Set::active);
}

TEST(RatioTest, PrintedRuleStopsAtSatisfiedRows) {
  Rows r({unilateral, unilateral, unilateral});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 1);
  r.place(1, Set::at_lower, 0, 1);
  r.move(1, 0, -1);
  expect_step(r.step(0, MLCP_PIVOT_PRINTED), 1, 1, Set::active);
  expect_step(r.step(0, MLCP_PIVOT_DUAL), 3, 0, Set::active);
}

/// The defect of the pseudocode as printed: rows that wait for their turn must not block.
TEST(RatioTest, RowsNotYetTreatedDoNotBlock) {
  Rows r({unilateral, unilateral});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 1);
  r.place(1, Set::at_lower, 0, -1);
  r.move(1, 0, -1);
  expect_step(r.step(0, MLCP_PIVOT_PRINTED), 3, 0, Set::active);
}

TEST(RatioTest, RowAtItsUpperBoundBlocksFromTheOtherSide) {
  Rows r({unilateral, {-1, 1}});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 1);
  r.place(1, Set::at_upper, 1, -2);
  r.move(1, 0, 1);
  expect_step(r.step(0, MLCP_PIVOT_PRINTED), 2, 1, Set::active);
}

TEST(RatioTest, FixedImpulseNeverBlocks) {
  Rows r({unilateral, {2, 2}});
  r.place(0, Set::at_lower, 0, -3);
  r.move(0, 1, 1);
  r.place(1, Set::at_lower, 2, 1);
  r.move(1, 0, -1);
  expect_step(r.step(0, MLCP_PIVOT_PRINTED), 3, 0, Set::active);
}

}  // namespace
}  // namespace support
