#pragma once
#include <memory>
#include <span>

#include "analyze/analysis.h"
#include "assemble/mask.h"
#include "assemble/problem.h"
#include "report/result.h"
#include "solve/settings.h"

namespace mlcp {

/// The phases in order: assemble → analyze → factorize → solve → report. Owns what survives from one call to the next.
class Solver {
 public:
  Solver(const Settings& settings, const Memory& memory);
  ~Solver();
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  const Settings& settings() const;
  void set_settings(const Settings& settings);  ///< fails: Error, nothing changed
  void trim();

  void analyze(const Problem& problem, const Mask* enabled);
  /// report.struct_size is left alone, every other field is written.
  void solve(const Problem& problem, const Mask* enabled, const Mask* start, mlcp_report& report);
  /// The same after numbers of rows alone have changed since the last solve: r, bounds, entries of J and Σ in their pattern. M, k and what is
  /// enabled are what they were. Islands whose rows are all as they were keep their answer, the others their factor.
  void solve_again(const Problem& problem, const Mask* enabled, const Mask& start, mlcp_report& report);
  /// Of the solves from now on: see SolveInput.
  void measure_contacts(double contradiction, std::span<const std::int32_t> contact_of_row, bool follows_shifts);
  /// There are no results until the next solve.
  void forget_result();
  const Result& result() const;

  /// The last analysis; without nodes before the first one.
  const Analysis& analysis() const;
  /// Elimination order of the last analysis: velocity j is j, row i is n + i; empty before the first one.
  std::span<const std::int32_t> ordering() const;
  /// The next analysis uses this order, if it is one for its pattern: every velocity and row it needs, each once.
  void impose_ordering(std::span<const std::int32_t> ordering);

 private:
  struct State;
  State* state_;
};

}  // namespace mlcp
