#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "../scenes/handles.h"

namespace cli {

/// Contacts that a file names, also where it was read without friction.
struct FileContacts {
  std::vector<std::int32_t> dimension;  // rows of each in the file
  std::vector<double> mu;
  std::vector<mlcp_friction> model;     // empty where the file names none: folders and FCLIB files
};

/// A PROBLEM of the command line, as it was read.
struct ProblemFile {
  handles::Problem problem;
  handles::Solver solver;       // a snapshot's settings and ordering; defaults for a folder
  handles::Mask enabled, start; // a snapshot's, if it has them
  std::int32_t file_rows = 0;
  std::vector<std::int32_t> file_row;  // of every row of the problem; rows of the file that are not there were left out
  FileContacts contacts;
};

/// Friction for all contacts of a file. Without a model a snapshot keeps its own, and files that name none are read without friction.
struct Friction {
  std::optional<mlcp_friction> model;
  std::int32_t facets = 0;
};

/// Reads a folder of Matrix Market files, a snapshot or an FCLIB file. Throws std::runtime_error naming file and cause.
ProblemFile read_problem(const std::filesystem::path& path, const Friction& friction = {});

}  // namespace cli
