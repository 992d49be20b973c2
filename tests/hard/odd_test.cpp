// Odd but legal: nothing, zeros, copies, and bodies that nobody asks anything of.
#include <gtest/gtest.h>

#include <cmath>

#include "hard/cases/sketch.h"
#include "hard/solution.h"

namespace hard {
namespace {

constexpr mlcp_method methods[] = {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO, MLCP_METHOD_PGS};

/// Solved by every method, to rounding; returns the last solution.
Solution solved(const Problem& problem) {
  Solution s;
  for (const mlcp_method method : methods) {
    s = solve(problem.get(), method, 1e-12);
    EXPECT_EQ(s.report.outcome, MLCP_SOLVED) << mlcp_method_text(method);
    EXPECT_LE(largest_error(problem.get(), s.v, s.gamma), 1e-12) << mlcp_method_text(method);
  }
  return s;
}

TEST(Odd, NothingAtAll) {
  Sketch s;
  const Solution x = solved(s.problem());
  EXPECT_TRUE(x.v.empty() && x.gamma.empty());
  EXPECT_EQ(x.report.islands, 0);
}

TEST(Odd, BodiesWithoutRows) {
  Sketch s;
  s.body(3, 2);
  s.body(1, 4);
  s.momentum({2, 4, -6, 1});
  EXPECT_EQ(solved(s.problem()).v, (std::vector<double>{1, 2, -3, 0.25}));
}

TEST(Odd, RowsWithoutBodies) {
  Sketch s;
  s.row({}, -1);
  s.row({}, 0);
  s.row({}, 2, bilateral, 0.5);  // Σγ = r
  EXPECT_EQ(solved(s.problem()).gamma, (std::vector<double>{0, 0, 4}));
}

TEST(Odd, RowWithoutEntriesThatAsksForMore) {
  for (const mlcp_method method : {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO}) {
    Sketch s;
    s.body(1, 1);
    s.row({{0, 1}}, 1);
    const auto impossible = s.row({}, 1);
    const Solution x = solve(s.problem().get(), method, 1e-12);
    EXPECT_EQ(x.report.outcome, MLCP_INFEASIBLE) << mlcp_method_text(method);
    EXPECT_EQ(x.certificate_row, std::vector<std::int32_t>{impossible});
    EXPECT_EQ(certificate_fault(s.problem().get(), x.certificate_row, x.certificate_y), "");
    EXPECT_EQ(x.v, std::vector<double>{1}) << "the other island is solved";
  }
}

TEST(Odd, ExplicitZeros) {
  Sketch s;
  s.body(2, 1);
  s.momentum({0, -1});
  s.row({{0, 0}, {1, 1}});
  s.row({{0, 0}, {1, 0}}, -1);
  EXPECT_EQ(solved(s.problem()).v, (std::vector<double>{0, 0}));
}

TEST(Odd, TheSameRowAHundredTimes) {
  Sketch s;
  s.body(1, 1);
  s.momentum({-1});
  for (int i = 0; i < 100; ++i) s.row({{0, 1}}, 0.5, i % 2 ? unilateral : bilateral);
  const Solution x = solved(s.problem());
  EXPECT_EQ(x.v, std::vector<double>{0.5});
}

TEST(Odd, LowerEqualsUpper) {
  Sketch s;
  s.body(2, 1);
  s.momentum({1, 1});
  s.row({{0, 1}}, 7, {0.5, 0.5});
  s.row({{1, 1}}, -7, {0, 0});
  s.row({{0, 1}, {1, 1}}, 3, bilateral);
  const Solution x = solved(s.problem());
  EXPECT_EQ(x.gamma[0], 0.5);
  EXPECT_EQ(x.gamma[1], 0);
}

TEST(Odd, EveryBodyPrescribed) {
  Sketch s;
  const auto a = s.body(1, 1), b = s.body(1, 1);
  s.prescribe(a, {1});
  s.prescribe(b, {2});
  s.row({{a, -1}, {b, 1}}, 0.5);
  const Solution x = solved(s.problem());
  EXPECT_EQ(x.v, (std::vector<double>{1, 2}));
  EXPECT_EQ(x.gamma, std::vector<double>{0});
}

TEST(Odd, DenormalNumbers) {
  Sketch s;
  s.body(1, 1);
  s.momentum({-5e-324});
  s.row({{0, 1}});
  s.row({{0, 5e-324}}, -1);
  EXPECT_EQ(solved(s.problem()).v, std::vector<double>{0});
}

}  // namespace
}  // namespace hard
