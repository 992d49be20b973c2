#include "library_run.h"

#include "clock.h"

namespace bench {

using handles::check;

LibraryRun::LibraryRun(const mlcp_problem* problem, const mlcp_settings& settings) : arrays_(problem), settings_(settings) {
  mlcp_report_init(&report_, sizeof report_);
}

double LibraryRun::cold() {
  problem_.reset();
  solver_.reset();
  const double start = wall_seconds();
  problem_ = arrays_.build();
  solver_ = handles::make_solver(&settings_);
  solve();
  return wall_seconds() - start;
}

double LibraryRun::known() {
  if (!solver_) cold();
  const double start = wall_seconds();
  arrays_.refresh(problem_);
  solve();
  return wall_seconds() - start;
}

void LibraryRun::solve() { check(mlcp_solve(solver_.get(), problem_.get(), nullptr, nullptr, &report_), solver_); }

}  // namespace bench
