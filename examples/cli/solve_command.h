#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace cli {

/// What was said on the command line; what was not comes from the snapshot, or is the library's default.
struct SolveOptions {
  std::string problem;
  std::optional<std::string> method, pivot_rule, refactorize;
  std::optional<double> tolerance, max_seconds;
  std::optional<std::string> friction;
  std::optional<std::int32_t> facets;
  std::string output = "text";
  bool trace = false;
};

/// Exit codes of the program.
enum Exit : int { Solved = 0, Limit = 1, NoSolution = 2, BadInput = 3 };

/// Reads, solves, prints to standard output. Throws std::exception for bad input.
Exit run_solve(const SolveOptions& options);

}  // namespace cli
