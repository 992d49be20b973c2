// Scenes over many steps: solved, joined, not overlapping, and no energy from nowhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "scenes/scenes.h"

namespace scenes {
namespace {

bool long_run() { return std::getenv("MLCP_TEST_LONG") != nullptr; }

/// How a scene of the gallery must behave, at a size that a test can afford.
struct Expected {
  const char* name;
  std::int32_t size;
  int steps;
  double penetration, drift;  // m, at most
  double created;             // in so many steps: sum of all rises of the energy over that at the start; what is driven has none to keep
  double step = default_step;
};

class Machines : public testing::TestWithParam<Expected> {};

TEST_P(Machines, steps_are_solved_joints_hold_and_energy_is_not_created) {
  const Expected& expected = GetParam();
  const auto scene = make_scene(expected.name, expected.size);
  const int steps = long_run() ? 1000 : expected.steps;
  constexpr int begins = 10;  // steps in which what overlaps at the start is pushed apart
  double energy = scene->energy(), created = 0;
  const double at_start = std::fabs(energy);
  for (int step = 0; step < steps; ++step) {
    const mlcp_report& report = scene->step(expected.step);
    ASSERT_EQ(report.outcome, MLCP_SOLVED) << "step " << step << ", error " << report.largest_error;
    const double before = energy;
    energy = scene->energy();
    if (step < begins) continue;
    created += std::max(0.0, energy - before);
    const Scene::Violation now = scene->violation();
    EXPECT_LE(now.drift, expected.drift) << "step " << step;
    EXPECT_LE(now.penetration, expected.penetration) << "step " << step;
  }
  if (!scene->driven()) {
    EXPECT_LE(created, expected.created * at_start * steps / expected.steps);
  }
}

INSTANTIATE_TEST_SUITE_P(Gallery, Machines,
                         testing::Values(Expected{"gripper", 8, 60, 1e-3, 1e-4, 0}, Expected{"cascade", 30, 80, 0.02, 0, 1e-6},
                                         Expected{"bottles", 10, 300, 1e-4, 1e-5, 0}, Expected{"wall_of_boxes", 4, 60, 0.01, 0, 1e-6},
                                         Expected{"pile", 60, 60, 1e-3, 0, 1e-6}, Expected{"chain", 20, 60, 1e-2, 1e-2, 1e-3},
                                         Expected{"chain", 200, 60, 1e-6, 1e-6, 1e-6, 2e-3}, Expected{"rope", 200, 60, 1e-3, 1e-3, 1e-3, 1e-3},
                                         Expected{"rope", 60, 60, 1e-2, 1e-2, 0.02}, Expected{"tower", 6, 60, 1e-9, 0, 1e-9},
                                         Expected{"wall", 4, 60, 1e-9, 0, 1e-9}, Expected{"linkage", 1, 60, 1e-6, 2e-3, 0},
                                         Expected{"table", 1, 60, 1e-6, 0, 1e-6}, Expected{"rope_over_pegs", 30, 60, 1e-3, 1e-3, 1e-3}),
                         [](const auto& test) { return std::string(test.param.name) + "_" + std::to_string(test.param.size); });

TEST(Gripper, centres_the_part) {
  Gripper gripper(8);
  const double askew = gripper.part_off_centre();
  EXPECT_GT(askew, 5e-3);
  for (int step = 0; step < 60; ++step) ASSERT_EQ(gripper.step(default_step).outcome, MLCP_SOLVED);
  // what is left is the part's weight over the stiffness of the pads, and the motor's force over it
  EXPECT_LT(gripper.part_off_centre(), 3e-5);
  EXPECT_GT(gripper.closed(), 0.4 * Gripper::stroke);
  EXPECT_LT(gripper.closed(), Gripper::stroke) << "the part, not the stop, holds the cam";
}

TEST(Gripper, lets_go_again) {
  Gripper gripper(8);
  for (double time = 0; time < 0.9 * Gripper::period; time += default_step) gripper.step(default_step);
  EXPECT_NEAR(gripper.closed(), 0, 1e-6);
  EXPECT_GT(gripper.part_off_centre(), 5e-3);
}

TEST(Bottles, every_one_gets_through_the_machine) {
  constexpr int bottles = 6;
  BottleLine line(bottles);
  for (int step = 0; step < 3000; ++step) ASSERT_EQ(line.step(default_step).outcome, MLCP_SOLVED) << step;
  for (const std::int32_t rounds : line.rounds()) EXPECT_GE(rounds, 1);
}

}  // namespace
}  // namespace scenes
