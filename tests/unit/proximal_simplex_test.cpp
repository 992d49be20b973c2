// Masses that are only semidefinite, by every method: rows hold what M does not, or a velocity is named.
#include <gtest/gtest.h>

#include <cmath>

#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

constexpr mlcp_method methods[] = {MLCP_METHOD_AUTO, MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON};

mlcp::Settings by(mlcp_method method) {
  mlcp::Settings s = settings();
  s.method = method;
  return s;
}

/// −1 ≤ vⱼ ≤ 1 for all velocities, as two rows each.
void add_box(mlcp::Problem& p) {
  for (int j = 0; j < p.n(); ++j)
    for (const double side : {1.0, -1.0}) add_row(p, {{j, side}}, -1);
}

/// A linear program: no mass at all, velocities between −1 and 1. The solution is the corner where k points.
TEST(SemidefiniteMass, NoneAtAllInABox) {
  for (const mlcp_method method : methods)
    for (const int n : {1, 3, 40, 300}) {
      mlcp::Problem p = empty_problem();
      add_sparse_body(p, Eigen::MatrixXd::Zero(n, n));
      Random random(n);
      for (double& k : p.momentum) k = random.uniform();
      add_box(p);
      for (int j = 1; j < n; ++j) add_row(p, {{j - 1, 1}, {j, 1}}, -5);  // never in the way; joins them
      const Solution s = solve(p, by(method));
      ASSERT_EQ(s.report.outcome, MLCP_SOLVED) << mlcp_method_text(method) << ", " << n;
      EXPECT_LE(s.report.largest_error, 1e-12);
      for (int j = 0; j < n; ++j) EXPECT_NEAR(s.v[j], p.momentum[j] > 0 ? 1 : -1, 1e-12);
    }
}

/// M = B Bᵀ of low rank in a box, with a few more rows: what the methods say is the same, and right by the problem's own numbers.
TEST(SemidefiniteMass, LowRankInABox) {
  for (int seed = 0; seed < 150; ++seed) {
    Random random(seed);
    const int n = random.integer(2, 30), rank = random.integer(0, n - 1);
    const auto uniform = [&] { return random.uniform(); };
    const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(n, std::max(rank, 1), uniform) * (rank > 0 ? 1 : 0);
    mlcp::Problem p = empty_problem();
    add_sparse_body(p, b * b.transpose());
    for (double& k : p.momentum) k = uniform();
    add_box(p);
    for (int i = random.integer(0, n); i > 0; --i) add_row(p, {{random.integer(0, n - 1) / 2, uniform()}, {n - 1, uniform()}}, -std::abs(random.uniform()));
    double energy = 0;
    for (const mlcp_method method : methods) {
      const Solution s = solve(p, by(method));
      ASSERT_EQ(s.report.outcome, MLCP_SOLVED) << mlcp_method_text(method) << ", seed " << seed;
      EXPECT_LE(s.report.largest_error, 1e-11) << mlcp_method_text(method) << ", seed " << seed;
      const Eigen::Map<const Eigen::VectorXd> v(s.v.data(), n), k(p.momentum.data(), n);
      const double e = 0.5 * (b.transpose() * v).squaredNorm() - k.dot(v);
      if (method == methods[0]) energy = e;
      EXPECT_NEAR(e, energy, 1e-10 * (1 + std::abs(energy))) << mlcp_method_text(method) << ", seed " << seed;
    }
  }
}

/// Ties everywhere: entries of M that are mostly 0, k from {−1, 0, 1}, velocities in line. Velocities without mass and without force, impulses and velocities that
/// are 0 but for rounding.
TEST(SemidefiniteMass, TiesInABox) {
  int solved = 0;
  for (int seed = 0; seed < 1500; ++seed) {
    Random random(seed);
    const int n = random.integer(2, 20), rank = random.integer(0, n - 1);
    const auto seldom = [&] { return random.chance(0.7) ? 0.0 : random.uniform(); };
    const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(n, std::max(rank, 1), seldom) * (rank > 0 ? 1 : 0);
    mlcp::Problem p = empty_problem();
    add_sparse_body(p, b * b.transpose());
    for (double& k : p.momentum) k = random.integer(-1, 1);
    add_box(p);
    for (int i = random.integer(0, n); i > 0; --i) {
      const int one = random.integer(0, n - 1), other = random.integer(0, n - 1);
      if (one != other) add_row(p, {{one, 1}, {other, -1}}, 0);
    }
    for (const mlcp_method method : methods) {
      const Solution s = solve(p, by(method));
      EXPECT_EQ(s.report.outcome, MLCP_SOLVED) << mlcp_method_text(method) << ", seed " << seed;
      EXPECT_LE(s.report.largest_error, 1e-12) << mlcp_method_text(method) << ", seed " << seed;
      solved += s.report.outcome == MLCP_SOLVED;
    }
  }
  EXPECT_EQ(solved, 4500);
}

/// A velocity without mass that rows hold one way: pushed the other way, it is the one that is named.
TEST(SemidefiniteMass, WhatNothingHoldsIsNamed) {
  for (const mlcp_method method : methods) {
    mlcp::Problem p = empty_problem();
    add_body(p, 1, 2);
    add_sparse_body(p, Eigen::MatrixXd::Zero(1, 1));
    add_row(p, {{0, 1}, {1, 1}}, 0);
    p.momentum[1] = 1;
    const Solution away = solve(p, by(method));
    EXPECT_EQ(away.report.outcome, MLCP_NOT_POSITIVE_DEFINITE) << mlcp_method_text(method);
    EXPECT_EQ(away.report.worst_velocity, 1);
    p.momentum[1] = -1;
    const Solution held = solve(p, by(method));
    EXPECT_EQ(held.report.outcome, MLCP_SOLVED) << mlcp_method_text(method);
    EXPECT_NEAR(held.gamma[0], 1, 1e-14);
    EXPECT_NEAR(held.v[1], -0.5, 1e-14);
  }
}

TEST(SemidefiniteMass, RowsThatContradictEachOtherAreStillProved) {
  for (const mlcp_method method : methods) {
    mlcp::Problem p = empty_problem();
    add_sparse_body(p, Eigen::MatrixXd::Zero(2, 2));
    add_row(p, {{0, 1}, {1, 1}}, 1);
    add_row(p, {{0, -1}, {1, -1}}, 1);
    const Solution s = solve(p, by(method));
    EXPECT_EQ(s.report.outcome, MLCP_INFEASIBLE) << mlcp_method_text(method);
    EXPECT_EQ(certificate_fault(dense(p), s.certificate_row, s.certificate_y), "");
  }
}

}  // namespace
}  // namespace support
