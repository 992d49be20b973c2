#include "scenes/scenes.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <set>

namespace scenes {
namespace {

std::vector<std::uint64_t> keys_of(const Problem& problem) {
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(mlcp_problem_row_count(problem.get())));
  const auto count = static_cast<std::int32_t>(keys.size());
  check(mlcp_problem_get_rows(problem.get(), count, nullptr, nullptr, nullptr, nullptr, keys.data()));
  return keys;
}

/// FNV-1a over all that makes a problem: masses, momentum, Jacobian, r, lo, keys.
std::uint64_t hash_of(const Problem& problem) {
  std::uint64_t hash = 14695981039346656037u;
  const auto mix = [&](const auto* values, std::size_t count) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values);
    for (std::size_t i = 0; i < count * sizeof *values; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  };
  for (const auto view_of : {mlcp_problem_mass, mlcp_problem_jacobian}) {
    mlcp_matrix_view view;
    mlcp_matrix_view_init(&view, sizeof view);
    check(view_of(problem.get(), &view));
    mix(view.indices, static_cast<std::size_t>(view.entries));
    mix(view.values, static_cast<std::size_t>(view.entries));
  }
  const auto rows = static_cast<std::size_t>(mlcp_problem_row_count(problem.get()));
  std::vector<double> r(rows), lo(rows), k(static_cast<std::size_t>(mlcp_problem_velocity_count(problem.get())));
  const std::vector<std::uint64_t> keys = keys_of(problem);
  check(mlcp_problem_get_rows(problem.get(), static_cast<std::int32_t>(rows), r.data(), lo.data(), nullptr, nullptr, nullptr));
  check(mlcp_problem_get_momentum(problem.get(), static_cast<std::int32_t>(k.size()), k.data()));
  mix(r.data(), rows);
  mix(lo.data(), rows);
  mix(keys.data(), rows);
  mix(k.data(), k.size());
  return hash;
}

struct Solution {
  mlcp_report report;
  std::vector<double> v, gamma;
};

Solution solve(const Problem& problem) {
  const Solver solver = make_solver();
  Solution solution;
  mlcp_report_init(&solution.report, sizeof solution.report);
  check(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, &solution.report), solver);
  const double* values = nullptr;
  std::int32_t count = 0;
  check(mlcp_solver_velocities(solver.get(), &values, &count));
  solution.v.assign(values, values + count);
  check(mlcp_solver_impulses(solver.get(), &values, &count));
  solution.gamma.assign(values, values + count);
  return solution;
}

TEST(Scenes, have_the_rows_they_promise) {
  for (const int contacts : {1, 3, 10, 30, 100, 1000}) {
    EXPECT_EQ(mlcp_problem_row_count(pile(contacts).get()), contacts);
  }
  EXPECT_EQ(mlcp_problem_row_count(chain(40, false).get()), 80);
  EXPECT_EQ(mlcp_problem_row_count(chain(40, true).get()), 120);
  EXPECT_EQ(mlcp_problem_velocity_count(chain(40, true).get()), 120);
  EXPECT_EQ(mlcp_problem_row_count(rope(40).get()), 81);
  EXPECT_EQ(mlcp_problem_row_count(tower(7).get()), 28);
  EXPECT_EQ(mlcp_problem_row_count(wall(5, 4).get()), 4 * (5 + 3 * 2 * 5));
}

TEST(Scenes, keys_are_unique_and_not_zero) {
  for (const Problem& problem : {pile(500), chain(50, true), rope(200), tower(10), wall(6, 5)}) {
    std::vector<std::uint64_t> keys = keys_of(problem);
    EXPECT_EQ(std::count(keys.begin(), keys.end(), 0u), 0);
    EXPECT_EQ(std::set(keys.begin(), keys.end()).size(), keys.size());
  }
}

// The same bits with every compiler and CPU: only + − × ÷ √ of exactly specified random numbers. A change of a scene
// changes its hash here, and with it every recorded benchmark.
TEST(Scenes, are_the_same_bits_everywhere) {
  EXPECT_EQ(hash_of(pile(300)), 3020438141083310583u);
  EXPECT_EQ(hash_of(chain(30, true, 10)), 186800890986691249u);
  EXPECT_EQ(hash_of(rope(100)), 2270114224723134725u);
  EXPECT_EQ(hash_of(tower(5, 100)), 5315512287744067301u);
  EXPECT_EQ(hash_of(wall(4, 4)), 15262159659764197321u);
  EXPECT_NE(hash_of(pile(300, 2)), hash_of(pile(300)));
  EXPECT_NE(hash_of(rope(100, 2)), hash_of(rope(100)));
}

TEST(Scenes, near_pairs_finds_every_close_pair) {
  const Packing packing = settle_spheres(60, 3);
  const double cell = 0.15;
  const auto pairs = near_pairs(packing.centre, cell);
  EXPECT_EQ(std::set(pairs.begin(), pairs.end()).size(), pairs.size());
  for (std::int32_t a = 0; a < 60; ++a) {
    for (std::int32_t b = a + 1; b < 60; ++b) {
      const double distance = length(packing.centre[static_cast<std::size_t>(a)] - packing.centre[static_cast<std::size_t>(b)]);
      const bool found = std::binary_search(pairs.begin(), pairs.end(), std::pair(a, b));
      EXPECT_TRUE(found || distance >= cell);
    }
  }
}

TEST(Scenes, spheres_settle_without_deep_overlaps) {
  const Packing packing = settle_spheres(500, 1);
  for (const auto& [a, b] : near_pairs(packing.centre, 2 * largest_radius)) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    EXPECT_GT(length(packing.centre[i] - packing.centre[j]), packing.radius[i] + packing.radius[j] - 0.02 * mean_radius);
  }
}

TEST(Scenes, a_pile_has_many_active_contacts_and_some_open_ones) {
  const Solution solution = solve(pile(1000));
  EXPECT_EQ(solution.report.outcome, MLCP_SOLVED);
  EXPECT_GT(solution.report.active_rows, 333);
  EXPECT_LT(solution.report.active_rows, 950);
  EXPECT_GE(*std::min_element(solution.gamma.begin(), solution.gamma.end()), 0);
}

TEST(Scenes, every_joint_of_a_tower_carries_what_stands_on_it) {
  constexpr int boxes = 6;
  constexpr double mass_ratio = 1e4, mass = 10;
  const Solution solution = solve(tower(boxes, mass_ratio));
  ASSERT_EQ(solution.report.outcome, MLCP_SOLVED);
  for (int i = 0; i < boxes; ++i) {
    const double above = mass * (boxes - 1 - i) + mass * mass_ratio;
    double carried = 0;
    for (std::size_t corner = 0; corner < 4; ++corner) carried += solution.gamma[4 * static_cast<std::size_t>(i) + corner];
    EXPECT_NEAR(carried, default_step * gravity * above, 1e-12 * default_step * gravity * above) << "box " << i;
  }
  for (const double v : solution.v) EXPECT_NEAR(v, 0, 1e-12);
}

TEST(Scenes, the_ground_carries_the_whole_wall) {
  constexpr int width = 5, height = 6;
  const Solution solution = solve(wall(width, height));
  ASSERT_EQ(solution.report.outcome, MLCP_SOLVED);
  double carried = 0;
  for (std::size_t i = 0; i < 4 * width; ++i) carried += solution.gamma[i];
  double weight = 0;
  const BoxStack scene = wall_scene(width, height);
  for (const RigidBody& brick : scene.bodies()) weight += gravity * brick.mass;
  EXPECT_NEAR(carried, default_step * weight, 1e-12 * weight);
}

TEST(Scenes, joints_of_a_chain_stay_closed_and_contacts_do_not_pull) {
  const Problem problem = chain(100, true, 1000);
  const Solution solution = solve(problem);
  ASSERT_EQ(solution.report.outcome, MLCP_SOLVED);
  EXPECT_LT(solution.report.largest_error, 1e-12);
  for (std::size_t row = 2; row < solution.gamma.size(); row += 3) EXPECT_GE(solution.gamma[row], 0);
}

TEST(Scenes, warm_steps_need_few_pivots) {
  mlcp_settings pivoting;
  mlcp_settings_init(&pivoting, sizeof pivoting);
  pivoting.method = MLCP_METHOD_SIMPLEX;
  const auto later_pivots = [&](Scene&& scene) {
    scene.use(pivoting);
    std::int64_t first = scene.step(default_step).pivots, later = 0;
    constexpr int steps = 20;
    for (int i = 0; i < steps; ++i) {
      const mlcp_report& report = scene.step(default_step);
      EXPECT_EQ(report.outcome, MLCP_SOLVED);
      EXPECT_LT(report.largest_error, 1e-12);
      later += report.pivots;
    }
    return std::pair(first, later / steps);
  };
  for (const auto& [first, later] : {later_pivots(Pile(60)), later_pivots(Rope(100)), later_pivots(Chain(30, true)),
                                     later_pivots(tower_scene(8, 100)), later_pivots(wall_scene(4, 4))}) {
    EXPECT_LT(2 * later, first);
  }
}

TEST(Scenes, a_tower_stands) {
  BoxStack scene = tower_scene(5);
  for (int i = 0; i < 100; ++i) scene.step(default_step);
  EXPECT_NEAR(scene.bodies().back().frame.origin[2], 4.5 * 0.5, 1e-9);
  EXPECT_NEAR(scene.bodies().back().frame.rotation.w, 1, 1e-9);
}

TEST(Scenes, draw_says_where_every_row_acts) {
  for (const Exhibit& exhibit : gallery()) {
    SCOPED_TRACE(exhibit.name);
    const auto made = make_scene(exhibit.name, 5);
    Scene& scene = *made;
    scene.prepare(default_step);
    Drawing drawing;
    scene.draw(drawing);
    EXPECT_EQ(drawing.actions.size(), static_cast<std::size_t>(mlcp_problem_row_count(scene.problem())));
    EXPECT_FALSE(drawing.spheres.empty() && drawing.boxes.empty() && drawing.faces.empty() && drawing.paths.empty());
    // the direction is that of the row: J of body b begins with it, in the plane without its y
    mlcp_matrix_view j;
    mlcp_matrix_view_init(&j, sizeof j);
    check(mlcp_problem_jacobian(scene.problem(), &j));
    std::int32_t dimension = 0;
    check(mlcp_problem_body_range(scene.problem(), 0, nullptr, &dimension));
    // which components of the direction the first velocities of a body are
    const std::string name = exhibit.name;
    const std::vector<std::size_t> axes_of = name == "chain" || name == "rope" || name == "linkage" || name == "rope_over_pegs" ? std::vector<std::size_t>{0, 2}
                                             : name == "bottles"               ? std::vector<std::size_t>{0, 1}
                                                                               : std::vector<std::size_t>{0, 1, 2};
    for (std::int32_t i = 0; i < j.rows; ++i) {
      const auto& [point, d] = drawing.actions[static_cast<std::size_t>(i)];
      const double* b = j.values + j.pointers[i + 1] - dimension;
      for (std::size_t k = 0; k < axes_of.size(); ++k) EXPECT_NEAR(b[k], d[axes_of[k]], 1e-12);
      EXPECT_NEAR(length(d) * (length(d) - 1), 0, 1e-12);  // 0: the row turns
    }
  }
}

TEST(Scenes, the_gallery_refuses_what_it_does_not_have) {
  EXPECT_THROW(make_scene("gripper on the moon", 1), std::invalid_argument);
  EXPECT_THROW(make_scene("pile", 0), std::invalid_argument);
}

TEST(Scenes, a_recorded_step_replays_to_the_same_bits) {
  const auto folder = support::scratch_folder() / "mlcp_scenes_test";
  Rope recorded(30);
  ASSERT_EQ(record(recorded, 3, folder), 3);
  Rope again(30);
  for (const char* name : {"000.mlcp", "001.mlcp", "002.mlcp"}) {
    again.step(default_step);
    mlcp_problem* problem = nullptr;
    mlcp_solver* solver = nullptr;
    mlcp_mask* start = nullptr;
    check(mlcp_snapshot_load((folder / name).c_str(), nullptr, &problem, &solver, nullptr, &start, nullptr, 0));
    const Problem problem_owner(problem);
    const Solver solver_owner(solver);
    const Mask start_owner(start);
    check(mlcp_solve(solver, problem, nullptr, start, nullptr), solver_owner);
    const double* v = nullptr;
    std::int32_t count = 0;
    check(mlcp_solver_velocities(solver, &v, &count));
    ASSERT_EQ(static_cast<std::size_t>(count), again.velocities().size());
    EXPECT_EQ(std::memcmp(v, again.velocities().data(), again.velocities().size_bytes()), 0) << name;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace scenes
