#include "problem_file.h"

#include <array>
#include <fstream>
#include <numeric>

#include "fclib_file.h"
#include "problem_folder.h"

namespace cli {
namespace {

FileContacts contacts_of(const mlcp_problem* problem) {
  const auto count = static_cast<std::size_t>(mlcp_problem_contact_count(problem));
  FileContacts found = {std::vector<std::int32_t>(count), std::vector<double>(count), std::vector<mlcp_friction>(count)};
  handles::check(mlcp_problem_get_contacts(problem, static_cast<std::int32_t>(count), nullptr, found.dimension.data(), found.model.data(),
                                           found.mu.data(), nullptr));
  return found;
}

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
  file.contacts = contacts_of(problem);
  return file;
}

/// The model asked for, at every contact of a snapshot.
void set_friction(const ProblemFile& file, const Friction& friction) {
  const std::int32_t count = mlcp_problem_contact_count(file.problem.get());
  const std::vector<mlcp_friction> model(static_cast<std::size_t>(count), *friction.model);
  const std::vector<std::int32_t> facets(static_cast<std::size_t>(count), friction.facets);
  handles::check(mlcp_problem_contacts_set_friction(file.problem.get(), 0, count, model.data(), nullptr, nullptr, facets.data()),
                 file.problem);
}

}  // namespace

bool is_fclib(const std::filesystem::path& path) {
  constexpr std::array<char, 8> magic = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  std::array<char, 8> first{};
  std::ifstream file(path, std::ios::binary);
  file.read(first.data(), first.size());
  return file && first == magic;
}

ProblemFile read_problem(const std::filesystem::path& path, const Friction& friction) {
  if (std::filesystem::is_directory(path)) return read_folder(path, friction);
  if (!std::filesystem::exists(path)) throw std::runtime_error(path.string() + ": no such file or folder");
  if (is_fclib(path)) return read_fclib(path, friction);
  ProblemFile file = read_snapshot(path);
  if (friction.model) set_friction(file, friction);
  return file;
}

}  // namespace cli
