#include "solve_command.h"

#include <iostream>
#include <stdexcept>

#include "answer.h"
#include "problem_file.h"
#include "watch.h"

namespace cli {
namespace {

using handles::check;

struct Name {
  const char* text;
  std::int32_t value;
};

constexpr Name methods[] = {{"auto", MLCP_METHOD_AUTO}, {"simplex", MLCP_METHOD_SIMPLEX}, {"newton", MLCP_METHOD_NEWTON}, {"pgs", MLCP_METHOD_PGS}};
constexpr Name frictions[] = {{"none", MLCP_FRICTION_NONE}, {"convex", MLCP_FRICTION_CONVEX}, {"coulomb", MLCP_FRICTION_COULOMB},
                              {"box", MLCP_FRICTION_FINDEX}};
constexpr Name pivot_rules[] = {{"dual", MLCP_PIVOT_DUAL}, {"printed", MLCP_PIVOT_PRINTED}};
constexpr Name refactorize_names[] = {{"when-needed", MLCP_REFACTORIZE_WHEN_NEEDED}, {"always", MLCP_REFACTORIZE_ALWAYS}};

template <std::size_t count>
std::int32_t value_of(const char* option, const std::string& text, const Name (&names)[count]) {
  std::string available;
  for (const Name& name : names) {
    if (text == name.text) return name.value;
    available += (available.empty() ? "" : ", ") + std::string(name.text);
  }
  throw std::runtime_error(std::string(option) + " " + text + " is not available; this version has: " + available);
}

void apply(const SolveOptions& options, mlcp_settings& settings) {
  if (options.method) settings.method = value_of("--method", *options.method, methods);
  if (options.pivot_rule) settings.pivot_rule = value_of("--pivot-rule", *options.pivot_rule, pivot_rules);
  if (options.refactorize) settings.refactorize = value_of("--refactorize", *options.refactorize, refactorize_names);
  if (options.tolerance) settings.tolerance = *options.tolerance;
  if (options.max_seconds) settings.max_seconds = *options.max_seconds;
  if (options.trace) settings.trace = 1;
  if (options.facets) settings.facets = *options.facets;
}

Friction friction_of(const SolveOptions& options) {
  Friction friction;
  if (options.friction) friction.model = value_of("--friction", *options.friction, frictions);
  friction.facets = options.facets.value_or(0);
  return friction;
}

Exit exit_of(mlcp_outcome outcome) {
  switch (outcome) {
    case MLCP_SOLVED: return Exit::Solved;
    case MLCP_ITERATION_LIMIT:
    case MLCP_WORK_LIMIT:
    case MLCP_TIME_LIMIT:
    case MLCP_INTERRUPTED: return Exit::Limit;
    case MLCP_INFEASIBLE:
    case MLCP_UNBOUNDED:
    case MLCP_NOT_POSITIVE_DEFINITE: return Exit::NoSolution;
    default: return Exit::BadInput;
  }
}

}  // namespace

Exit run_solve(const SolveOptions& options) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  const Friction friction = friction_of(options);
  apply(options, settings);  // complains about the options before a large file is read
  const ProblemFile file = read_problem(options.problem, friction);
  check(mlcp_solver_get_settings(file.solver.get(), &settings));
  apply(options, settings);
  Watch watch(settings);
  check(mlcp_solver_set_settings(file.solver.get(), &settings), file.solver);
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  check(mlcp_solve(file.solver.get(), file.problem.get(), file.enabled.get(), file.start.get(), &report), file.solver);
  watch.done();
  const Answer answer(file, report);
  std::cout << (options.output == "json" ? answer.json() : answer.text(options.trace));
  return exit_of(report.outcome);
}

}  // namespace cli
