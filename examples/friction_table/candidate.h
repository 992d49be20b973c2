#pragma once
#include <span>
#include <string>
#include <vector>

#include "scenes/handles.h"

/// A law of friction, for every contact of a problem.
struct Law {
  const char* name;
  mlcp_friction model;
  std::int32_t facets;  // 0: the circular cone, by facets that refine themselves, where the model has facets
};

std::span<const Law> laws();
/// What all answers are compared with: Coulomb's law on the circular cone.
Law reference_law();

/// A law and a method with a solver of their own, and what they took for the problems of a list, one after the other.
class Candidate {
 public:
  /// warm: each problem starts, by the keys of its rows, where the one before it ended; else it is new to the solver.
  Candidate(const Law& asked, mlcp_method by, double max_seconds, bool warm);

  /// Solves the next problem of the list.
  void solve(const handles::Problem& problem);
  /// Velocities of the last answer, or slacks where there are none: what the answer to a problem has one of.
  const std::vector<double>& motion() const { return motion_; }
  bool solved_last() const { return solved_last_; }
  /// The last answer against that of the reference.
  void compare(const Candidate& reference);
  /// Back to the first problem, with a new solver.
  void begin_turn();

  Law law;
  mlcp_method method;
  std::vector<double> milliseconds, error, difference;  // a solve each; difference only where the reference is solved
  int solves = 0, solved = 0;
  std::int64_t shifts = 0;  // solves of the iteration for friction
  std::int32_t facets = 0;  // most that one contact needed

 private:
  mlcp_settings settings_;
  bool warm_, solved_last_ = false;
  handles::Solver solver_;
  std::vector<double> motion_;
};
