#include <gtest/gtest.h>

#include <cmath>

#include "scenes/geometry/box_contacts.h"
#include "scenes/geometry/cam_contacts.h"
#include "scenes/geometry/capsule_contacts.h"
#include "scenes/geometry/sphere_contacts.h"
#include "scenes/random.h"

namespace scenes {
namespace {

constexpr double pi = 3.14159265358979323846;

Point random_point(Random& random, double size) {
  Point point;
  for (double& coordinate : point) coordinate = random.uniform(-size, size);
  return point;
}

Frame random_frame(Random& random, double size) {
  return {random_point(random, size), Rotation::about(unit(random_point(random, 1)), random.uniform(0, 2 * pi))};
}

/// The surfaces meet the point halfway, and moving b along the normal opens the gap as much.
template <class ContactAt>
void expect_normal_is_gradient(const ContactAt& contact_at, const Point& centre) {
  const ContactPoint here = contact_at(centre);
  EXPECT_NEAR(length(here.normal), 1, 1e-12);
  constexpr double d = 1e-5;
  for (const Point& axis : axes) {
    const double slope = (contact_at(centre + d * axis).gap - contact_at(centre - d * axis).gap) / (2 * d);
    EXPECT_NEAR(slope, dot(here.normal, axis), 1e-4);
  }
}

TEST(Geometry, normals_are_gradients_of_gaps) {
  Random random(3);
  for (int round = 0; round < 100; ++round) {
    const Frame frame = random_frame(random, 1);
    const Point centre = frame.origin + (2.0 + random.uniform()) * unit(random_point(random, 1));
    const Sphere ball{0.3};
    expect_normal_is_gradient([&](const Point& at) { return contact(Plane{{0, 0, 1}, 0.2}, frame, ball, at); }, centre);
    expect_normal_is_gradient([&](const Point& at) { return contact(Sphere{0.5}, frame.origin, ball, at); }, centre);
    expect_normal_is_gradient([&](const Point& at) { return contact(Capsule{0.6, 0.2}, frame, ball, at); }, centre);
    expect_normal_is_gradient([&](const Point& at) { return contact(Box{{0.4, 0.5, 0.6}}, frame, ball, at); }, centre);
  }
}

TEST(Geometry, the_bore_of_a_cam_keeps_a_sphere_in) {
  const AnnularCam cone{{{-1, 1}, {1, 2}}};
  const Frame frame = {{0.1, 0.2, 0.3}, Rotation::about(unit({1, 2, 3}), 0.7)};
  Random random(5);
  for (int round = 0; round < 100; ++round) {
    const double angle = random.uniform(0, 2 * pi), from_axis = random.uniform(0.2, 1.4);
    const Point local = {from_axis * std::cos(angle), from_axis * std::sin(angle), random.uniform(-0.1, 0.1)};
    const auto at = [&](const Point& centre) { return contact(cone, frame, Sphere{0.1}, centre); };
    expect_normal_is_gradient(at, frame.to_world(local));
    // the wall r = 1.5 + z/2 lies at right angles to (1, −1/2)
    EXPECT_NEAR(at(frame.to_world(local)).gap, (1.5 + 0.5 * local[2] - from_axis) / std::sqrt(1.25) - 0.1, 1e-12);
  }
}

TEST(Geometry, capsules_are_as_far_apart_as_their_nearest_points) {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    const Capsule a{0.8, 0.1}, b{0.5, 0.2};
    const Frame frame_a = random_frame(random, 1), frame_b = random_frame(random, 1);
    double nearest = INFINITY;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j)
        nearest = std::fmin(nearest, length(frame_a.to_world({0, 0, a.half_length * (i / 100.0 - 1)}) -
                                            frame_b.to_world({0, 0, b.half_length * (j / 100.0 - 1)})));
    const ContactPoint found = contact(a, frame_a, b, frame_b);
    EXPECT_LE(found.gap, nearest - 0.3 + 1e-12);
    EXPECT_GE(found.gap, nearest - 0.3 - 0.02);
  }
}

TEST(Geometry, capsules_side_by_side_touch_at_both_ends_of_what_they_share) {
  const auto found = contacts(Capsule{1, 0.1}, {}, Capsule{0.5, 0.2}, {{0.31, 0, 0.75}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].point[2], 0.25, 1e-12);
  EXPECT_NEAR(found[1].point[2], 1, 1e-12);
  for (const ContactPoint& at : found) EXPECT_NEAR(at.gap, 0.01, 1e-12);
  EXPECT_EQ(contacts(Capsule{1, 0.1}, {}, Capsule{0.5, 0.2}, {{0.31, 0, 0}, Rotation::about(axes[0], 1)}).size(), 1u);
}

TEST(Geometry, a_box_on_a_box_touches_with_the_corners_of_the_face_they_share) {
  const Box box{{0.5, 0.5, 0.5}};
  const auto found = contacts(box, {}, box, {{0.25, 0.5, 1.01}}, 0.02);
  ASSERT_EQ(found.size(), 4u);
  for (const ContactPoint& at : found) {
    EXPECT_NEAR(at.gap, 0.01, 1e-12);
    EXPECT_NEAR(at.normal[2], 1, 1e-12);
    EXPECT_NEAR(std::fabs(at.point[0] - 0.125), 0.375, 1e-12);
    EXPECT_NEAR(std::fabs(at.point[1] - 0.25), 0.25, 1e-12);
  }
  EXPECT_TRUE(contacts(box, {}, box, {{0, 0, 1.03}}, 0.02).empty());
}

TEST(Geometry, crossed_edges_touch_in_one_point) {
  const Box box{{0.5, 0.5, 0.5}};
  const double reach = std::sqrt(0.5);
  const Frame lower = {{0, 0, 0}, Rotation::about(axes[0], pi / 4)}, upper = {{0, 0, 2 * reach - 0.01}, Rotation::about(axes[1], pi / 4)};
  const auto found = contacts(box, lower, box, upper, 0.02);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].gap, -0.01, 1e-12);
  EXPECT_NEAR(found[0].normal[2], 1, 1e-12);
  EXPECT_NEAR(found[0].point[2], reach - 0.005, 1e-12);
}

TEST(Geometry, features_of_boxes_are_different_and_stay) {
  const Box box{{0.5, 0.5, 0.5}};
  Random random(9);
  for (int round = 0; round < 200; ++round) {
    const Frame upper = {{0.3, 0.2, 1}, Rotation::about(axes[2], random.uniform(0, pi))};
    const Frame later = {upper.origin + Point{1e-7, 1e-7, 0}, upper.rotation};
    const auto found = contacts(box, {}, box, upper, 0.02), again = contacts(box, {}, box, later, 0.02);
    ASSERT_EQ(found.size(), again.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].feature, again[i].feature);
      for (std::size_t j = 0; j < i; ++j) EXPECT_NE(found[i].feature, found[j].feature);
    }
  }
}

}  // namespace
}  // namespace scenes
