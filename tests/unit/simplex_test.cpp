// The simplex on the cases that have broken solvers.
#include "solve/simplex.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

constexpr mlcp_pivot_rule rules[] = {MLCP_PIVOT_DUAL, MLCP_PIVOT_PRINTED};

/// Both rules solve it, with the errors asked for.
void expect_solved(const mlcp::Problem& problem, double most = 1e-12) {
  const Dense d = dense(problem);
  for (const mlcp_pivot_rule rule : rules) EXPECT_EQ(fault(d, solve(problem, settings(rule)), most), "") << "rule " << rule;
}

/// Both rules prove that there is no solution; returns the rows that conflict, sorted.
std::vector<std::int32_t> conflict(const mlcp::Problem& problem) {
  const Dense d = dense(problem);
  std::vector<std::int32_t> rows;
  for (const mlcp_pivot_rule rule : rules) {
    const Solution s = solve(problem, settings(rule));
    EXPECT_EQ(infeasible_fault(d, s), "") << "rule " << rule;
    for (const double v : s.v) EXPECT_TRUE(std::isfinite(v)) << "what an infeasible island leaves is finite";
    rows = s.certificate_row;
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

mlcp::Problem falling_body(int dimension, double mass = 1) {
  mlcp::Problem p = empty_problem();
  add_body(p, dimension, mass);
  Eigen::VectorXd k = Eigen::VectorXd::Zero(dimension);
  k[0] = -9.81 * mass;
  set_k(p, k);
  return p;
}

/// Bodies of one velocity in a column, the lowest on the ground.
mlcp::Problem column(const std::vector<double>& masses, Bounds bounds = unilateral) {
  mlcp::Problem p = empty_problem();
  Eigen::VectorXd k(static_cast<int>(masses.size()));
  for (std::size_t b = 0; b < masses.size(); ++b) {
    add_body(p, 1, masses[b]);
    k[static_cast<int>(b)] = -9.81 * masses[b];
  }
  set_k(p, k);
  for (int b = 0; b < k.size(); ++b) {
    if (b == 0) add_row(p, {{0, 1}}, 0, bounds);
    else add_row(p, {{b, 1}, {b - 1, -1}}, 0, bounds);
  }
  return p;
}

TEST(Simplex, BoxOnAPlane) {
  mlcp::Problem p = falling_body(6, 3);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) add_row(p, {{0, 1}, {4, x}, {5, y}});
  expect_solved(p);
  for (const double v : solve(p).v) EXPECT_NEAR(v, 0, 1e-14);
}

TEST(Simplex, TableOnAHundredLegs) {
  mlcp::Problem p = falling_body(3);
  for (int i = 0; i < 100; ++i) add_row(p, {{0, 1}, {1, std::cos(i)}, {2, std::sin(i)}});
  expect_solved(p);
}

TEST(Simplex, MassRatiosWithTheHeavyEndOnTop) {
  for (double ratio = 1e2; ratio < 2e12; ratio *= 1e2) {
    std::vector<double> masses(20, 1.0);
    masses.back() = ratio;
    expect_solved(column(masses));
    expect_solved(column(masses, bilateral));
    const Solution s = solve(column(masses));
    EXPECT_NEAR(s.gamma[0], 9.81 * (19 + ratio), 1e-9 * ratio) << ratio;
  }
}

TEST(Simplex, MassesThatGrowAlongTheChain) {
  std::vector<double> up, down;
  for (int b = 0; b < 25; ++b) up.push_back(std::pow(3.0, b));
  down.assign(up.rbegin(), up.rend());
  expect_solved(column(up));
  expect_solved(column(down));
}

TEST(Simplex, NearlyParallelContacts) {
  for (const double angle : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-14}) {
    mlcp::Problem p = falling_body(2);
    add_row(p, {{0, 1}, {1, angle}});
    add_row(p, {{0, 1}, {1, -angle}});
    add_row(p, {{0, 1}, {1, 2 * angle}}, 1e-3 * angle);
    expect_solved(p);
  }
}

TEST(Simplex, NarrowWedge) {
  for (const double angle : {1e-1, 1e-3, 1e-5}) {
    mlcp::Problem p = falling_body(2);
    add_row(p, {{0, angle}, {1, 1}});
    add_row(p, {{0, angle}, {1, -1}});
    expect_solved(p);
    EXPECT_NEAR(solve(p).gamma[0], 9.81 / (2 * angle), 1e-9 / angle);
  }
}

TEST(Simplex, RowsOfLength1em8And1e8) {
  mlcp::Problem p = column({1, 2, 3, 4});
  add_row(p, {{0, 1e-8}}, 1e-9);
  add_row(p, {{1, 1e8}}, 3e7);
  add_row(p, {{2, 1e8}, {3, -1e8}}, -5e6, bilateral);
  add_row(p, {{3, 1e-8}}, -1e-9);
  expect_solved(p);
  EXPECT_NEAR(solve(p).v[1], 0.3, 1e-12);
}

TEST(Simplex, DuplicateRows) {
  mlcp::Problem p = falling_body(1);
  for (int i = 0; i < 30; ++i) add_row(p, {{0, i % 3 == 0 ? 1.0 : i % 3 == 1 ? 0.25 : 7.0}});
  expect_solved(p);
  EXPECT_NEAR(solve(p).v[0], 0, 1e-15);
}

TEST(Simplex, LowerBoundEqualsUpper) {
  mlcp::Problem p = falling_body(1);
  add_row(p, {{0, 1}}, 0, {2, 2});
  add_row(p, {{0, -1}}, 0, {0, 0});
  expect_solved(p);
  EXPECT_NEAR(solve(p).v[0], -7.81, 1e-14);
  EXPECT_EQ(solve(p).gamma[0], 2);
}

TEST(Simplex, MotorBelowAtAndAboveItsLimit) {
  for (const double speed : {-9.0, 0.0, 5.0}) {
    mlcp::Problem p = falling_body(1);
    add_row(p, {{0, 1}}, speed, {-10, 10});
    expect_solved(p);
    const double needed = speed + 9.81;
    EXPECT_NEAR(solve(p).gamma[0], std::min(10.0, needed), 1e-14);
  }
}

TEST(Simplex, ImpulseBoundsWithoutZero) {
  mlcp::Problem p = falling_body(1);
  add_row(p, {{0, 1}}, 0, {3, 5});
  add_row(p, {{0, 1}}, 0, {-mlcp::infinity, -1});
  expect_solved(p);
}

TEST(Simplex, DependentBilateralRowsThatAgree) {
  mlcp::Problem p = falling_body(3);
  add_row(p, {{0, 1}, {1, 1}}, 1, bilateral);
  add_row(p, {{1, 1}, {2, 1}}, 2, bilateral);
  add_row(p, {{0, 1}, {1, 2}, {2, 1}}, 3, bilateral);
  add_row(p, {{0, 1}, {2, -1}}, -1, bilateral);
  expect_solved(p);
}

TEST(Simplex, DependentBilateralRowsThatContradict) {
  mlcp::Problem p = falling_body(3);
  add_row(p, {{0, 1}, {1, 1}}, 1, bilateral);
  add_row(p, {{1, 1}, {2, 1}}, 2, bilateral);
  add_row(p, {{0, 1}, {1, 2}, {2, 1}}, 4, bilateral);
  EXPECT_EQ(conflict(p), (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(Simplex, BodySqueezedBetweenMovingWalls) {
  mlcp::Problem p = falling_body(2);
  const int left = add_body(p, 2, 1), right = add_body(p, 2, 1);
  prescribe(p, left, {0, 1});
  prescribe(p, right, {0, -1});
  add_row(p, {{0, 1}});                  // the floor is no part of it
  add_row(p, {{1, 1}, {3, -1}});         // right of the left wall
  add_row(p, {{1, -1}, {5, 1}});         // left of the right wall
  EXPECT_EQ(conflict(p), (std::vector<std::int32_t>{1, 2}));
  const Solution s = solve(p);
  EXPECT_NEAR(s.v[1], 0, 1e-6) << "the least violation is in the middle";
  EXPECT_NEAR(s.v[0], 0, 1e-5) << "the floor still holds";
}

TEST(Simplex, ChainSqueezedAtBothEnds) {
  mlcp::Problem p = empty_problem();
  const int links = 10;
  for (int b = 0; b < links; ++b) add_body(p, 1, 1);
  add_row(p, {{0, 1}}, 1);
  for (int b = 1; b < links; ++b) add_row(p, {{b, 1}, {b - 1, -1}});
  add_row(p, {{links - 1, -1}}, 0);
  EXPECT_EQ(conflict(p).size(), 11u) << "every row is needed";
}

TEST(Simplex, AlmostInfeasible) {
  for (const double gap : {1e-6, 1e-9, 1e-12}) {
    mlcp::Problem p = falling_body(1);
    add_row(p, {{0, 1}}, 1);
    add_row(p, {{0, -1}}, -1 - gap);
    expect_solved(p);
    mlcp::Problem q = falling_body(1);
    add_row(q, {{0, 1}}, 1 + gap);
    add_row(q, {{0, -1}}, -1);
    const Solution s = solve(q);
    if (s.report.outcome == MLCP_SOLVED) EXPECT_LE(gap, s.report.largest_error * 12 + 1e-12) << "the scale is |v| + |v0| + |r| = 11.81";
    else EXPECT_EQ(infeasible_fault(dense(q), s), "") << gap;
  }
}

TEST(Simplex, ZeroRows) {
  mlcp::Problem p = empty_problem();
  add_row(p, {}, 0);
  add_row(p, {}, -1);
  add_row(p, {}, 0, bilateral);
  add_row(p, {}, 1, {-2, 3});
  add_row(p, {}, -1, {-2, 3});
  expect_solved(p);
  const Solution s = solve(p);
  EXPECT_EQ(s.gamma[3], 3);
  EXPECT_EQ(s.gamma[4], -2);
}

TEST(Simplex, ZeroRowThatCannotHoldIsNamed) {
  for (const auto& [bounds, r] :
       {std::pair{unilateral, 1.0}, {bilateral, 1.0}, {bilateral, -1.0}, {Bounds{-mlcp::infinity, 0}, -1.0}}) {
    mlcp::Problem p = falling_body(1);
    add_row(p, {{0, 1}});
    add_row(p, {}, r, bounds);
    EXPECT_EQ(conflict(p), std::vector<std::int32_t>{1});
  }
}

TEST(Simplex, RowOfExplicitZeros) {
  mlcp::Problem p = falling_body(2);
  add_row(p, {{0, 0.0}, {1, 0.0}}, -1);
  add_row(p, {{0, 0.0}, {1, 0.0}}, 0);
  expect_solved(p);
  add_row(p, {{0, 0.0}, {1, 0.0}}, 1e-3);
  EXPECT_EQ(conflict(p), std::vector<std::int32_t>{2});
}

}  // namespace
}  // namespace support
