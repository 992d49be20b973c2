#include "analyze/ordering.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "assemble/bodies.h"
#include "support/random_problem.h"
#include "support/velocity_runs.h"

namespace support {
namespace {

struct Ordered {
  mlcp::Selection selection{mlcp::Memory()};
  mlcp::Crowding crowding{mlcp::Memory()};
  mlcp::Ordering ordering{mlcp::Memory()};
  std::vector<std::int32_t> order;

  explicit Ordered(const mlcp::Problem& problem, const mlcp::Mask* enabled = nullptr) {
    selection.take(problem, enabled);
    crowding.find(problem, selection, true);
    ordering.compute(problem, selection, crowding);
    order.assign(ordering.order.begin(), ordering.order.end());
  }
  bool accepts(const mlcp::Problem& problem, const std::vector<std::int32_t>& imposed) {
    return ordering.accept(problem, selection, crowding, imposed);
  }
};

mlcp::Problem two_bodies() {
  mlcp::Problem p = empty_problem();
  Random random(1);
  add_body(p, random_mass(random, 2, false));
  add_body(p, random_mass(random, 2, false));
  add_row(p, {{0, 1}, {2, -1}});
  add_row(p, {{1, 1}});
  return p;
}

TEST(Ordering, ComputedOrderIsAccepted) {
  const mlcp::Problem p = two_bodies();
  Ordered o(p);
  EXPECT_EQ(o.order.size(), 6u);
  const std::vector<std::int32_t> order = o.order;
  EXPECT_TRUE(o.accepts(p, order));
  EXPECT_TRUE(std::equal(order.begin(), order.end(), o.ordering.order.begin()));
}

TEST(Ordering, WrongOrdersAreRefused) {
  const mlcp::Problem p = two_bodies();
  Ordered o(p);
  EXPECT_TRUE(o.accepts(p, {0, 1, 2, 3, 4, 5}));
  EXPECT_FALSE(o.accepts(p, {0, 1, 2, 3, 4})) << "a node is missing";
  EXPECT_FALSE(o.accepts(p, {0, 1, 2, 3, 4, 4})) << "a node is there twice";
  EXPECT_FALSE(o.accepts(p, {0, 1, 2, 3, 4, 6})) << "out of range";
  EXPECT_FALSE(o.accepts(p, {0, 1, 2, 3, 4, -1})) << "negative";
  EXPECT_FALSE(o.accepts(p, {0, 4, 1, 2, 3, 5})) << "row 0 before its velocity 2";
  EXPECT_FALSE(o.accepts(p, {}));
}

TEST(Ordering, DisabledRowIsNoNode) {
  const mlcp::Problem p = two_bodies();
  const mlcp::Mask enabled = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_DISABLED});
  Ordered o(p, &enabled);
  EXPECT_TRUE(o.accepts(p, {0, 1, 2, 3, 4}));
  EXPECT_FALSE(o.accepts(p, {0, 1, 2, 3, 5}));
  EXPECT_FALSE(o.accepts(p, {0, 1, 2, 3, 4, 5}));
}

TEST(Ordering, PrescribedVelocityIsNoNodeAndNothingWaitsForIt) {
  mlcp::Problem p = two_bodies();
  prescribe(p, 1, {0, 0});
  Ordered o(p);
  EXPECT_EQ(o.order.size(), 4u);
  EXPECT_TRUE(o.accepts(p, {0, 1, 4, 5}));
  EXPECT_FALSE(o.accepts(p, {0, 1, 2, 3, 4, 5}));
}

TEST(Ordering, LoneVelocityWithDiagonalMassIsFree) {
  mlcp::Problem p = empty_problem();
  add_sparse_body(p, Eigen::Matrix3d::Identity());
  add_body(p, 1, 2);
  add_row(p, {{1, 1}});
  Ordered o(p);
  EXPECT_EQ(o.order, (std::vector<std::int32_t>{1, 4}));
  EXPECT_EQ(list(o.ordering.free_velocities), (std::vector<std::int32_t>{0, 2, 3}));
  EXPECT_FALSE(o.accepts(p, {0, 1, 4})) << "free velocities are not ordered";
}

TEST(Ordering, VelocityOfADisabledRowIsFree) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 2);
  add_row(p, {{0, 1}});
  const mlcp::Mask enabled = mask_of({MLCP_ROW_DISABLED});
  const Ordered o(p, &enabled);
  EXPECT_TRUE(o.order.empty());
  EXPECT_EQ(list(o.ordering.free_velocities), (std::vector<std::int32_t>{0}));
}

TEST(Ordering, NothingAtAll) { EXPECT_TRUE(Ordered(empty_problem()).order.empty()); }

/// Each node once, no row before a velocity that it touches; what is computed is accepted.
TEST(Ordering, RandomProblems) {
  Shape shape;
  shape.bodies_most = 10;
  shape.rows_most = 20;
  shape.dimension_most = 16;
  for (int seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, shape);
    const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.2);
    Ordered o(p, &enabled);
    std::vector<std::int32_t> all = o.order;
    for (const int j : list(o.ordering.free_velocities)) all.push_back(j);
    std::sort(all.begin(), all.end());
    std::vector<std::int32_t> wanted;
    for (int node = 0; node < p.n() + p.m(); ++node)
      if (o.selection.has(node)) wanted.push_back(node);
    ASSERT_EQ(all, wanted) << "seed " << seed;
    ASSERT_TRUE(o.accepts(p, std::vector<std::int32_t>(o.order))) << "seed " << seed;
  }
}

}  // namespace
}  // namespace support
