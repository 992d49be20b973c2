#include "sequence.h"

#include "clock.h"
#include "oracle.h"

namespace bench {

using handles::check;

Sequence::Sequence(std::span<const mlcp_problem* const> steps, const mlcp_settings& settings) : settings_(settings) {
  for (const mlcp_problem* step : steps) steps_.emplace_back(step);
  Assembly::share_mass_pattern(steps_);
}

std::vector<Sequence::Step> Sequence::run(bool warm, bool oracle) const {
  handles::Problem problem;
  handles::Solver solver;
  const handles::Mask start = handles::make_mask();
  std::vector<Step> result;
  for (const Assembly& numbers : steps_) {
    const bool first = !warm || !solver;
    if (first) {
      problem.reset();
      solver.reset();
    }
    mlcp_report report;
    mlcp_report_init(&report, sizeof report);
    const double began = wall_seconds();
    if (first) {
      problem = numbers.build();
      solver = handles::make_solver(&settings_);
    } else {
      numbers.step(problem);
      const mlcp_mask* last = nullptr;
      check(mlcp_solver_mask(solver.get(), &last));
      check(mlcp_mask_carry(start.get(), problem.get(), last, MLCP_ROW_AT_LOWER), start);
    }
    check(mlcp_solve(solver.get(), problem.get(), nullptr, first ? nullptr : start.get(), &report), solver);
    Step step{wall_seconds() - began, report.largest_error, 0, report.outcome};
    if (oracle) {
      const mlcp_mask* last = nullptr;
      check(mlcp_solver_mask(solver.get(), &last));
      step.oracle = Oracle(problem.get(), last).median_seconds();
    }
    result.push_back(step);
  }
  return result;
}

}  // namespace bench
