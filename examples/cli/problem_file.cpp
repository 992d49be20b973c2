#include "problem_file.h"

#include <numeric>

#include "problem_folder.h"

namespace cli {
namespace {

ProblemFile read_snapshot(const std::filesystem::path& path) {
  mlcp_problem* problem = nullptr;
  mlcp_solver* solver = nullptr;
  mlcp_mask *enabled = nullptr, *start = nullptr;
  char message[512];
  handles::check(mlcp_snapshot_load(path.c_str(), nullptr, &problem, &solver, &enabled, &start, message, sizeof message),
                 message);
  ProblemFile file;
  file.problem.reset(problem);
  file.solver.reset(solver);
  file.enabled.reset(enabled);
  file.start.reset(start);
  file.file_rows = mlcp_problem_row_count(problem);
  file.file_row.resize(static_cast<std::size_t>(file.file_rows));
  std::iota(file.file_row.begin(), file.file_row.end(), 0);
  return file;
}

}  // namespace

ProblemFile read_problem(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return read_folder(path);
  if (!std::filesystem::exists(path)) throw std::runtime_error(path.string() + ": no such file or folder");
  return read_snapshot(path);
}

}  // namespace cli
