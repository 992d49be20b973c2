#include "analyze/components.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "assemble/bodies.h"
#include "factorize/dense_response.h"
#include "support/random_problem.h"
#include "support/solution.h"
#include "support/velocity_runs.h"

namespace support {
namespace {

template <class T>
std::vector<T> list(const mlcp::Array<T>& a) {
  return {a.begin(), a.end()};
}

std::vector<std::int32_t> free_of(const mlcp::Components& c) { return support::list(c.free_velocities); }

/// Body 0 alone, 1 and 2 joined by row 0, body 3 prescribed and touched by row 1 of body 4; row 2 is empty.
mlcp::Problem five_bodies() {
  mlcp::Problem p = empty_problem();
  for (int i = 0; i < 5; ++i) add_body(p, 1, 1);
  prescribe(p, 3, {1});
  add_row(p, {{1, 1}, {2, -1}});
  add_row(p, {{3, 1}, {4, -1}});
  add_row(p, {});
  return p;
}

TEST(Components, PrescribedVelocitiesJoinNothingAndFreeOnesAreInNone) {
  mlcp::Components c{mlcp::Memory()};
  EXPECT_TRUE(c.update(five_bodies(), nullptr));
  ASSERT_EQ(c.count(), 3);
  EXPECT_EQ(free_of(c), (std::vector<std::int32_t>{0}));
  EXPECT_EQ(list(c.velocities), (std::vector<std::int32_t>{1, 2, 4}));
  EXPECT_EQ(list(c.velocity_pointers), (std::vector<std::int32_t>{0, 2, 3, 3}));
  EXPECT_EQ(list(c.rows), (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(list(c.row_pointers), (std::vector<std::int32_t>{0, 1, 2, 3}));
  EXPECT_EQ(list(c.of_row), (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(Components, AVelocityWhoseOnlyEntryIsOffTheDiagonalIsNotFree) {
  mlcp::Problem p = empty_problem();
  const std::int32_t pointers[] = {0, 1, 3}, rows[] = {1, 0, 1};
  const double values[] = {0, 0, 1};
  mlcp::body_add_sparse(p, 2, pointers, rows, values, MLCP_FULL);
  mlcp::Components c{mlcp::Memory()};
  c.update(p, nullptr);
  EXPECT_EQ(free_of(c), (std::vector<std::int32_t>{}));
  EXPECT_EQ(list(c.velocities), (std::vector<std::int32_t>{0, 1}));
  ASSERT_EQ(c.count(), 1);
  mlcp::Settings by_default = settings();
  by_default.method = MLCP_METHOD_AUTO;
  EXPECT_EQ(solve(p, by_default).report.outcome, MLCP_NOT_POSITIVE_DEFINITE);
}

/// Of a diagonal mass, looked at by eights: any one velocity that a row touches, and any two.
TEST(Components, FreeVelocitiesOfADiagonalMassAreAllThatNoRowTouches) {
  constexpr int n = 27;
  for (int one = 0; one < n; ++one)
    for (int other = one; other < n; ++other) {
      mlcp::Problem p = empty_problem();
      add_body(p, 1, 1);
      add_sparse_body(p, Eigen::MatrixXd::Identity(n, n));
      for (const int j : {one, other}) add_row(p, {{1 + j, 1}});
      mlcp::Components c{mlcp::Memory()};
      c.update(p, nullptr);
      std::vector<std::int32_t> expected;
      for (int j = 0; j <= n; ++j)
        if (j != 1 + one && j != 1 + other) expected.push_back(j);
      ASSERT_EQ(free_of(c), expected) << one << ", " << other;
    }
}

TEST(Components, AreFoundAgainOnlyWhenThePatternHasChanged) {
  mlcp::Problem p = five_bodies();
  mlcp::Components c{mlcp::Memory()};
  EXPECT_TRUE(c.update(p, nullptr));
  p.mass.values[0] = 7;
  p.momentum[1] = 3;
  EXPECT_FALSE(c.update(p, nullptr));
  const mlcp::Mask all = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_AT_LOWER, MLCP_ROW_ACTIVE}), one = mask_of({MLCP_ROW_DISABLED, MLCP_ROW_ACTIVE, MLCP_ROW_DISABLED});
  EXPECT_FALSE(c.update(p, &all));
  EXPECT_TRUE(c.update(p, &one));
  EXPECT_EQ(c.count(), 1);
  EXPECT_EQ(free_of(c), (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(list(c.of_row), (std::vector<std::int32_t>{-1, 0, -1}));
  prescribe(p, 4, {0});
  EXPECT_TRUE(c.update(p, &one));
  EXPECT_EQ(c.velocities.size(), 0u);
  add_row(p, {{0, 1}});
  EXPECT_TRUE(c.update(p, nullptr));
}

/// Steps of a scene: rows come and go, a body is prescribed now and then, M's pattern changes. What is kept from update to update must not show.
TEST(Components, OfOneStepAfterTheOtherAreThoseFoundAfresh) {
  int kept = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    mlcp::Problem p = random_problem(random, {.bodies_most = 6, .rows_most = 8, .disabled = 0});
    mlcp::Components c{mlcp::Memory()};
    mlcp::DenseResponse response{mlcp::Memory()};
    std::int64_t version = -1;
    for (int step = 0; step < 12; ++step) {
      if (random.chance(0.1)) p = random_problem(random, {.bodies_most = 6, .rows_most = 8, .disabled = 0});
      const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.4);
      mlcp::Components fresh{mlcp::Memory()};
      c.update(p, &enabled);
      fresh.update(p, &enabled);
      ASSERT_EQ(list(c.velocity_pointers), list(fresh.velocity_pointers)) << "seed " << seed;
      ASSERT_EQ(list(c.velocities), list(fresh.velocities)) << "seed " << seed;
      ASSERT_EQ(list(c.rows), list(fresh.rows)) << "seed " << seed;
      ASSERT_EQ(list(c.of_row), list(fresh.of_row)) << "seed " << seed;
      ASSERT_EQ(free_of(c), free_of(fresh)) << "seed " << seed;
      kept += c.mass_version() == version;
      version = c.mass_version();
      mlcp::DenseResponse other{mlcp::Memory()};
      response.prepare(p, c);
      other.prepare(p, fresh);
      for (int i = 0; i < c.count(); ++i) {
        ASSERT_EQ(response.compute(p, i), other.compute(p, i)) << "seed " << seed;
        const mlcp::DenseIsland &a = response.island(i), &b = other.island(i);
        for (int row = 0; row < a.m; ++row) ASSERT_EQ(a.response(row, row), b.response(row, row)) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(kept, 100);
}

/// Other bodies over the same patterns: the first velocity of each is as free as it was, another one is not.
TEST(Components, OtherBodiesOverTheSamePatternsAreNotKnown) {
  for (const bool coupled : {false, true}) {
    const double values[] = {2, 1, 1, 2, 2, 1, 1, 2};
    const std::int32_t pointers[] = {0, 2, 4, 6, 8}, rows[] = {0, 1, 0, 1, 2, 3, 2, 3};
    mlcp::Problem two = empty_problem(), one = empty_problem();
    if (coupled) {
      for (int i = 0; i < 2; ++i) add_sparse_body(two, (Eigen::Matrix2d() << 2, 1, 1, 2).finished());
      prescribe(two, 1, {1, 1});
      mlcp::body_add_sparse(one, 4, pointers, rows, values, MLCP_FULL);
    } else {
      for (int i = 0; i < 2; ++i) add_body(two, 1, 1);
      prescribe(two, 1, {1});
      const std::int32_t ends[] = {0, 1, 2}, diagonal[] = {0, 1};
      const double ones[] = {1, 1};
      mlcp::body_add_sparse(one, 2, ends, diagonal, ones, MLCP_FULL);
    }
    const int last = one.n() - 1;
    for (mlcp::Problem* p : {&two, &one}) add_row(*p, {{0, 1}, {last, 1}});
    ASSERT_TRUE(std::ranges::equal(two.mass.indices, one.mass.indices) && std::ranges::equal(two.mass.pointers, one.mass.pointers));
    for (const bool other_rows : {false, true}) {
      mlcp::Components c{mlcp::Memory()}, fresh{mlcp::Memory()};
      c.update(two, nullptr);
      if (other_rows) add_row(one, {{0, 1}});
      EXPECT_TRUE(c.update(one, nullptr));
      fresh.update(one, nullptr);
      EXPECT_EQ(list(c.velocities), list(fresh.velocities));
      EXPECT_EQ(list(c.velocity_pointers), list(fresh.velocity_pointers));
      EXPECT_EQ(free_of(c), free_of(fresh));
    }
  }
}

TEST(Components, AreTheIslandsOfTheSparseFactor) {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.bodies_most = 8, .rows_most = 10});
    const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.2);
    mlcp::Components c{mlcp::Memory()};
    c.update(p, &enabled);
    const Solution s = solve(p, settings(), &enabled);
    ASSERT_EQ(c.count(), static_cast<int>(s.island_outcome.size())) << seed;
    for (int i = 0; i < p.m(); ++i) {
      ASSERT_EQ(c.of_row[i] < 0, s.row_island[i] < 0) << seed;
      for (int j = 0; j < i; ++j) ASSERT_EQ(c.of_row[i] == c.of_row[j], s.row_island[i] == s.row_island[j]) << seed;
    }
  }
}

}  // namespace
}  // namespace support
