// Steps every scene and prints how well it goes: solved steps, overlaps, joints that drift, energy from nowhere, time.
//   step_scene [STEPS [FOLDER [SCENE...]]]     FOLDER: records the problem of every step there, as snapshots that `mlcp solve` reads; "-": nowhere
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "scenes/scenes.h"

namespace {

struct Options {
  int steps = 50;
  const char* folder = nullptr;  // where to record, null: nowhere
  std::span<char*> names;        // of the scenes, empty: all

  bool wants(std::string_view name) const { return names.empty() || std::find(names.begin(), names.end(), name) != names.end(); }
};

struct Listed {
  const char* name;
  std::int32_t size;
  double step = scenes::default_step;
};

/// Sizes are those of the README's table; steps are shorter where the tension asks for it, see chain.h.
constexpr Listed listed[] = {{"gripper", 8}, {"bottles", 24}, {"cascade", 100}, {"wall_of_boxes", 5}, {"linkage", 1}, {"table", 1},
                             {"rope_over_pegs", 30}, {"pile", 300}, {"chain", 30}, {"chain", 1000, 1e-3}, {"rope", 1000, 1e-3},
                             {"tower", 10}, {"wall", 8}};

/// What is remarkable over all steps.
struct Record {
  int solved = 0;
  std::int32_t rows = 0;
  std::int64_t pivots = 0;
  double seconds = 0;  // of the processor: finding contacts, assembling, solving, moving
  double error = 0;
  double penetration = 0, drift = 0;  // after the tenth step: by then what overlaps at the start has been pushed apart
  double risen = 0;                   // sum of all rises of the energy, J
};

Record run(scenes::Scene& scene, double h, int steps) {
  Record record;
  double energy = scene.energy();
  for (int step = 0; step < steps; ++step) {
    const std::clock_t begin = std::clock();
    const mlcp_report& report = scene.step(h);
    record.seconds += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    record.solved += report.outcome == MLCP_SOLVED;
    record.rows = std::max(record.rows, mlcp_problem_row_count(scene.problem()));
    record.pivots += report.pivots;
    record.error = std::max(record.error, report.largest_error);
    const double before = energy;
    energy = scene.energy();
    if (step < 10) continue;
    const scenes::Scene::Violation now = scene.violation();
    record.penetration = std::max(record.penetration, now.penetration);
    record.drift = std::max(record.drift, now.drift);
    record.risen += std::max(0.0, energy - before);
  }
  return record;
}

/// Returns whether every step was solved.
bool run(const Listed& which, const Options& options) {
  const auto& [name, size, h] = which;
  const auto scene = scenes::make_scene(name, size);
  const double energy = std::fabs(scene->energy());
  const Record record = run(*scene, h, options.steps);
  std::printf("%-14s %5d %4.0f %6d %6d/%-5d %9.3f %9.4f ", name, size, 1e3 * h, record.rows, record.solved, options.steps,
              1e3 * record.penetration, 1e3 * record.drift);
  if (scene->driven())
    std::printf("%9s", "driven");
  else
    std::printf("%9.0e", record.risen / energy);
  std::printf(" %8.1f %9.2f %10.1f %9.0e\n", static_cast<double>(record.pivots) / options.steps, 1e3 * record.seconds / options.steps,
              options.steps * h / record.seconds, record.error);
  std::fflush(stdout);
  if (options.folder) {
    const auto again = scenes::make_scene(name, size);
    scenes::record(*again, options.steps, std::filesystem::path(options.folder) / std::string(name).append("_").append(std::to_string(size)), h);
  }
  return record.solved == options.steps;
}

/// false: not legal
bool read_arguments(int argc, char** argv, Options& options) {
  if (argc > 1) {
    const std::string_view text = argv[1];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), options.steps);
    if (error != std::errc() || end != text.data() + text.size() || options.steps < 1) return false;
  }
  if (argc > 2 && argv[2] != std::string_view("-")) options.folder = argv[2];
  if (argc > 3) options.names = std::span(argv + 3, argv + argc);
  const auto known = [](std::string_view name) {
    return std::any_of(std::begin(listed), std::end(listed), [&](const auto& scene) { return name == scene.name; });
  };
  return std::all_of(options.names.begin(), options.names.end(), known);
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  if (!read_arguments(argc, argv, options)) {
    std::fprintf(stderr, "usage: step_scene [STEPS [FOLDER [SCENE...]]]\n");
    return 3;
  }
  std::printf("%-14s %5s %4s %6s %12s %9s %9s %9s %8s %9s %10s %9s\n", "", "", "step", "most", "steps", "overlap", "drift", "energy", "", "", "faster than", "largest");
  std::printf("%-14s %5s %4s %6s %12s %9s %9s %9s %8s %9s %10s %9s\n", "scene", "size", "ms", "rows", "solved", "mm", "mm", "created", "pivots",
              "ms", "real time", "error");
  bool solved = true;
  for (const Listed& which : listed)
    if (options.wants(which.name)) solved &= run(which, options);
  return solved ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "step_scene: %s\n", error.what());
  return 1;
}
