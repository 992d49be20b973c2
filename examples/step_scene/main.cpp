// Steps every scene and prints what the solver did, cold in the first step and warm in the rest.
//   step_scene [STEPS [FOLDER]]     FOLDER: records the problem of every step there, as snapshots that `mlcp solve` reads
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "scenes/scenes.h"

namespace {

struct Totals {
  int solved = 0;
  std::int64_t pivots = 0;
  double seconds = 0, error = 0;

  void add(const mlcp_report& report) {
    solved += report.outcome == MLCP_SOLVED;
    pivots += report.pivots;
    seconds += report.seconds;
    error = std::max(error, report.largest_error);
  }
};

struct Options {
  int steps = 50;
  const char* folder = nullptr;  // where to record, null: nowhere
};

/// make(): the scene at its start. Returns whether every step was solved.
template <class Make>
bool run(const char* name, const Options& options, Make make) {
  auto scene = make();
  Totals cold, warm;
  std::int32_t rows = 0;
  for (int step = 0; step < options.steps; ++step) {
    (step == 0 ? cold : warm).add(scene.step(scenes::default_step));
    rows = std::max(rows, mlcp_problem_row_count(scene.problem()));
  }
  const int warm_steps = std::max(1, options.steps - 1);
  const int solved = cold.solved + warm.solved;
  std::printf("%-8s %10d %8d %6d/%-4d %8lld %9.2f %10.1f %9.2f %9.0e\n", name, mlcp_problem_velocity_count(scene.problem()), rows,
              solved, options.steps, static_cast<long long>(cold.pivots), 1e3 * cold.seconds,
              static_cast<double>(warm.pivots) / warm_steps, 1e3 * warm.seconds / warm_steps, std::max(cold.error, warm.error));
  std::fflush(stdout);
  if (options.folder) {
    auto again = make();
    scenes::record(again, options.steps, std::filesystem::path(options.folder) / name);
  }
  return solved == options.steps;
}

/// false: not legal
bool read_arguments(int argc, char** argv, Options& options) {
  if (argc > 1) {
    const std::string_view text = argv[1];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), options.steps);
    if (error != std::errc() || end != text.data() + text.size() || options.steps < 1) return false;
  }
  if (argc > 2) options.folder = argv[2];
  return argc <= 3;
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  if (!read_arguments(argc, argv, options)) {
    std::fprintf(stderr, "usage: step_scene [STEPS [FOLDER]]\n");
    return 3;
  }
  std::printf("%-8s %10s %8s %11s %8s %9s %10s %9s %9s\n", "", "", "", "steps", "first", "", "then", "", "largest");
  std::printf("%-8s %10s %8s %11s %8s %9s %10s %9s %9s\n", "scene", "velocities", "rows", "solved", "pivots", "ms", "pivots", "ms",
              "error");
  bool solved = true;
  solved &= run("pile", options, [] { return scenes::Pile(300); });
  solved &= run("chain", options, [] { return scenes::Chain(1000, true); });
  solved &= run("rope", options, [] { return scenes::Rope(1000); });
  solved &= run("tower", options, [] { return scenes::tower_scene(10, 1e4); });
  solved &= run("wall", options, [] { return scenes::wall_scene(8, 8); });
  return solved ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "step_scene: %s\n", error.what());
  return 1;
}
