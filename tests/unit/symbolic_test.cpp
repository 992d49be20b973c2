#include "analyze/symbolic.h"

#include <gtest/gtest.h>

#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

void expect_dense_elimination(const mlcp::Problem& problem, const mlcp::Analysis& analysis) {
  const mlcp::Symbolic& s = analysis.symbolic;
  const Pattern L = eliminate(kkt_pattern(problem, analysis.pattern.node.span()));
  ASSERT_EQ(s.size(), static_cast<int>(L.size()));
  ASSERT_EQ(s.entries(), entries(L));
  for (std::size_t j = 0; j < L.size(); ++j) {
    const std::vector<int> rows(s.rows.begin() + s.pointers[j], s.rows.begin() + s.pointers[j + 1]);
    ASSERT_EQ(rows, std::vector<int>(L[j].begin(), L[j].end())) << "column " << j;
    ASSERT_EQ(s.parent[j], rows.empty() ? -1 : rows[0]);
  }
  // runs are as long as columns nest
  for (int p = 0; p < s.size(); ++p) {
    std::set<int> next;
    if (p + 1 < s.size()) {
      next = L[p + 1];
      next.insert(p + 1);
    }
    const bool nests = p + 1 < s.size() && L[p] == next;
    ASSERT_EQ(s.run_end[p], nests ? s.run_end[p + 1] : p + 1);
    ASSERT_EQ(s.run_start[p], p > 0 && s.run_end[p - 1] > p ? s.run_start[p - 1] : p);
    std::int64_t path = 0;
    for (int q = p; q >= 0; q = s.parent[q]) path += static_cast<std::int64_t>(L[q].size());
    ASSERT_EQ(s.path_entries[p], path);
  }
  // islands tile the order, and their rows the ordinals; each ends at its only root
  int position = 0, row = 0;
  for (const mlcp::Island& island : s.islands) {
    ASSERT_EQ(island.first, position);
    ASSERT_EQ(island.first_row, row);
    for (; position < island.last; ++position) {
      row += analysis.pattern.is_row(position);
      ASSERT_EQ(s.parent[position] < 0, position + 1 == island.last);
    }
    ASSERT_EQ(island.last_row, row);
  }
  ASSERT_EQ(position, s.size());
}

void expect_dense_elimination(const mlcp::Problem& problem, const mlcp::Mask* enabled) { expect_dense_elimination(problem, Stage(problem, enabled).analysis); }

TEST(Symbolic, EqualsDenseEliminationOnRandomProblems) {
  Shape shape;
  shape.bodies_most = 10;
  shape.rows_most = 25;
  shape.dimension_most = 15;
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, shape);
    const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.2);
    expect_dense_elimination(p, random.chance(0.5) ? &enabled : nullptr);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

TEST(Symbolic, EqualsDenseEliminationOnChains) {
  for (const int links : {1, 2, 30, 100}) {
    Random random(links);
    expect_dense_elimination(random_chain(random, links, 3, 2), nullptr);
  }
}

/// Rows before the velocities that they touch; the same analysis for one problem after another.
TEST(Symbolic, EqualsDenseEliminationOfCrowdedIslands) {
  mlcp::Analysis analysis{mlcp::Memory()};
  int crowded = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, random.integer(1, 12), random.integer(1, 4), random.integer(3, 9));
    analysis.run(p, nullptr, false, {});
    crowded += analysis.crowding.any();
    expect_dense_elimination(p, analysis);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
  EXPECT_GT(crowded, 20);
}

TEST(Symbolic, ChainFillIsLinear) {
  Random random(1);
  const std::int64_t some = Stage(random_chain(random, 500, 3, 2)).analysis.symbolic.entries();
  const std::int64_t many = Stage(random_chain(random, 4000, 3, 2)).analysis.symbolic.entries();
  EXPECT_LE(static_cast<double>(many), 1.5 * 8 * static_cast<double>(some));
}

TEST(Symbolic, EmptyProblem) { expect_dense_elimination(empty_problem(), nullptr); }

TEST(Symbolic, ZeroRowsAreIslandsOfTheirOwn) {
  mlcp::Problem p = empty_problem();
  for (int i = 0; i < 3; ++i) add_row(p, {});
  const Stage stage(p);
  EXPECT_EQ(stage.islands().size(), 3u);
  EXPECT_EQ(stage.analysis.symbolic.entries(), 0);
}

}  // namespace
}  // namespace support
