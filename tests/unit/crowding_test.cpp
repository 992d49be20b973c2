#include "analyze/crowding.h"

#include <gtest/gtest.h>

#include "analyze/analysis.h"
#include "analyze/check_analysis.h"
#include "support/random_problem.h"

namespace support {
namespace {

mlcp::Crowding crowding_of(const mlcp::Problem& p, bool exact = false) {
  mlcp::Selection selection{mlcp::Memory()};
  selection.take(p, nullptr);
  mlcp::Crowding crowding{mlcp::Memory()};
  crowding.find(p, selection, exact);
  return crowding;
}

/// One body of three velocities with so many rows, and one with two.
mlcp::Problem two_islands(int rows) {
  mlcp::Problem p = empty_problem();
  add_body(p, 3, 1);
  add_body(p, 3, 1);
  for (int i = 0; i < rows; ++i) add_row(p, {{0, 1}, {1, 0.1 * i}, {2, 1.0 * (i % 3)}});
  for (int i = 0; i < 2; ++i) add_row(p, {{3, 1}, {4, i - 0.5}});
  return p;
}

TEST(Crowding, ByIsland) {
  const mlcp::Problem p = two_islands(30);
  const mlcp::Crowding c = crowding_of(p);
  EXPECT_TRUE(c.any());
  for (int node = 0; node < 6; ++node) EXPECT_EQ(c.crowded[node], node < 3) << node;
  for (int row = 0; row < p.m(); ++row) EXPECT_EQ(c.crowded[6 + row], row < 30) << row;
}

TEST(Crowding, FewRowsAreNone) { EXPECT_FALSE(crowding_of(two_islands(10)).any()); }

TEST(Crowding, NotForThePivotingMethod) { EXPECT_FALSE(crowding_of(two_islands(30), true).any()); }

TEST(Crowding, ReducedProblemHasNoVelocitiesToCrowd) {
  Random random(1);
  EXPECT_FALSE(crowding_of(random_reduced(random, 40, 3, false)).any());
}

TEST(Crowding, AnalysisOrdersRowsBeforeVelocitiesThereAlone) {
  const mlcp::Problem p = two_islands(30);
  mlcp::Analysis analysis{mlcp::Memory()};
  analysis.run(p, nullptr, false, {});
  EXPECT_TRUE(mlcp::check_analysis(analysis));
  ASSERT_EQ(analysis.symbolic.islands.size(), 2u);
  int early = 0;
  for (const mlcp::Island& island : analysis.symbolic.islands)
    for (std::int32_t o = island.first_row; o < island.last_row; ++o)
      for (std::int32_t t = analysis.pattern.row_pointers[o]; t < analysis.pattern.row_pointers[o + 1]; ++t)
        if (analysis.pattern.row_columns[t] > analysis.pattern.row_position[o]) {
          EXPECT_TRUE(island.crowded);
          ++early;
        }
  EXPECT_GT(early, 0);
  EXPECT_FALSE(analysis.covers(p, nullptr, true)) << "another order is asked for";
}

}  // namespace
}  // namespace support
