// mlcp_hard_table FOLDER: every hard case by every method, a line each in FOLDER/library.csv, and the case itself, without prescribed
// bodies, as a snapshot for others.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "hard/cases/sketch.h"
#include "hard/solution.h"

namespace {

constexpr mlcp_method methods[] = {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO, MLCP_METHOD_PGS};
constexpr int repeats = 3;
constexpr double tolerance = 1e-12;
constexpr std::int64_t most_sweeps = 2000;  // of pgs, which else goes on for hours on the chain of 10 000

hard::Solution solve(const mlcp_problem* problem, mlcp_method method) {
  return hard::solve(problem, method, tolerance, method == MLCP_METHOD_PGS ? most_sweeps : 0);
}

const char* word(hard::Fate fate) {
  switch (fate) {
    case hard::Fate::solved: return "solved";
    case hard::Fate::infeasible: return "infeasible";
    case hard::Fate::unbounded: return "unbounded";
    case hard::Fate::told: return "either";
  }
  return "";
}

void write(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream csv(folder / "library.csv");
  csv.precision(17);
  csv << "family,parameter,value,expected,velocities,rows,friction,method,outcome,reported,error,seconds,snapshot\n";
  int number = 0;
  for (const hard::Family& family : hard::families())
    for (const double value : family.values) {
      const hard::Case c = family.make(value);
      const mlcp_problem* problem = c.problem.get();
      const std::string snapshot = std::to_string(number++) + ".mlcp";
      const hard::Problem plain = hard::with_given_velocities_in_r(c.problem);
      handles::check(mlcp_snapshot_save((folder / snapshot).c_str(), plain.get(), nullptr, nullptr, nullptr, nullptr, 0));
      for (const mlcp_method method : methods) {
        hard::Solution s = solve(problem, method);
        double seconds = s.report.seconds;
        for (int again = 1; again < repeats; ++again) seconds = std::min(seconds, solve(problem, method).report.seconds);
        csv << '"' << family.name << "\"," << family.parameter << ',' << value << ',' << word(c.fate) << ','
            << mlcp_problem_velocity_count(problem) << ',' << mlcp_problem_row_count(problem) << ',' << mlcp_problem_contact_count(problem)
            << ',' << mlcp_method_text(method) << ',' << mlcp_outcome_text(s.report.outcome) << ',' << s.report.largest_error << ','
            << hard::largest_error(problem, s.v, s.gamma) << ',' << seconds << ',' << snapshot << '\n';
      }
    }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: mlcp_hard_table FOLDER\n";
    return 2;
  }
  try {
    write(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
