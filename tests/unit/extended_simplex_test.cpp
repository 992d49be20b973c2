// Extended precision alone, from any start, against what is known; and that solvers turn to it only where they have to.
#include "solve/extended_simplex.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

using Set = mlcp::ActiveSet;

/// A problem of one island, solved in extended precision from a start.
struct Extended {
  mlcp::Problem problem;
  mlcp::Settings settings = mlcp::default_settings();
  mlcp::Analysis analysis{mlcp::Memory()};
  mlcp::Basis basis{mlcp::Memory()};
  mlcp::ExtendedSimplex method{mlcp::Memory()};
  mlcp::Counts counts;
  mlcp_outcome outcome;

  explicit Extended(mlcp::Problem p, const mlcp::Mask* start = nullptr, std::int64_t most = 1000) : problem(std::move(p)) {
    settings.tolerance = 1e-12;
    analysis.run(problem, nullptr, true, {});
    basis.prepare(problem, analysis, settings);
    basis.set.start(problem, analysis.pattern, basis.values, nullptr, start);
    mlcp::Watch watch(settings);
    mlcp::Limits limits(watch, 0, 1, most);
    outcome = method.solve({problem, nullptr, settings}, island(), basis, limits, counts);
  }
  const mlcp::Island& island() const { return analysis.symbolic.islands[0]; }
  std::vector<double> part(int first, int count, double sign) const {
    std::vector<double> x(count);
    for (int i = 0; i < count; ++i) {
      const std::int32_t p = analysis.pattern.position[first + i];
      x[i] = p < 0 ? 0 : sign * basis.set.x[p];
    }
    return x;
  }
  std::vector<double> v() const { return part(0, problem.n(), 1); }
  std::vector<double> gamma() const { return part(problem.n(), problem.m(), -1); }
};

/// Pushed down into a wedge of two walls that face each other, with a third row that says the same as the first.
mlcp::Problem wedge(double angle) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 1);
  set_k(p, Eigen::Vector2d(0, -1));
  add_row(p, {{0, 1}, {1, angle}});
  add_row(p, {{0, -1}, {1, angle}});
  add_row(p, {{0, 2}, {1, 2 * angle}});
  return p;
}

TEST(ExtendedSimplex, AnglesOfWhichDoublesHoldNoSquare) {
  for (int power = 1; power <= 40; ++power) {
    const double angle = std::ldexp(1.0, -power);
    Extended s(wedge(angle));
    ASSERT_EQ(s.outcome, MLCP_SOLVED) << power;
    for (const double v : s.v()) EXPECT_LE(std::abs(v), 1e-40) << power;
    s.method.still(0x1p4);
    EXPECT_EQ(s.v(), std::vector<double>({0, 0})) << power;
    const std::vector<double> gamma = s.gamma();
    EXPECT_EQ(gamma[0] + 2 * gamma[2], 0.5 / angle) << power;
    EXPECT_EQ(gamma[1], 0.5 / angle) << power;
  }
}

/// The method itself and not only where it is needed: whatever the others solve, from any start.
TEST(ExtendedSimplex, AgreesWithTheSimplexFromAnyStart) {
  int solved = 0, infeasible = 0;
  for (int seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.bodies_most = 1, .rows_least = 1, .sparse_mass = 0, .prescribed = 0, .disabled = 0});
    const mlcp::Mask start = random_mask(random, p.m());
    mlcp::Analysis analysis{mlcp::Memory()};
    analysis.run(p, nullptr, true, {});
    if (analysis.symbolic.islands.size() != 1 || analysis.pattern.size() != p.n() + p.m()) continue;
    const Extended s({p, mlcp::Memory()}, &start);
    const Solution expected = solve(p);
    ASSERT_EQ(s.outcome, expected.report.outcome) << "seed " << seed;
    if (s.outcome != MLCP_SOLVED) {
      ++infeasible;
      EXPECT_GT(s.method.certificate_rows(), 0);
      continue;
    }
    ++solved;
    const DenseErrors e = errors_of(dense(p), widen(s.v()), widen(s.gamma()));
    EXPECT_LE(e.momentum, 1e-15) << "seed " << seed;
    EXPECT_LE(e.constraints, 1e-14) << "seed " << seed;
  }
  EXPECT_GT(solved, 200);
  EXPECT_GT(infeasible, 10);
}

/// A wedge whose walls close on a ceiling that they do not reach: 1e-9 m/s decide.
TEST(ExtendedSimplex, ProvesWhatIsImpossibleByALittle) {
  mlcp::Problem p = wedge(0x1p-30);
  p.r[0] = p.r[1] = 0x1p-30;  // v₁ ≥ 1
  add_row(p, {{1, -1}}, -0.5);
  const Extended s(std::move(p));
  ASSERT_EQ(s.outcome, MLCP_INFEASIBLE);
  EXPECT_EQ(s.method.certificate_rows(), 3);
  for (const double v : s.v()) EXPECT_TRUE(std::isfinite(v));
}

/// γ of a compliance of rank one has a direction that nothing answers to: no velocity takes part, and those of other rows are no measure for it.
TEST(ExtendedSimplex, ProvesContradictionsOfSoftRowsAlone) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 1);
  set_k(p, Eigen::Vector2d(0, -1));
  add_row(p, {{0, 1}, {1, 1}}, 0.3);
  add_row(p, {{0, 1}, {1, 1.01}}, -0.1);
  add_row(p, {}, 0.6, bilateral);
  add_row(p, {}, 0.1, bilateral);
  const Eigen::Vector4d u(0, 0.6875, 0.375, -0.9375);
  set_sigma(p, u * u.transpose());
  mlcp::Mask start{mlcp::Memory()};
  start.state.assign(4, MLCP_ROW_ACTIVE);
  Extended s(std::move(p), &start);
  EXPECT_EQ(s.outcome, MLCP_INFEASIBLE);
  ASSERT_EQ(s.method.certificate_rows(), 2);
  const std::span<const std::int32_t> rows(&s.basis.work.certificate_row[0], 2);
  EXPECT_EQ(certificate_fault(dense(s.problem), rows, {&s.basis.work.certificate_y[0], 2}), "");
}

TEST(ExtendedSimplex, KeepsToItsLimits) {
  const Extended s(wedge(1e-8), nullptr, 1);
  EXPECT_EQ(s.outcome, MLCP_ITERATION_LIMIT);
  EXPECT_EQ(s.counts.pivots, 1);
}

TEST(ExtendedSimplex, RefusesAnIndefiniteMass) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 1);
  for (double& x : p.mass.values) x = 1;  // singular
  add_row(p, {{0, 1}});
  EXPECT_EQ(Extended(std::move(p)).outcome, MLCP_ITERATION_LIMIT);
}

TEST(ExtendedSimplex, IslandsAreSmall) {
  EXPECT_TRUE(mlcp::ExtendedSimplex::takes({0, 192, 0, 96, false}));
  EXPECT_FALSE(mlcp::ExtendedSimplex::takes({0, 193, 0, 96, false}));
  EXPECT_FALSE(mlcp::ExtendedSimplex::takes({0, 192, 0, 97, false}));
}

TEST(ExtendedSimplex, TheSolverTurnsToItWhereDoublesEnd) {
  for (const mlcp_method method : {MLCP_METHOD_AUTO, MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON}) {
    mlcp::Settings how = settings();
    how.method = method;
    how.tolerance = 1e-12;
    const mlcp::Problem p = wedge(0x1p-33);
    const Solution s = solve(p, how);
    EXPECT_EQ(fault(dense(p), s), "");
    EXPECT_GT(s.report.fallbacks, 0);
    how.max_iterations = 1;
    EXPECT_EQ(solve(p, how).report.outcome, MLCP_ITERATION_LIMIT) << "a limit of the caller's stands";
  }
}

}  // namespace
}  // namespace support
