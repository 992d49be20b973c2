#include "analyze/analysis.h"

#include <gtest/gtest.h>

#include <numeric>

#include "analyze/check_analysis.h"
#include "assemble/bodies.h"
#include "assemble/rows.h"
#include "assemble/values.h"
#include "support/random_problem.h"
#include "support/velocity_runs.h"

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

/// As many entries as an order of its own gives.
std::int64_t fresh_entries(const mlcp::Problem& problem) {
  mlcp::Analysis fresh{mlcp::Memory()};
  fresh.run(problem, nullptr, false, {});
  return fresh.symbolic.entries();
}

void clear_rows(mlcp::Problem& problem) {
  std::vector<std::int32_t> all(problem.m());
  std::iota(all.begin(), all.end(), 0);
  mlcp::rows_remove(problem, problem.m(), all.data());
}

/// A square of bodies, each in contact with the next ones to the right and below, but for some.
void add_contacts(mlcp::Problem& problem, int side, Random& random) {
  for (int b = 0; b < side * side; ++b)
    for (const int other : {b % side + 1 < side ? b + 1 : -1, b + side < side * side ? b + side : -1})
      if (other >= 0 && random.chance(0.9)) add_row(problem, {{2 * b, 1}, {2 * b + 1, random.uniform()}, {2 * other, -1}, {2 * other + 1, random.uniform()}});
}

mlcp::Problem bodies(int count) {
  mlcp::Problem problem = empty_problem();
  for (int b = 0; b < count; ++b) add_body(problem, 2, 1);
  return problem;
}

TEST(Analysis, NextStepKeepsTheOrderWhereContactsComeAndGo) {
  constexpr int side = 14;
  Random random(7);
  mlcp::Problem problem = bodies(side * side);
  add_contacts(problem, side, random);
  mlcp::Analysis analysis{mlcp::Memory()};
  analysis.run(problem, nullptr, false, {});
  int carried = 0;
  for (int step = 0; step < 10; ++step) {
    SCOPED_TRACE(step);
    const std::vector<std::int32_t> before(analysis.pattern.node.begin(), analysis.pattern.node.end());
    clear_rows(problem);
    add_contacts(problem, side, random);
    analysis.run_again(problem, nullptr, false);
    ASSERT_TRUE(mlcp::check_analysis(analysis));
    EXPECT_LT(static_cast<double>(analysis.symbolic.entries()), 1.25 * static_cast<double>(fresh_entries(problem)) + 500);
    // nearly all pairs of velocities that followed each other do so again; in an order made anew three quarters do
    std::vector<int> place(problem.n(), -1);
    int kept = 0, last = -1, velocities = 0;
    for (const std::int32_t node : before)
      if (node < problem.n()) place[node] = velocities++;
    for (const std::int32_t node : analysis.pattern.node) {
      if (node >= problem.n()) continue;
      kept += place[node] > last;
      last = place[node];
    }
    EXPECT_GT(kept, 0.75 * velocities);
    carried += kept > 0.9 * velocities;
  }
  EXPECT_GE(carried, 7);
}

/// From a chain to a square of the same bodies.
TEST(Analysis, NextStepIsOrderedAnewWhereNothingIsAsItWas) {
  constexpr int side = 24;
  Random random(7);
  mlcp::Problem problem = bodies(side * side);
  for (int b = 0; b + 1 < side * side; ++b) add_row(problem, {{2 * b, 1}, {2 * b + 2, -1}});
  mlcp::Analysis analysis{mlcp::Memory()};
  analysis.run(problem, nullptr, false, {});
  clear_rows(problem);
  add_contacts(problem, side, random);
  analysis.run_again(problem, nullptr, false);
  ASSERT_TRUE(mlcp::check_analysis(analysis));
  EXPECT_EQ(analysis.symbolic.entries(), fresh_entries(problem));
}

TEST(Analysis, NextStepIsOrderedAnewWhereTheOldOrderWouldFillIn) {
  constexpr int count = 300;
  Random random(3);
  mlcp::Problem problem = bodies(count);
  const auto chain = [&](auto at) {
    clear_rows(problem);
    for (int b = 0; b + 1 < count; ++b) add_row(problem, {{2 * at(b), 1}, {2 * at(b + 1), -1}});
  };
  mlcp::Analysis analysis{mlcp::Memory()};
  chain([](int b) { return b; });
  analysis.run_again(problem, nullptr, false);
  for (int step = 0; step < 5; ++step) {
    const int stride = std::vector{7, 11, 13, 17, 19}[step];  // coprime to 300: another chain through the same bodies
    chain([&](int b) { return b * stride % count; });
    analysis.run_again(problem, nullptr, false);
    ASSERT_TRUE(mlcp::check_analysis(analysis));
    EXPECT_LE(static_cast<double>(analysis.symbolic.entries()), 1.1 * static_cast<double>(fresh_entries(problem)) + 500);
  }
}

TEST(Analysis, NextStepHasEveryNodeOnceWhateverHasChanged) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    mlcp::Analysis analysis{mlcp::Memory()};
    mlcp::Problem problem = bodies(3);
    add_body(problem, random_mass(random, 14, false));  // too large for an element
    for (int step = 0; step < 8; ++step) {
      if (random.chance(0.3)) add_body(problem, random.integer(1, 3), 2);
      if (random.chance(0.2)) prescribe(problem, random.integer(0, 2), {0, 0});
      if (random.chance(0.5)) clear_rows(problem);
      for (int rows = random.integer(0, 40); rows > 0; --rows) {
        const int j = random.integer(0, problem.n() - 1), other = random.integer(0, problem.n() - 1);
        add_row(problem, j == other ? std::vector<Entry>{{j, 1}} : std::vector<Entry>{{std::min(j, other), 1}, {std::max(j, other), -1}});
      }
      std::vector<mlcp_row_state> states(problem.m());
      for (auto& state : states) state = random.chance(0.2) ? MLCP_ROW_DISABLED : MLCP_ROW_AT_LOWER;
      const mlcp::Mask enabled = mask_of(states);
      const bool exact = random.chance(0.2);
      analysis.run_again(problem, &enabled, exact);
      ASSERT_TRUE(mlcp::check_analysis(analysis));
      mlcp::Analysis fresh{mlcp::Memory()};
      fresh.run(problem, &enabled, exact, {});
      ASSERT_TRUE(fresh.ordering.accept(problem, fresh.selection, fresh.crowding, analysis.ordering.order.span()));
      ASSERT_EQ(list(analysis.ordering.free_velocities), list(fresh.ordering.free_velocities));
    }
  }
}

}  // namespace
}  // namespace support
