// Infeasible cases: the proof holds by the input alone, and the rows that it names are those that conflict.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "hard/cases/sketch.h"
#include "hard/solution.h"

namespace hard {
namespace {

constexpr double tolerance = 1e-9;

/// The outcome with these rows alone.
mlcp_outcome outcome_with(const mlcp_problem* problem, const std::vector<std::int32_t>& rows) {
  const handles::Mask mask = handles::make_mask(mlcp_problem_row_count(problem), MLCP_ROW_DISABLED);
  const mlcp_row_state on = MLCP_ROW_AT_LOWER;
  for (const std::int32_t row : rows) handles::check(mlcp_mask_set(mask.get(), row, 1, &on), mask);
  const handles::Solver solver = handles::make_solver();
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  handles::check(mlcp_solve(solver.get(), problem, mask.get(), nullptr, &report), solver);
  return report.outcome;
}

/// How many of the rows the conflict does not need: a deletion filter, on at most `most` of them.
int needless(const mlcp_problem* problem, const std::vector<std::int32_t>& rows, std::size_t most) {
  int count = 0;
  for (std::size_t t = 0; t < std::min(rows.size(), most); ++t) {
    std::vector<std::int32_t> others = rows;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
    count += outcome_with(problem, others) != MLCP_SOLVED;
  }
  return count;
}

TEST(Certificates, NameTheRowsThatConflictAndNoOthers) {
  int examined = 0;
  for (const Family& family : families())
    for (const double value : family.values) {
      const Case c = family.make(value);
      if (c.fate != Fate::infeasible) continue;
      SCOPED_TRACE(std::string(family.name) + " " + std::to_string(value));
      const Solution s = solve(c.problem.get(), MLCP_METHOD_AUTO, tolerance);
      ASSERT_EQ(certificate_fault(c.problem.get(), s.certificate_row, s.certificate_y), "");
      EXPECT_EQ(outcome_with(c.problem.get(), s.certificate_row), MLCP_INFEASIBLE);
      EXPECT_EQ(needless(c.problem.get(), s.certificate_row, MLCP_HARD_LONGEST < 10000 ? 1 : 10), 0);
      ++examined;
    }
  EXPECT_GE(examined, 25);
}

/// A body is squeezed in the middle of a scene of others: the certificate names the two walls, and the rest is solved.
TEST(Certificates, OneBadIslandSpoilsNoOther) {
  Sketch s;
  for (int i = 0; i < 10; ++i) s.body(1, 1);
  s.momentum(std::vector<double>(10, -1.0));
  for (int i = 0; i < 10; ++i) s.row({{i, 1}});
  const auto above = s.row({{4, -1}}, 0.25);
  const Solution solution = solve(s.problem().get(), MLCP_METHOD_AUTO, tolerance);
  EXPECT_EQ(solution.report.outcome, MLCP_INFEASIBLE);
  EXPECT_EQ(solution.report.islands_failed, 1);
  std::vector<std::int32_t> rows = solution.certificate_row;
  std::sort(rows.begin(), rows.end());
  EXPECT_EQ(rows, (std::vector<std::int32_t>{4, above}));
  for (std::size_t j = 0; j < 10; ++j) EXPECT_NEAR(solution.v[j], j == 4 ? -0.125 : 0, 1e-6) << "the least violation of " << j;
}

/// Walls that lack `gap` of room: more than the tolerance is infeasible, less is solved, by the numbers recomputed here.
TEST(Certificates, AlmostInfeasibleAndAlmostFeasibleAreToldApartToTheTolerance) {
  for (const double told : {1e-4, 1e-6, 1e-9, 1e-11})
    for (const double gap : {30 * told, 0.3 * told, -0.3 * told, -30 * told})
      for (const mlcp_method method : {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO}) {
        SCOPED_TRACE("tolerance " + std::to_string(told) + ", gap " + std::to_string(gap / told) + " of it");
        Sketch s;
        s.body(2, 1);
        s.momentum({0.5, 0.25});
        s.row({{0, 1}, {1, 1}}, 1);
        s.row({{0, -1}, {1, -1}}, -1 + gap);
        const Solution solution = solve(s.problem().get(), method, told);
        EXPECT_EQ(solution.report.outcome, gap > told ? MLCP_INFEASIBLE : MLCP_SOLVED);
        if (gap > told) {
          EXPECT_EQ(certificate_fault(s.problem().get(), solution.certificate_row, solution.certificate_y), "");
        } else {
          EXPECT_LE(largest_error(s.problem().get(), solution.v, solution.gamma), told);
        }
      }
}

}  // namespace
}  // namespace hard
