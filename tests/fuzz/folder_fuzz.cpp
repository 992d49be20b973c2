// Folders of Matrix Market files, as the program reads them: refused with a text, or a legal problem that can be written, read again and solved.
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#include <unistd.h>

#include "cli/problem_folder.h"
#include "input.h"

namespace {

namespace fs = std::filesystem;

constexpr const char* names[] = {"meta.json", "M.mtx", "C.mtx",  "D.mtx",  "k.mtx",    "c.mtx",   "d.mtx",
                                 "A.mtx",     "b.mtx", "mu.mtx", "key.mtx", "M.mtx.gz", "A.mtx.gz"};

/// Made anew for every input, in memory where there is such a place.
class Folder {
 public:
  Folder() : path_(fs::path(fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path()) / ("mlcp_fuzz_" + std::to_string(getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_ / "in");
  }
  ~Folder() { fs::remove_all(path_); }
  fs::path in() const { return path_ / "in"; }
  fs::path out() const { return path_ / "out"; }

  /// A line "= N" begins file N of the names.
  void fill(const std::string& text) const {
    std::size_t from = 0;
    for (std::size_t name = 0; from < text.size();) {
      const std::size_t mark = text.find("\n= ", from);
      const std::size_t end = mark == std::string::npos ? text.size() : mark + 1;
      std::ofstream(in() / names[name], std::ios::binary).write(text.data() + from, static_cast<std::streamsize>(end - from));
      if (mark == std::string::npos) return;
      from = std::min(text.size(), mark + 5);
      name = static_cast<unsigned char>(text[std::min(text.size() - 1, mark + 3)] - 'a') % std::size(names);
    }
  }

 private:
  fs::path path_;
};

void solve(const cli::ProblemFile& file) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.max_work = 1000000;
  settings.max_iterations = 200;
  settings.max_shifts = 20;
  const handles::Solver solver = handles::make_solver(&settings);
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  fuzz::require(mlcp_solve(solver.get(), file.problem.get(), nullptr, nullptr, &report) == MLCP_OK, "what was read can be solved");
  fuzz::require(report.outcome != MLCP_SOLVED || report.largest_error <= settings.tolerance, "solved is within the tolerance");
}

cli::Friction friction_of(int choice) {
  cli::Friction friction;
  if (choice % 5 > 0) friction.model = choice % 5 - 1;
  friction.facets = choice % 7 == 0 ? 4 : 0;
  return friction;
}

bool can_be_written(const fs::path& folder, const handles::Problem& problem) {
  try {
    cli::write_folder(folder, problem);
    return true;
  } catch (const std::runtime_error&) {  // what the form cannot hold
    return false;
  }
}

}  // namespace

/// The first byte is the friction asked for, the rest the files.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  Folder folder;
  folder.fill({reinterpret_cast<const char*>(data) + 1, size - 1});
  const cli::Friction friction = friction_of(data[0]);
  cli::ProblemFile file;
  try {
    file = cli::read_folder(folder.in(), friction);
  } catch (const std::runtime_error& error) {
    fuzz::require(std::strlen(error.what()) > 0, "a refusal says why");
    return 0;
  }
  solve(file);
  if (!can_be_written(folder.out(), file.problem)) return 0;
  const cli::ProblemFile again = cli::read_folder(folder.out(), friction);
  fuzz::require(mlcp_problem_row_count(again.problem.get()) == mlcp_problem_row_count(file.problem.get()), "no row is lost");
  fuzz::require(mlcp_problem_velocity_count(again.problem.get()) <= mlcp_problem_velocity_count(file.problem.get()),
                "no velocity appears");
  return 0;
}
