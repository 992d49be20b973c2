#include "analyze/analysis.h"

#include <gtest/gtest.h>

#include "assemble/bodies.h"
#include "assemble/rows.h"
#include "assemble/values.h"
#include "support/random_problem.h"

namespace support {
namespace {

mlcp::Problem chain() {
  Random random(4);
  return random_chain(random, 6, 2, 1);
}

mlcp::Mask all_but(int rows, std::vector<int> off) {
  std::vector<mlcp_row_state> states(rows, MLCP_ROW_AT_LOWER);
  for (const int i : off) states[i] = MLCP_ROW_DISABLED;
  return mask_of(states);
}

struct Analyzed {
  mlcp::Problem problem = chain();
  mlcp::Analysis analysis{mlcp::Memory()};
  Analyzed() { analysis.run(problem, nullptr, true, {}); }
};

TEST(Analysis, CoversNothingBeforeTheFirstRun) {
  EXPECT_FALSE(mlcp::Analysis(mlcp::Memory()).covers(empty_problem(), nullptr, true));
}

TEST(Analysis, NewNumbersInTheSamePatternAreCovered) {
  Analyzed a;
  const double r = 5;
  mlcp::rows_set_r(a.problem, 2, 1, &r);
  set_k(a.problem, Eigen::VectorXd::Ones(a.problem.n()));
  EXPECT_TRUE(a.analysis.covers(a.problem, nullptr, true));
}

TEST(Analysis, FewDisabledRowsAreCoveredManyAreNot) {
  Analyzed a;
  const mlcp::Mask few = all_but(a.problem.m(), {3}), many = all_but(a.problem.m(), {0, 1, 2, 3, 4, 5});
  EXPECT_TRUE(a.analysis.covers(a.problem, &few, true));
  EXPECT_FALSE(a.analysis.covers(a.problem, &many, true)) << "disabled rows must cost nothing";
}

TEST(Analysis, RowThatComesBackIsNotCovered) {
  Analyzed a;
  const mlcp::Mask enabled = all_but(a.problem.m(), {3});
  a.analysis.run(a.problem, &enabled, true, {});
  EXPECT_TRUE(a.analysis.covers(a.problem, &enabled, true));
  EXPECT_FALSE(a.analysis.covers(a.problem, nullptr, true));
}

TEST(Analysis, BodySwitchedToPrescribedIsNotCovered) {
  Analyzed a;
  prescribe(a.problem, 2, {0, 0});
  EXPECT_FALSE(a.analysis.covers(a.problem, nullptr, true));
}

TEST(Analysis, ChangedPatternIsNotCovered) {
  Analyzed more, other;
  add_row(more.problem, {{0, 1}});
  EXPECT_FALSE(more.analysis.covers(more.problem, nullptr, true));
  // as many rows and entries, in other columns
  const std::int32_t last = other.problem.m() - 1;
  mlcp::rows_remove(other.problem, 1, &last);
  add_row(other.problem, {{0, 1}, {1, 1}});
  EXPECT_FALSE(other.analysis.covers(other.problem, nullptr, true));
}

TEST(Analysis, ImposedOrderIsKeptWhenItIsAPostorder) {
  Analyzed a;
  const std::vector<std::int32_t> order(a.analysis.ordering.order.begin(), a.analysis.ordering.order.end());
  mlcp::Analysis again{mlcp::Memory()};
  again.run(a.problem, nullptr, true, order);
  EXPECT_EQ(std::vector<std::int32_t>(again.ordering.order.begin(), again.ordering.order.end()), order);
}

TEST(Analysis, UnfitOrderIsReplaced) {
  Analyzed a;
  const std::vector<std::int32_t> wrong(a.analysis.ordering.order.size(), 0);
  mlcp::Analysis again{mlcp::Memory()};
  again.run(a.problem, nullptr, true, wrong);
  EXPECT_TRUE(std::equal(again.ordering.order.begin(), again.ordering.order.end(), a.analysis.ordering.order.begin()));
}

}  // namespace
}  // namespace support
