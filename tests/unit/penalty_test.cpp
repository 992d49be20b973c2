// The penalty method of paper (2.1) on the scenes: how deep it sinks in and where it diverges, as the comparison in the README has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenes/scenes.h"

namespace scenes {
namespace {

constexpr std::int32_t boxes = 3, corners = 4;
constexpr double box_mass = 10;  // kg

/// Damped at a third of the critical rate of the fastest swing.
Scene::Springs springs(const Scene& scene, double stiffness) {
  const double omega = 2 / scene.largest_step_by_penalty({stiffness, 0});
  return {stiffness, 2.0 / 3 * stiffness / omega};
}

/// Two seconds, by when what can come to rest has.
void settle(Scene& scene, double stiffness, double share_of_largest_step) {
  const Scene::Springs contacts = springs(scene, stiffness);
  const double h = share_of_largest_step * scene.largest_step_by_penalty(contacts);
  for (double time = 0; time < 2; time += h) scene.step_by_penalty(h, contacts);
}

TEST(Penalty, a_tower_sinks_in_by_its_weight_over_the_stiffness) {
  for (const double stiffness : {1e5, 1e6}) {
    BoxStack tower = tower_scene(boxes);
    settle(tower, stiffness, 0.5);
    const double expected = boxes * box_mass * gravity / (corners * stiffness);
    EXPECT_NEAR(tower.violation().penetration, expected, 1e-3 * expected) << stiffness;
  }
}

TEST(Penalty, a_wall_comes_to_rest_below_the_largest_step_and_never_above) {
  const auto fastest = [](double share_of_largest_step) {
    BoxStack wall = wall_scene(3, 3);
    settle(wall, 1e5, share_of_largest_step);
    double speed = 0;
    for (const double v : wall.velocities()) speed = std::max(speed, std::fabs(v));
    return speed;
  };
  EXPECT_LT(fastest(0.95), 1e-4);
  EXPECT_GT(fastest(1.05), 1e-2);
}

TEST(Penalty, the_largest_step_of_a_mass_on_springs_is_two_over_omega) {
  const BoxStack box = tower_scene(1);
  // four springs below a cube: rolling swings it fastest, about the axis x where k = Σ s y² and I = m (2a)²/6, y = ±a
  const double s = 1e6, omega = std::sqrt(corners * s / (box_mass / 6 * 4));
  EXPECT_NEAR(box.largest_step_by_penalty({s, 0}), 2 / omega, 1e-9 * 2 / omega);
}

TEST(Penalty, constraints_do_not_sink_in_at_any_step) {
  for (const double h : {0.04, 0.01, 0.0025}) {
    BoxStack tower = tower_scene(boxes);
    for (int step = 0; step < 20; ++step) ASSERT_EQ(tower.step(h).outcome, MLCP_SOLVED);
    EXPECT_LT(tower.violation().penetration, 1e-12) << h;
  }
}

TEST(Penalty, joints_and_friction_are_refused) {
  Chain chain(3, true);
  Table table;
  EXPECT_THROW(chain.step_by_penalty(1e-4, {1e5, 0}), std::logic_error);
  EXPECT_THROW(table.step_by_penalty(1e-4, {1e5, 0}), std::logic_error);
}

}  // namespace
}  // namespace scenes
