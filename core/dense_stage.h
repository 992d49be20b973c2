#pragma once
#include "factorize/dense_response.h"
#include "measure/errors.h"
#include "report/result.h"
#include "solve/dense_interior_point.h"
#include "solve/dense_newton.h"
#include "stage.h"

namespace mlcp {

/// The short way for problems whose islands are all small (robots, a few bodies): no order, no symbolic factor, everything dense. What it
/// cannot solve to rounding it leaves to Stage.
class DenseStage {
 public:
  explicit DenseStage(const Memory& m) : components(m), response_(m), normal_(m), interior_(m), alone_(m), left_out_(m), counts_(m), solved_(m), released_(m), parts_(m), tasks_(m) {}

  Components components;

  /// Whether settings and sizes are such that it may be tried; finds the components of the problem if the settings are.
  bool takes(const SolveInput& input);
  /// Whether the last takes() knew the pattern.
  bool knew() const { return knew_; }
  /// after true: result and errors hold an answer as good as rounding allows; only certificates, keys and outcomes are left to the caller.
  bool solve(const SolveInput& input, const Mask* start, Watch& watch, Crew& crew, Measure& measure, Result& result, Errors& errors, Counts& counts);
  std::int64_t entries() const { return response_.entries() + (crowded_ ? normal_.entries() : 0); }

 private:
  bool solve_island(const SolveInput& input, const Mask* start, Watch& watch, std::int32_t c, Result& result);
  bool solve_crowded(const SolveInput& input, const Mask* start, Watch& watch, std::int32_t c, Result& result);
  DenseNewton newton(const SolveInput& input, std::int32_t c, double zero);
  bool solve_alone(const Problem& problem, std::int32_t c, Result& result);
  bool is_alone(std::int32_t c) const;
  bool refine(const SolveInput& input, std::int32_t c, const Measure& measure, bool again, Result& result);
  void correct(const SolveInput& input, std::int32_t c, const Measure& measure, bool rows_alone, Result& result);
  bool take_in(const SolveInput& input, std::int32_t c, const Measure& measure, Result& result);
  bool release(const SolveInput& input, std::int32_t c, Result& result);
  static void take_answer(const DenseIsland& island, Result& result);
  void correct_crowded(std::int32_t c, const Measure& measure, bool rows_alone, Result& result);
  bool right_enough(std::int32_t c, const Settings& settings) const;
  void stop(const Problem& problem, std::int32_t c, const Measure& measure, Result& result);
  void mark_redundant(std::int32_t c, const Measure& measure, Result& result);

  double density(const Problem& problem, std::int32_t c) const;
  bool couples_rows(const Problem& problem, std::int32_t c) const;

  bool knew_ = false, looked_ = false, fits_ = false, prepared_ = false, crowded_ = false;
  DenseResponse response_;
  NormalEquations normal_;
  Array<std::uint8_t> interior_;  // by component: crowded, for interior points; the others are for active sets
  Array<std::uint8_t> alone_;     // by component: a body that no row touches
  Array<std::uint8_t> left_out_;  // by component: one of these, and so not in response_
  Array<Counts> counts_;        // by component
  Array<std::uint8_t> solved_;  // likewise, to begin with; then whether nothing was left to refine
  Array<std::uint8_t> released_;  // likewise: the last refinement has solved it again
  Array<Measure::Part> parts_;  // likewise
  Array<std::int32_t> tasks_;   // first component of each task, and the end
};

}  // namespace mlcp
