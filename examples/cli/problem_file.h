#pragma once
#include <filesystem>
#include <vector>

#include "../scenes/handles.h"

namespace cli {

/// A PROBLEM of the command line, as it was read.
struct ProblemFile {
  handles::Problem problem;
  handles::Solver solver;       // a snapshot's settings and ordering; defaults for a folder
  handles::Mask enabled, start; // a snapshot's, if it has them
  std::int32_t file_rows = 0;
  std::vector<std::int32_t> file_row;  // of every row of the problem; rows of the file that are not there were left out
};

/// Reads a folder of Matrix Market files or a snapshot. Throws std::runtime_error naming file and cause.
ProblemFile read_problem(const std::filesystem::path& path);

}  // namespace cli
