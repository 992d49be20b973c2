#pragma once
#include "analyze/analysis.h"
#include "crew.h"
#include "report/result.h"
#include "solve/island_solver.h"

namespace mlcp {

/// Analysis, factor and active set of a problem, from the pattern to the point of every island.
class Stage {
 public:
  explicit Stage(const Memory& m) : analysis(m), basis(m), ends(m), check_(m), tasks_(m), changed_(m), epsilon_(m) {}

  Analysis analysis;
  Basis basis;
  Array<IslandEnd> ends;  ///< by island

  /// Loads the problem's numbers and a start (NULL: rows that may push both ways are active). before: analysis covers the problem.
  void load(const SolveInput& input, const Mask* start);
  /// Every island by its method, crew permitting at the same time.
  void solve(const SolveInput& input, Watch& watch, Crew& crew, bool warm, Result& result);
  /// Islands with rows that are not what they were, after numbers of rows alone have changed since the last call: from `start` and from the
  /// factor that is left. The others keep their answer.
  void solve_again(const SolveInput& input, Watch& watch, Crew& crew, const Mask& start, Result& result);
  /// The point of the loaded active set, nothing else: factored afresh and refined.  false: some island has none.  throws: Stopped.
  bool settle(Watch& watch);

  /// Velocities, impulses and states, from elimination order to the caller's. only_rows: of islands with rows.
  void collect(const Problem& problem, bool only_rows, Result& result) const;
  void collect(const Problem& problem, const Island& island, Result& result) const;

 private:
  CertificateCheck check_;
  Array<std::int32_t> tasks_;    // of the crew
  Array<std::uint8_t> changed_;  // by island
  Array<double> epsilon_;
};

}  // namespace mlcp
