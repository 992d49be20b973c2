#include "measure/cone.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace mlcp {
namespace {

double dot3(const ContactVector& a, const ContactVector& b) { return a.n * b.n + dot(a.t, b.t); }

/// x = P + (x − P) with P ∈ K, x − P in the polar cone, orthogonal to P (Moreau 1962): characterises the projection.
void expect_projection(const Cone& cone, const ContactVector& x) {
  const ContactVector p = cone.project(x), rest{x.n - p.n, {x.t.x - p.t.x, x.t.y - p.t.y}};
  const double size = std::sqrt(dot3(x, x)) + 1e-300;
  EXPECT_NEAR(dot3(p, rest), 0, 1e-13 * size * size);
  const ContactVector again = cone.project(p);
  EXPECT_NEAR(again.n, p.n, 1e-13 * size);
  EXPECT_NEAR(again.t.x, p.t.x, 1e-13 * size);
  EXPECT_NEAR(again.t.y, p.t.y, 1e-13 * size);
  const int directions = cone.pyramid() ? cone.facets : 720;
  for (int j = 0; j < directions; ++j) {
    const double angle = 2 * M_PI * j / directions;
    const ContactVector g{1, {cone.mu * std::cos(angle), cone.planar ? 0 : cone.mu * std::sin(angle)}};
    EXPECT_LE(dot3(rest, g), 1e-12 * size) << "generator " << j;
  }
}

TEST(Cone, projection_is_moreaus) {
  support::Random random(7);
  for (const Cone& cone : {Cone{0.5, 0, false}, Cone{0.5, 8, false}, Cone{1.5, 3, false}, Cone{0.1, 4, false}, Cone{2, 32, false},
                           Cone{0.3, 8, true}})
    for (int i = 0; i < 300; ++i) {
      ContactVector x{random.uniform(-1, 1), {random.uniform(-1, 1), cone.planar ? 0 : random.uniform(-1, 1)}};
      expect_projection(cone, x);
    }
}

TEST(Cone, points_on_edges_and_axis) {
  const Cone cone{0.5, 8, false};
  for (int j = -1; j < 9; ++j) {
    const Tangent d = cone.direction(j);
    expect_projection(cone, {1, {0.5 * d.x, 0.5 * d.y}});
    expect_projection(cone, {-0.3, {d.x, d.y}});
  }
  expect_projection(cone, {1, {0, 0}});
  expect_projection(cone, {-1, {0, 0}});
  expect_projection(cone, {0, {0, 0}});
}

TEST(Cone, no_friction_is_a_ray) {
  const Cone cone{0, 8, false};
  EXPECT_EQ(cone.project({2, {1, 1}}).n, 2);
  EXPECT_EQ(cone.project({2, {1, 1}}).t.x, 0);
  EXPECT_EQ(cone.project({-2, {1, 1}}).n, 0);
}

TEST(Cone, facets_go_round_and_meet_the_axes_exactly) {
  const Cone cone{1, 8, false};
  EXPECT_EQ(cone.direction(0).x, 1);
  EXPECT_EQ(cone.direction(0).y, 0);
  EXPECT_EQ(cone.direction(2).x, 0);
  EXPECT_EQ(cone.direction(2).y, 1);
  EXPECT_EQ(cone.direction(4).x, -1);
  EXPECT_EQ(cone.direction(8).x, cone.direction(0).x);
  for (int j = 0; j < 8; ++j) EXPECT_EQ(cone.nearest_facet(cone.direction(j)), j);
  EXPECT_EQ(cone.nearest_facet({1, -1e-3}), 0);
}

TEST(Cone, support_is_the_largest_over_the_directions) {
  support::Random random(3);
  for (const int facets : {3, 5, 8, 17}) {
    const Cone cone{1, facets, false};
    for (int i = 0; i < 100; ++i) {
      const Tangent slip{random.uniform(-1, 1), random.uniform(-1, 1)};
      double most = 0;
      for (int j = 0; j < facets; ++j) most = std::max(most, -dot(cone.direction(j), slip));
      EXPECT_NEAR(cone.support(slip), most, 1e-15);
    }
  }
  EXPECT_EQ((Cone{1, 0, false}.support({3, 4})), 5);
}

TEST(Cone, defect_sees_each_of_the_three_conditions) {
  const Cone cone{0.5, 0, false};
  EXPECT_EQ(cone.defect({2, {-1, 0}}, {0.5, {1, 0}}, 1), 0);             // on the edge, w on the dual's opposite edge
  EXPECT_NEAR(cone.defect({0, {1, 0}}, {0, {0, 0}}, 3), 3 * std::sqrt(0.8), 1e-15);  // outside K
  EXPECT_NEAR(cone.defect({0, {0, 0}}, {-1, {0, 0}}, 1), 1, 1e-15);       // w into the obstacle
  EXPECT_NEAR(cone.defect({1, {0, 0}}, {1, {0, 0}}, 1), 1, 1e-15);        // both push
}

}  // namespace
}  // namespace mlcp
