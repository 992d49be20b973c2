// The same scene with contacts as constraints and as stiff springs, paper (2.5) against (2.1): how deep bodies sink in, and the step and the time it takes.
//   penalty_comparison [SCENE SIZE]     a scene of contacts without friction: tower, wall, pile; all three without arguments
// Springs are damped so that the fastest swing of the scene decays at a third of its critical rate, and stepped at nine tenths of the longest step
// that lets it come to rest. The overlap is the deepest in the second half: what is left when all has come to rest.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <functional>

#include "scenes/scenes.h"

namespace {

constexpr double seconds = 1;  // of the scene

struct Run {
  double step, overlap, cost;  // s, m, s of the processor
};

Run run(scenes::Scene& scene, double step, const std::function<void(double)>& take_step) {
  Run result = {step, 0, 0};
  const long steps = std::lround(seconds / step);
  for (long i = 0; i < steps; ++i) {
    const std::clock_t begin = std::clock();
    take_step(step);
    result.cost += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (2 * i >= steps) result.overlap = std::max(result.overlap, scene.violation().penetration);
  }
  return result;
}

Run run_rigid(const char* name, std::int32_t size) {
  const auto scene = scenes::make_scene(name, size);
  return run(*scene, scenes::default_step, [&](double h) {
    if (scene->step(h).outcome != MLCP_SOLVED) throw std::runtime_error("a step is not solved");
  });
}

Run run_springs(const char* name, std::int32_t size, double stiffness) {
  const auto scene = scenes::make_scene(name, size);
  // without dampers the longest step is 2/ω
  const double omega = 2 / scene->largest_step_by_penalty({stiffness, 0}), zeta = 1.0 / 3;
  const scenes::Scene::Springs springs = {stiffness, 2 * zeta * stiffness / omega};
  return run(*scene, 0.9 * scene->largest_step_by_penalty(springs), [&](double h) { scene->step_by_penalty(h, springs); });
}

void print(const char* contacts, const Run& run) {
  std::printf("  %-20s %12.4f %14.1e %9ld %12.3f\n", contacts, 1e3 * run.step, 1e3 * run.overlap, std::lround(seconds / run.step), run.cost);
  std::fflush(stdout);
}

void compare(const char* name, std::int32_t size) {
  std::printf("%s, %d: %g s\n  %-20s %12s %14s %9s %12s\n", name, size, seconds, "contacts", "step, ms", "overlap, mm", "steps", "processor, s");
  const Run rigid = run_rigid(name, size);
  print("constraints", rigid);
  Run springs = {};
  for (const double stiffness : {1e5, 1e6, 1e7, 1e8}) {
    char text[32];
    std::snprintf(text, sizeof text, "springs, %.0e N/m", stiffness);
    print(text, springs = run_springs(name, size, stiffness));
  }
  // what rests sinks in by its load over s, what moves by more than that; the step falls with 1/√s
  const double stiffer = springs.overlap / std::max(rigid.overlap, 1e-9);
  std::printf("  springs that sink in as little, or 1 nm, need at best a step of %.1e ms and %.0e s of the processor\n",
              1e3 * springs.step / std::sqrt(stiffer), springs.cost * std::sqrt(stiffer));
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 1 && argc != 3) {
    std::fprintf(stderr, "usage: penalty_comparison [SCENE SIZE]\n");
    return 3;
  }
  if (argc == 3) {
    compare(argv[1], std::atoi(argv[2]));
    return 0;
  }
  for (const auto& [name, size] : {std::pair{"tower", 10}, {"wall", 6}, {"pile", 100}}) compare(name, size);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "penalty_comparison: %s\n", error.what());
  return 1;
}
