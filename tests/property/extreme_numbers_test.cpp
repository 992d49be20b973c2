// Data that is rounded, tiny or huge: the answer may be that there is none, but it must be true.
#include <gtest/gtest.h>

#include <cmath>

#include "assemble/rows.h"
#include "support/failure.h"
#include "support/random_problem.h"

namespace support {
namespace {

/// "" unless the outcome says more than the numbers do.
std::string lie(const mlcp::Problem& problem, const Solution& s) {
  const Dense d = dense(problem);
  const DenseErrors e = errors_of(d, widen(s.v), widen(s.gamma), 1e-300L);
  if (s.report.outcome == MLCP_SOLVED && !(e.momentum <= 1.001e-9L && e.constraints <= 1.001e-9L))
    return "solved with errors " + std::to_string(e.momentum) + ", " + std::to_string(e.constraints);
  if (s.report.outcome == MLCP_INFEASIBLE) return certificate_fault(d, s.certificate_row, s.certificate_y);
  if (s.report.outcome > MLCP_BAD_INPUT || s.report.outcome < 0) return "no outcome";
  return "";
}

double extreme(Random& random) {
  static constexpr double numbers[] = {5e-324, 1e-310, 1e-300, 1e-150, 1e-20, 1, 3, 1e20, 1e150, 1e300, 1.7e308};
  const double x = random.chance(0.5) ? random.uniform() : numbers[random.integer(0, 10)];
  return random.chance(0.5) ? x : -x;
}

TEST(ExtremeNumbers, DenormalAndHugeEntriesNeitherCrashNorLie) {
  int solved = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(rounds(3000)) && !HasFailure(); ++seed) {
    Random random(seed);
    mlcp::Problem p = random_problem(random, {.rows_least = 1});
    for (double& x : p.jacobian.values)
      if (random.chance(0.2)) x = extreme(random);
    for (double& x : p.momentum)
      if (random.chance(0.1)) x = extreme(random);
    for (double& x : p.r)
      if (random.chance(0.1)) x = extreme(random);
    for (const std::int32_t t : p.diagonal)
      if (random.chance(0.1)) p.compliance.values[t] = std::abs(extreme(random));
    if (random.chance(0.3)) {
      const double mass = std::abs(extreme(random));
      for (double& x : p.mass.values) x *= mass;
    }
    for (const mlcp_pivot_rule rule : {MLCP_PIVOT_DUAL, MLCP_PIVOT_PRINTED}) {
      const Solution s = solve(p, settings(rule));
      EXPECT_EQ(lie(p, s), "") << evidence("extreme", seed, p, settings(rule));
      solved += s.report.outcome == MLCP_SOLVED;
    }
  }
  EXPECT_GE(solved, 1000);
}

/// Everything scaled by powers of two, as far as the squares stay within range: the same bits.
TEST(ExtremeNumbers, UnitsDoNotMatter) {
  for (std::uint64_t seed = 1; seed <= 300 && !HasFailure(); ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.rows_least = 1, .feasible = 1});
    mlcp::Problem q(p, mlcp::Memory());
    const int mass = random.integer(-200, 200), speed = random.integer(-200, 200);
    for (double& x : q.mass.values) x = std::ldexp(x, mass);
    for (double& x : q.momentum) x = std::ldexp(x, mass + speed);
    for (double& x : q.given_velocity) x = std::ldexp(x, speed);
    for (double& x : q.r) x = std::ldexp(x, speed);
    for (double& x : q.lo) x = std::ldexp(x, mass + speed);
    for (double& x : q.hi) x = std::ldexp(x, mass + speed);
    for (double& x : q.compliance.values) x = std::ldexp(x, -mass);
    const Solution a = solve(p), b = solve(q);
    ASSERT_EQ(a.report.outcome, b.report.outcome) << evidence("units", seed, p, settings());
    for (int j = 0; j < p.n(); ++j) ASSERT_EQ(std::ldexp(a.v[j], speed), b.v[j]) << evidence("units", seed, p, settings());
    for (int i = 0; i < p.m(); ++i) ASSERT_EQ(std::ldexp(a.gamma[i], mass + speed), b.gamma[i]) << "seed " << seed;
  }
}

/// A = B Bᵀ with eigenvalues of −1e-8 of the largest, as simulators hand over; b such that a solution is near.
mlcp::Problem indefinite_by_rounding(Random& random, double rounding) {
  const int m = random.integer(3, 25), rank = random.integer(1, m);
  Eigen::MatrixXd B(m, rank);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < rank; ++j) B(i, j) = random.uniform();
  Eigen::MatrixXd A = B * B.transpose();
  for (int i = 0; i < m; ++i)
    for (int j = 0; j <= i; ++j) A(i, j) = A(j, i) = A(i, j) + rounding * random.uniform();
  Eigen::VectorXd t(rank);
  for (int j = 0; j < rank; ++j) t[j] = random.uniform();
  Eigen::VectorXd b = B * t;
  for (int i = 0; i < m; ++i) b[i] += random.chance(0.5) ? 0 : random.uniform(0, 1);
  return reduced_problem(A, b);
}

TEST(ExtremeNumbers, SlightlyIndefiniteReducedProblems) {
  int solved = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(rounds(1000)) && !HasFailure(); ++seed) {
    Random random(seed);
    const mlcp::Problem p = indefinite_by_rounding(random, random.chance(0.5) ? 1e-8 : 1e-16);
    for (const mlcp_pivot_rule rule : {MLCP_PIVOT_DUAL, MLCP_PIVOT_PRINTED}) {
      const Solution s = solve(p, settings(rule));
      EXPECT_EQ(lie(p, s), "") << evidence("indefinite", seed, p, settings(rule));
      EXPECT_NE(s.report.outcome, MLCP_NOT_POSITIVE_DEFINITE) << "never for definiteness alone";
      solved += s.report.outcome == MLCP_SOLVED;
      ++all;
    }
  }
  RecordProperty("solved", solved);
  EXPECT_GE(solved, 0.9 * all);
}

}  // namespace
}  // namespace support
