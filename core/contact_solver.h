#pragma once
#include "solver.h"

namespace mlcp {

/// The solver as the caller sees it: contacts with friction around Solver. Where no contact asks for friction, Solver solves the caller's
/// problem itself and nothing of this costs anything.
class ContactSolver {
 public:
  ContactSolver(const Settings& settings, const Memory& memory);
  ~ContactSolver();
  ContactSolver(const ContactSolver&) = delete;
  ContactSolver& operator=(const ContactSolver&) = delete;

  const Settings& settings() const;
  void set_settings(const Settings& settings);  ///< fails: Error, nothing changed
  void trim();

  void analyze(const Problem& problem, const Mask* enabled);
  /// report.struct_size is left alone, every other field is written.
  void solve(const Problem& problem, const Mask* enabled, const Mask* start, mlcp_report& report);
  /// After a solve that ended with an error: there are no results, and none to start the next one from.
  void forget_result();
  const Result& result() const;
  /// Of the last solve, per contact: what it does; how many generators of its cone were tried.
  const Array<mlcp_contact_state>& contact_states() const;
  const Array<std::int32_t>& contact_facets() const;

  const Analysis& analysis() const;  ///< of the last solve; with friction, of the rows inside
  /// The start that the last solve found by keys, if it is one for this problem; else NULL.
  const Mask* found_start(const Problem& problem) const;
  std::span<const std::int32_t> ordering() const;
  void impose_ordering(std::span<const std::int32_t> ordering);

 private:
  struct State;
  State* state_;
};

}  // namespace mlcp
