#pragma once
#include "assembly.h"
#include "scenes/handles.h"

namespace bench {

/// The library as a user calls it, through mlcp.h. A run is one problem with one setting.
class LibraryRun {
 public:
  LibraryRun(const mlcp_problem* problem, const mlcp_settings& settings);

  /// Seconds for everything a first step takes: problem from arrays, solver, analysis, solve.
  double cold();
  /// Seconds for a later step whose pattern is known: all values written anew, solve from no active set.
  double known();

  const mlcp_report& report() const { return report_; }
  const mlcp_solver* solver() const { return solver_.get(); }
  const mlcp_problem* problem() const { return problem_.get(); }

 private:
  void solve();

  Assembly arrays_;
  mlcp_settings settings_;
  handles::Problem problem_;
  handles::Solver solver_;
  mlcp_report report_;
};

}  // namespace bench
