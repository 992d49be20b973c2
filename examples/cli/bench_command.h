#pragma once
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct BenchOptions {
  std::vector<std::string> problems;
  std::vector<double> tolerances = {1e-3, 1e-6, 1e-9, 1e-12};
  double seconds = 2;                 // for all turns on one problem
  std::optional<double> max_seconds;  // of one solve
  std::string output = "text";
};

/// Times every method of the library at every tolerance on each problem and prints time against error: medians of solves in turns, wall
/// clock, from no active set. Cold: a new solver, analysis included. Known: the same solver again. Throws std::exception for bad input.
void run_bench(const BenchOptions& options);

}  // namespace cli
