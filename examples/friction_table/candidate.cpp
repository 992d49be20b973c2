#include "candidate.h"

#include <algorithm>
#include <cmath>

namespace {

using handles::check;

constexpr Law all_laws[] = {{"none", MLCP_FRICTION_NONE, 0},
                            {"box", MLCP_FRICTION_FINDEX, 0},
                            {"convex, 4", MLCP_FRICTION_CONVEX, 4},
                            {"convex, 8", MLCP_FRICTION_CONVEX, 8},
                            {"convex, 16", MLCP_FRICTION_CONVEX, 16},
                            {"convex, 32", MLCP_FRICTION_CONVEX, 32},
                            {"convex, adaptive", MLCP_FRICTION_CONVEX, 0},
                            {"Coulomb, 4", MLCP_FRICTION_COULOMB, 4},
                            {"Coulomb, 8", MLCP_FRICTION_COULOMB, 8},
                            {"Coulomb, 16", MLCP_FRICTION_COULOMB, 16},
                            {"Coulomb, 32", MLCP_FRICTION_COULOMB, 32},
                            {"Coulomb, adaptive", MLCP_FRICTION_COULOMB, 0}};

constexpr double tolerance_of_sweeps = 1e-4;  // what projected Gauss-Seidel is for

}  // namespace

std::span<const Law> laws() { return all_laws; }

Law reference_law() { return all_laws[std::size(all_laws) - 1]; }

Candidate::Candidate(const Law& asked, mlcp_method by, double max_seconds, bool warm) : law(asked), method(by), warm_(warm) {
  mlcp_settings_init(&settings_, sizeof settings_);
  settings_.method = method;
  settings_.facets = law.facets;
  settings_.max_seconds = max_seconds;
  settings_.warm_start = warm;
  if (method == MLCP_METHOD_PGS) settings_.tolerance = tolerance_of_sweeps;
  begin_turn();
}

void Candidate::begin_turn() { solver_ = handles::make_solver(&settings_); }

void Candidate::solve(const handles::Problem& problem) {
  const handles::Problem own = handles::clone(problem);
  const auto contacts = static_cast<std::size_t>(mlcp_problem_contact_count(own.get()));
  const std::vector<mlcp_friction> model(contacts, law.model);
  const std::vector<std::int32_t> facets_of_each(contacts, law.facets);
  check(mlcp_problem_contacts_set_friction(own.get(), 0, static_cast<std::int32_t>(contacts), model.data(), nullptr, nullptr,
                                           facets_of_each.data()),
        own);
  if (!warm_) begin_turn();
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  check(mlcp_solve(solver_.get(), own.get(), nullptr, nullptr, &report), solver_);
  const double* values = nullptr;
  std::int32_t count = 0;
  check(mlcp_solver_velocities(solver_.get(), &values, &count));
  if (count == 0) check(mlcp_solver_slacks(solver_.get(), &values, &count));
  motion_.assign(values, values + count);
  solved_last_ = report.outcome == MLCP_SOLVED;
  ++solves;
  solved += solved_last_;
  shifts += std::max(1, report.shift_iterations);
  facets = std::max(facets, report.facets);
  milliseconds.push_back(1e3 * report.seconds);
  error.push_back(report.largest_error);
}

void Candidate::compare(const Candidate& reference) {
  if (!reference.solved_last_) return;
  double most = 0, size = 0;
  for (std::size_t j = 0; j < motion_.size(); ++j) {
    most = std::max(most, std::fabs(motion_[j] - reference.motion_[j]));
    size = std::max(size, std::fabs(reference.motion_[j]));
  }
  difference.push_back(size > 0 ? most / size : 0);
}
