#include "analyze/kkt_pattern.h"

#include <gtest/gtest.h>

#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

/// Every list of the pattern against K, dense.
void expect_pattern_of(const mlcp::Problem& problem, const mlcp::Mask* enabled) {
  const Stage stage(problem, enabled);
  const mlcp::KktPattern& k = stage.pattern();
  const Pattern a = kkt_pattern(problem, k.node.span());
  const int size = k.size();
  Pattern lower(size), upper(size), mirrored(size);
  for (int p = 0; p < size; ++p) {
    ASSERT_EQ(k.position[k.node[p]], p);
    for (auto t = k.lower_pointers[p]; t < k.lower_pointers[p + 1]; ++t) {
      ASSERT_TRUE(lower[p].insert(k.lower_rows[t]).second);
      ASSERT_TRUE(t == k.lower_pointers[p] || k.lower_rows[t] > k.lower_rows[t - 1]);
    }
    for (auto t = k.upper_pointers[p]; t < k.upper_pointers[p + 1]; ++t) ASSERT_TRUE(upper[p].insert(k.upper_rows[t]).second);
    for (const int q : a[p]) mirrored[q].insert(p);
  }
  ASSERT_EQ(lower, a);
  ASSERT_EQ(upper, mirrored);
  // whole rows of K for the constraint rows
  int ordinal = 0;
  for (int p = 0; p < size; ++p) {
    if (!k.is_row(p)) {
      ASSERT_EQ(k.row_ordinal[p], -1);
      continue;
    }
    ASSERT_EQ(k.row_ordinal[p], ordinal);
    ASSERT_EQ(k.row_position[ordinal], p);
    std::set<int> columns(k.row_columns.begin() + k.row_pointers[ordinal], k.row_columns.begin() + k.row_pointers[ordinal + 1]);
    std::set<int> wanted = a[p];
    wanted.insert(mirrored[p].begin(), mirrored[p].end());
    ASSERT_EQ(columns, wanted);
    ++ordinal;
  }
  ASSERT_EQ(k.rows(), ordinal);
}

TEST(KktPattern, RandomProblems) {
  Shape shape;
  shape.bodies_most = 6;
  shape.rows_most = 15;
  shape.dimension_most = 15;
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, shape);
    const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.2);
    expect_pattern_of(p, random.chance(0.5) ? &enabled : nullptr);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

TEST(KktPattern, CrowdedProblemsHaveRowsBeforeVelocities) {
  Shape shape;
  shape.bodies_most = 3;
  shape.rows_least = 30;
  shape.rows_most = 40;
  shape.dimension_most = 6;
  for (int seed = 0; seed < 50; ++seed) {
    Random random(seed);
    expect_pattern_of(random_problem(random, shape), nullptr);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

TEST(KktPattern, ReducedProblemHasComplianceAlone) {
  for (int seed = 0; seed < 20; ++seed) {
    Random random(seed);
    expect_pattern_of(random_reduced(random, 8, 2, true), nullptr);
  }
}

TEST(KktPattern, ExplicitZerosAreEntries) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 1);
  add_row(p, {{0, 0.0}, {1, 1}});
  expect_pattern_of(p, nullptr);
  const Stage stage(p);
  EXPECT_EQ(stage.pattern().row_columns.size(), 2u);
}

TEST(KktPattern, Empty) { expect_pattern_of(empty_problem(), nullptr); }

}  // namespace
}  // namespace support
