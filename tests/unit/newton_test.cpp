// Newton on what breaks active-set guesses: dependent rows, crowded islands, ties, and problems without a solution.
#include "solve/newton.h"

#include <gtest/gtest.h>

#include "../../capi/handles.h"
#include "assemble/compliance.h"
#include "measure/errors.h"
#include "scenes/scenes.h"
#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

mlcp::Settings with(mlcp_method method) {
  mlcp::Settings s = mlcp::default_settings();
  s.method = method;
  return s;
}

/// Boxes of three velocities on each other, with four contacts to the one below.
mlcp::Problem stack(int boxes, int contacts = 4) {
  mlcp::Problem p = empty_problem();
  Eigen::VectorXd k = Eigen::VectorXd::Zero(3 * boxes);
  for (int b = 0; b < boxes; ++b) {
    add_body(p, 3, 1 + 0.1 * b);
    k[3 * b] = -9.81;
  }
  set_k(p, k);
  for (int b = 0; b < boxes; ++b)
    for (int c = 0; c < contacts; ++c) {
      const double x = std::cos(1.3 * c), y = std::sin(2.1 * c);
      std::vector<Entry> entries{{3 * b, 1}, {3 * b + 1, x}, {3 * b + 2, y}};
      if (b > 0)
        for (int j = 0; j < 3; ++j) entries.push_back({3 * (b - 1) + j, -entries[j].value});
      add_row(p, entries);
    }
  return p;
}

TEST(Newton, ChainsAgreeWithTheSimplex) {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, random.integer(2, 40), 3, 1);
    const Solution exact = solve(p, settings()), s = solve(p, with(MLCP_METHOD_NEWTON));
    ASSERT_EQ(fault(dense(p), s), "") << "seed " << seed;
    ASSERT_EQ(s.report.method, MLCP_METHOD_NEWTON);
    ASSERT_LE(difference(s.v, exact.v), 1e-10) << "seed " << seed;
    ASSERT_LT(s.report.pivots, exact.report.pivots + 20) << "seed " << seed;
  }
}

/// On this positive definite A whole steps go round: {2, 3}, {0, 2}, {0, 1, 2, 3}, {0, 3} and again.
TEST(Newton, RowsThatUndoEachOthersChangesAreToldApart) {
  const Eigen::Matrix4d A{{22, -13, -9, -22}, {-13, 34, -4, 25}, {-9, -4, 7, 5}, {-22, 25, 5, 33}};
  const mlcp::Problem p = reduced_problem(A, Eigen::Vector4d(1.5, 9.5, -4.5, -1.5));
  const mlcp::Mask start = mask_of({MLCP_ROW_AT_LOWER, MLCP_ROW_AT_LOWER, MLCP_ROW_AT_LOWER, MLCP_ROW_AT_LOWER});
  const Solution s = solve(p, with(MLCP_METHOD_NEWTON), nullptr, &start);
  EXPECT_EQ(fault(dense(p), s), "");
  EXPECT_EQ(s.report.fallbacks, 0);
  EXPECT_LT(s.report.pivots, 10);
}

TEST(Newton, DependentContactsOfAStack) {
  for (const int boxes : {1, 5, 20}) {
    const mlcp::Problem p = stack(boxes);
    const Solution s = solve(p, with(MLCP_METHOD_NEWTON));
    EXPECT_EQ(fault(dense(p), s), "") << boxes;
    EXPECT_LE(difference(s.v, solve(p, settings()).v), 1e-10) << boxes;
  }
}

TEST(Newton, CrowdedStack) {
  const mlcp::Problem p = stack(6, 12);
  const Solution s = solve(p, with(MLCP_METHOD_NEWTON));
  EXPECT_EQ(fault(dense(p), s), "");
  EXPECT_EQ(s.report.method, MLCP_METHOD_NEWTON);
  EXPECT_LT(s.report.factor_entries, solve(p, settings()).report.factor_entries) << "rows come before velocities";
  EXPECT_LE(difference(s.v, solve(p, settings()).v), 1e-9);
}

/// Random crowded islands: more rows than velocities, most of them near each other.
TEST(Newton, CrowdedIslandsAgreeWithTheSimplex) {
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    mlcp::Problem p = empty_problem();
    const int n = random.integer(6, 16);
    Eigen::VectorXd k(n), inside(n);
    for (int j = 0; j < n; ++j) {
      add_body(p, 1, random.integer(1, 5));
      k[j] = random.uniform();
      inside[j] = random.uniform();
    }
    set_k(p, k);
    for (int i = 0; i < 3 * n; ++i) {
      std::vector<Entry> entries;
      double r = -random.integer(0, 2) * 0.1;
      for (int j = 0; j < n; ++j)
        if (j == i % n || random.chance(0.3)) entries.push_back({j, static_cast<double>(random.integer(-2, 2))});
      for (const Entry& e : entries) r += e.value * inside[e.column];
      add_row(p, entries, r);
    }
    const Solution s = solve(p, with(MLCP_METHOD_AUTO));
    ASSERT_EQ(fault(dense(p), s), "") << "seed " << seed;
    ASSERT_LE(difference(s.v, solve(p, settings()).v), 1e-9) << "seed " << seed;
  }
}

TEST(Newton, InfeasibleCrowdedIslandGetsItsCertificate) {
  mlcp::Problem p = stack(4, 8);
  add_row(p, {{0, 1}}, 1);
  add_row(p, {{0, -1}}, 1);
  for (const mlcp_method method : {MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO}) {
    const Solution s = solve(p, with(method));
    EXPECT_EQ(infeasible_fault(dense(p), s), "");
    EXPECT_EQ(s.report.fallbacks, 1);
    EXPECT_EQ(s.report.method, MLCP_METHOD_AUTO) << "newton, then the simplex";
  }
}

/// Too large an island for another look in extended precision.
TEST(Newton, ViolatedRowThatNoImpulseMovesIsAProof) {
  for (const double r : {1.0, 1e-9}) {  // the other rows ask for much more
    mlcp::Problem p = stack(40, 3);
    add_row(p, {{0, 0}}, r);
    const Solution s = solve(p, with(MLCP_METHOD_NEWTON));
    EXPECT_EQ(infeasible_fault(dense(p), s), "") << r;
  }
}

TEST(Newton, LeastNormLoadsTableLegsEqually) {
  mlcp::Problem p = empty_problem();
  add_body(p, 3, 1);
  set_k(p, Eigen::Vector3d(-8, 0, 0));
  for (const auto& [x, y] : {std::pair{1., 1.}, {1., -1.}, {-1., 1.}, {-1., -1.}}) add_row(p, {{0, 1}, {1, x}, {2, y}});
  for (const mlcp_method method : {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO}) {
    mlcp::Settings how = with(method);
    how.impulses = MLCP_IMPULSES_LEAST_NORM;
    const Solution s = solve(p, how);
    EXPECT_EQ(fault(dense(p), s), "") << method;
    for (const double gamma : s.gamma) EXPECT_NEAR(gamma, 2, 1e-10) << method;
  }
}

TEST(Newton, CanonicalAnswersHaveTheSameBits) {
  for (int seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, 20, 3, 1);
    mlcp::Settings newton = with(MLCP_METHOD_NEWTON), simplex = with(MLCP_METHOD_SIMPLEX);
    newton.canonical = simplex.canonical = 1;
    const mlcp::Mask start = random_mask(random, p.m());
    const Solution a = solve(p, newton), b = solve(p, simplex), c = solve(p, newton, nullptr, &start);
    ASSERT_EQ(fault(dense(p), a), "") << "seed " << seed;
    ASSERT_EQ(a.v, b.v) << "seed " << seed;
    ASSERT_EQ(a.gamma, b.gamma) << "seed " << seed;
    ASSERT_EQ(a.v, c.v) << "seed " << seed;
    ASSERT_EQ(a.gamma, c.gamma) << "seed " << seed;
  }
}

TEST(Newton, BodyThatLargeImpulsesHoldAtRest) {
  // ties across a pin: the velocities are 0 because impulses cancel, and every term of a row is rounding
  mlcp::Problem p = empty_problem();
  for (int b = 0; b < 3; ++b) add_body(p, 3, 0.3 + b);
  Eigen::VectorXd k = Eigen::VectorXd::Zero(9);
  for (int b = 0; b < 3; ++b) k[3 * b + 1] = -9.81 * (0.3 + b) * 0.01;
  set_k(p, k);
  for (int j = 0; j < 3; ++j) add_row(p, {{j, 1}, {(j + 1) % 3, 0.1}}, 0, bilateral);
  for (int b = 1; b < 3; ++b)
    for (int j = 0; j < 3; ++j) add_row(p, {{3 * b + j, 1}, {3 * (b - 1) + j, -1}, {3 * b + (j + 1) % 3, 0.37}}, 0, bilateral);
  for (const mlcp_method method : {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON}) EXPECT_EQ(fault(dense(p), solve(p, with(method))), "") << method;
}

/// Each of the first rows once more, further out by what data is rounded by: the nearer one gives way.
TEST(Newton, RowsThatDifferByARoundingAreToldApart) {
  for (const double gap : {1e-10, 1e-11, 1e-12, 1e-13})
    for (const int boxes : {2, 3, 6}) {
      mlcp::Problem p = stack(boxes, 3);
      for (int i = 0; i < boxes; ++i) {
        std::vector<Entry> entries;
        for (auto t = p.jacobian.pointers[i]; t < p.jacobian.pointers[i + 1]; ++t) entries.push_back({p.jacobian.indices[t], p.jacobian.values[t]});
        add_row(p, entries, gap * (1 + i));
      }
      const Solution s = solve(p, with(MLCP_METHOD_NEWTON));
      EXPECT_EQ(fault(dense(p), s, 1e-13), "") << gap << ", " << boxes;
      EXPECT_EQ(s.report.method, MLCP_METHOD_NEWTON) << gap << ", " << boxes;
      EXPECT_EQ(s.report.fallbacks, 0) << gap << ", " << boxes;
      EXPECT_LE(difference(s.v, solve(p, settings()).v), 1e-12) << gap << ", " << boxes;
    }
}

/// Four contacts a face, of which one is too many, with coordinates that are rounded: some hundred pivots tell which of them gives way.
TEST(Newton, WallsWhoseRowsContradictEachOtherByARounding) {
  const scenes::Problem scene = scenes::wall(14, 14);
  const mlcp::Problem& p = scene->problem;
  for (const mlcp_method method : {MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO}) {
    const Solution s = solve(p, with(method));
    EXPECT_EQ(s.report.outcome, MLCP_SOLVED) << method;
    EXPECT_EQ(s.report.method, MLCP_METHOD_NEWTON) << method;
    EXPECT_EQ(s.report.fallbacks, 0) << method;
    EXPECT_LT(s.report.pivots, 200) << method;
    EXPECT_LE(mlcp::Measure(mlcp::Memory()).run(p, nullptr, s.v, s.gamma).largest(), 1e-12) << method;
    for (const double v : s.v) ASSERT_LE(std::abs(v), 1e-10) << "a wall at rest";
  }
}

/// w = u uᵀγ − c: what pushes one way lets go the other way, so that impulses grow without end, and with them the terms that errors are relative to.
TEST(Newton, ImpulsesThatGrowAreThoseOfNoRounding) {
  for (int seed = 0; seed < 8; ++seed) {
    Random random(seed);
    const int rows = 40 + 2 * seed;
    Eigen::VectorXd u(rows), b(rows);
    for (int i = 0; i < rows; ++i) {
      u[i] = (i % 2 ? 1 : -1) * random.integer(1, 4);
      b[i] = -random.integer(1, 4);
    }
    const mlcp::Problem p = reduced_problem(u * u.transpose(), b);
    const Solution s = solve(p, with(MLCP_METHOD_NEWTON));
    EXPECT_EQ(infeasible_fault(dense(p), s), "") << "seed " << seed;
    EXPECT_EQ(s.report.fallbacks, 1) << "seed " << seed;
  }
}

}  // namespace
}  // namespace support
