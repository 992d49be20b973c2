// Small random problems, 20 000 of them and with --long a million, by every method against the oracle that rounds nothing: no wrong answer is
// called solved, nothing that has a solution is called infeasible, and how many end at an honest limit is counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numeric>
#include <sstream>

#include "exact/oracle.h"
#include "support/failure.h"
#include "support/random_problem.h"

namespace exact {
namespace {

using support::Random;

constexpr mlcp_method methods[] = {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO, MLCP_METHOD_PGS};
constexpr double tolerance = 1e-9;
/// |v − v*| of small well scaled problems; pgs ends at the tolerance, which the condition multiplies.
double largest_difference(mlcp_method method) { return method == MLCP_METHOD_PGS ? 1e-6 : 1e-9; }
/// Problems of a family, of which there are eight.
int count() { return std::getenv("MLCP_TEST_LONG") ? 125000 : MLCP_FUZZ_COUNT; }

/// What the numbers of a family allow to be said.
enum class Data {
  exact,    ///< every sum of the generator is exact and well scaled: v to 1e-9, and infeasible is infeasible
  rounded,  ///< r has rounding in it: what that alone makes infeasible may be called solved
  scaled    ///< rows and masses over many powers of ten: v hangs on the condition, only the errors are judged
};

struct Family {
  const char* name;
  Data data;
  mlcp::Problem (*make)(Random&);
  double limits = 0;  ///< that the exact methods may end at, a problem; pgs is not exact
};

void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

struct Tally {
  int problems = 0, infeasible = 0, limits[4] = {};
};

std::string text(support::Real x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

/// "" unless the outcome says more than is true.
std::string lie(const Family& family, mlcp_method method, const mlcp::Problem& problem, const support::Dense& d, const Reduced& p, const support::Solution& s,
                std::optional<Truth>& known) {
  if (s.report.outcome == MLCP_ITERATION_LIMIT) return "";
  if (s.report.outcome != MLCP_SOLVED && s.report.outcome != MLCP_INFEASIBLE) return "outcome " + std::to_string(s.report.outcome);
  if (!known) {
    std::vector<int> active;
    for (int i = 0; i < problem.m(); ++i)
      if (s.state[i] == MLCP_ROW_ACTIVE) active.push_back(i);
    known = truth(p, active);
    if (const std::string wrong = fault(p, *known); !wrong.empty()) return "the oracle: " + wrong;
  }
  if (s.report.outcome == MLCP_INFEASIBLE)
    return known->feasible ? "called infeasible, and there is a solution" : support::certificate_fault(d, s.certificate_row, s.certificate_y);
  // a slack that is less than half of the least double is 0 to whoever computes with doubles: pgs leaves γ = 1e-321 in rows of compliance alone
  const support::DenseErrors e = support::errors_of(d, support::widen(s.v), support::widen(s.gamma), 0.5L * std::numeric_limits<double>::denorm_min());
  if (!(e.momentum <= 1.001 * tolerance && e.constraints <= 1.001 * tolerance))
    return "called solved with errors " + text(e.momentum) + ", " + text(e.constraints);
  if (!known->feasible) return family.data == Data::exact ? "called solved, and there is no solution" : "";
  if (family.data == Data::scaled) return "";
  std::vector<double> v;
  for (const Rational& x : known->v) v.push_back(x.get_d());
  const double difference = support::difference(s.v, v);
  // rows that nearly depend on each other push with far more than there is momentum: so much does a rounding of the data move v
  const auto largest = [](const auto& values) {
    return std::accumulate(values.begin(), values.end(), 0.0, [](double a, double x) { return std::max(a, std::abs(x)); });
  };
  const double growth = largest(s.gamma) / std::max(largest(problem.momentum), std::numeric_limits<double>::min());
  return difference <= std::max(largest_difference(method), std::numeric_limits<double>::epsilon() * growth) ? "" : "called solved, and v differs by " + text(difference);
}

void examine(const Family& family, std::uint64_t seed, Tally& tally) {
  Random random(seed);
  const mlcp::Problem problem = family.make(random);
  const support::Dense d = support::dense(problem);
  const std::optional<Reduced> p = exact::reduce(d);
  ASSERT_TRUE(p);
  const mlcp::Mask start = support::random_mask(random, problem.m());
  const mlcp::Mask* from = random.chance(0.3) ? &start : nullptr;
  std::optional<Truth> known;
  ++tally.problems;
  for (int t = 0; t < 4; ++t) {
    mlcp::Settings how = support::settings(random.chance(0.3) ? MLCP_PIVOT_PRINTED : MLCP_PIVOT_DUAL);
    how.method = methods[t];
    how.tolerance = tolerance;
    const support::Solution s = support::solve(problem, how, nullptr, from);
    tally.limits[t] += s.report.outcome == MLCP_ITERATION_LIMIT;
    if (s.report.outcome == MLCP_ITERATION_LIMIT && family.limits == 0 && methods[t] != MLCP_METHOD_PGS)
      ADD_FAILURE() << mlcp_method_text(methods[t]) << " ends at a limit, error " << s.report.largest_error << '\n'
                    << support::evidence(std::string("limit_") + family.name, seed, problem, how, nullptr, from);
    const std::string wrong = lie(family, methods[t], problem, d, *p, s, known);
    EXPECT_EQ(wrong, "") << mlcp_method_text(methods[t]) << ", pivot rule " << how.pivot_rule << '\n'
                         << support::evidence(std::string("exact_") + family.name, seed, problem, how, nullptr, from);
  }
  tally.infeasible += known && !known->feasible;
}

mlcp::Problem integers(Random& random) { return support::random_problem(random, {.rows_least = 1, .integers = true}); }

mlcp::Problem at_rest(Random& random) { return support::random_problem(random, {.rows_least = 1, .integers = true, .at_rest = true}); }

mlcp::Problem crowded(Random& random) {
  return support::random_problem(random, {.bodies_most = 2, .dimension_most = 2, .rows_least = 5, .rows_most = 9, .integers = true,
                                          .bilateral = 0.05, .feasible = 0.8});
}

mlcp::Problem boxes(Random& random) {
  return support::random_problem(random, {.rows_least = 1, .boxed_most = 7, .integers = true, .boxed = 0.8});
}

mlcp::Problem reduced(Random& random) {
  const int rows = random.integer(1, 8);
  return support::random_reduced(random, rows, random.integer(1, rows), true);
}

mlcp::Problem reals(Random& random) { return support::random_problem(random, {.dimension_most = 4, .rows_least = 1}); }

/// Rows and masses of integer problems times powers of two, 1e±8 and 1e±6: nothing is rounded.
mlcp::Problem badly_scaled(Random& random) {
  mlcp::Problem p = support::random_problem(random, {.rows_least = 1, .integers = true, .compliance = 0});
  for (std::size_t b = 0; b < p.bodies.size(); ++b) {
    const int mass = random.integer(-20, 20), first = p.bodies[b].offset, last = first + p.bodies[b].dimension;
    for (int j = first; j < last; ++j) {
      p.momentum[j] = std::ldexp(p.momentum[j], mass);
      for (auto t = p.mass.pointers[j]; t < p.mass.pointers[j + 1]; ++t) p.mass.values[t] = std::ldexp(p.mass.values[t], mass);
    }
  }
  for (int i = 0; i < p.m(); ++i) {
    const int length = random.integer(-27, 27);
    p.r[i] = std::ldexp(p.r[i], length);
    for (auto t = p.jacobian.pointers[i]; t < p.jacobian.pointers[i + 1]; ++t) p.jacobian.values[t] = std::ldexp(p.jacobian.values[t], length);
  }
  return p;
}

/// Integer problems in which some rows are others turned by an angle of 1e-3 to 1e-8.
mlcp::Problem nearly_dependent(Random& random) {
  mlcp::Problem p = support::random_problem(random, {.rows_least = 2, .integers = true, .compliance = 0, .duplicate = 0.4});
  for (double& x : p.jacobian.values)
    if (x != 0 && random.chance(0.2)) x += std::ldexp(x, -random.integer(10, 27));
  return p;
}

class Fuzz : public testing::TestWithParam<Family> {};

TEST_P(Fuzz, NoWrongAnswerIsCalledSolved) {
  const Family& family = GetParam();
  Tally tally;
  for (int i = 0; i < count() && !HasFatalFailure(); ++i) examine(family, 1000000 + i, tally);
  std::cout << family.name << ": " << tally.problems << " problems, " << tally.infeasible << " infeasible; limits:";
  for (int t = 0; t < 4; ++t) std::cout << ' ' << mlcp_method_text(methods[t]) << ' ' << tally.limits[t];
  std::cout << '\n';
  for (int t = 0; t < 3 && family.limits > 0; ++t) EXPECT_LE(tally.limits[t], family.limits * tally.problems) << mlcp_method_text(methods[t]);
}

// Found by the million.
TEST(Found, SoftRowBesideAJointThatHoldsItsBodies) {
  Tally tally;
  examine({"at_rest", Data::exact, at_rest}, 1106697, tally);
}

/// Solved by velocities as large as the inverse of an angle, or of two: what is left of Jᵀy is their product and passes for 0 in double.
TEST(Found, ProofsThatForgetSmallAngles) {
  Tally tally;
  for (const std::uint64_t seed : {1008208, 1011844, 1107585, 1118142, 1121572}) examine({"nearly_dependent", Data::scaled, nearly_dependent, 1}, seed, tally);
}

constexpr Family families[] = {
    {"integers", Data::exact, integers},
    {"at_rest", Data::exact, at_rest},
    {"crowded", Data::exact, crowded},
    {"boxes", Data::exact, boxes},
    {"reduced", Data::exact, reduced},
    {"reals", Data::rounded, reals},
    {"badly_scaled", Data::scaled, badly_scaled},
    {"nearly_dependent", Data::scaled, nearly_dependent, 0.001},
};

INSTANTIATE_TEST_SUITE_P(Exact, Fuzz, testing::ValuesIn(families), [](const auto& chosen) { return std::string(chosen.param.name); });

}  // namespace
}  // namespace exact
