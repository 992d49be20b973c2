#include "solver.h"

#include <algorithm>
#include <memory>
#include <new>

#include "measure/errors.h"
#include "solve/basis.h"
#include "solve/redundancy.h"
#include "solve/simplex.h"

namespace mlcp {
namespace {

/// How bad an outcome is for the whole: the worst island speaks for the problem.
int severity(mlcp_outcome outcome) {
  switch (outcome) {
    case MLCP_SOLVED: return 0;
    case MLCP_ITERATION_LIMIT: return 1;
    case MLCP_WORK_LIMIT: return 2;
    case MLCP_TIME_LIMIT: return 3;
    case MLCP_INTERRUPTED: return 4;
    case MLCP_INFEASIBLE: return 5;
    case MLCP_UNBOUNDED: return 6;
    default: return 7;
  }
}

/// Stopped from outside: time spent afterwards is not wanted.
bool cut_short(mlcp_outcome outcome) {
  return outcome == MLCP_WORK_LIMIT || outcome == MLCP_TIME_LIMIT || outcome == MLCP_INTERRUPTED;
}

mlcp_row_state row_state(std::uint8_t state) {
  switch (state) {
    case ActiveSet::at_lower: return MLCP_ROW_AT_LOWER;
    case ActiveSet::at_upper: return MLCP_ROW_AT_UPPER;
    case ActiveSet::disabled: return MLCP_ROW_DISABLED;
    default: return MLCP_ROW_ACTIVE;
  }
}

void check_mask(const Mask* mask, const Problem& problem, const char* name) {
  if (mask && static_cast<std::int32_t>(mask->state.size()) != problem.m())
    throw Error(MLCP_ERROR_RANGE, "%s has %zu rows, the problem has %d", name, mask->state.size(), problem.m());
}

}  // namespace

struct Solver::State {
  Memory memory;
  Settings settings;
  Analysis analysis;
  Basis basis;
  Simplex simplex;
  Measure measure;
  Result result;
  Array<std::int32_t> imposed;
  Errors errors;
  std::int32_t indefinite = -1;  ///< the velocity whose pivot is not positive

  State(const Settings& s, const Memory& m)
      : memory(m), settings(s), analysis(m), basis(m), simplex(m, basis), measure(m), result(m), imposed(m) {}

  bool analyze(const Problem& problem, const Mask* enabled);
  void solve_islands(const Problem& problem, Limits& limits, Counts& counts);
  void solve_free_velocities(const Problem& problem);
  void keep_certificate(std::int32_t island);
  void collect(const Problem& problem);
  void judge(const Problem& problem, const Mask* enabled);
  void fill(const Problem& problem, mlcp_report& report, const Counts& counts) const;
};

Solver::Solver(const Settings& settings, const Memory& memory) {
  check_settings(settings);
  void* block = memory.reallocate(nullptr, 0, sizeof(State));
  state_ = new (block) State(settings, memory);
}

Solver::~Solver() {
  const Memory memory = state_->memory;
  state_->~State();
  memory.release(state_, sizeof(State));
}

const Memory& Solver::memory() const { return state_->memory; }
const Settings& Solver::settings() const { return state_->settings; }
const Result& Solver::result() const { return state_->result; }

void Solver::set_settings(const Settings& settings) {
  check_settings(settings);
  state_->settings = settings;
}

const Analysis& Solver::analysis() const { return state_->analysis; }
std::span<const std::int32_t> Solver::ordering() const { return state_->analysis.ordering.order.span(); }
void Solver::impose_ordering(std::span<const std::int32_t> ordering) { state_->imposed.assign(ordering); }

bool Solver::State::analyze(const Problem& problem, const Mask* enabled) {
  check_mask(enabled, problem, "enabled");
  if (imposed.empty() && analysis.covers(problem, enabled)) return false;
  analysis.run(problem, enabled, imposed.span());
  imposed.clear();
  return true;
}

void Solver::analyze(const Problem& problem, const Mask* enabled) { state_->analyze(problem, enabled); }

void Solver::State::keep_certificate(std::int32_t island) {
  result.certificates.push_back({island, static_cast<std::int32_t>(result.certificate_row.size()),
                                 static_cast<std::int32_t>(simplex.certificate_row.size())});
  for (const std::int32_t i : simplex.certificate_row) result.certificate_row.push_back(i);
  for (const double y : simplex.certificate_y) result.certificate_y.push_back(y);
}

void Solver::State::solve_islands(const Problem& problem, Limits& limits, Counts& counts) {
  const auto& islands = analysis.symbolic.islands;
  result.island_outcome.assign(islands.size(), MLCP_SOLVED);
  for (std::size_t s = 0; s < islands.size(); ++s) {
    const Island& island = islands[s];
    const auto index = static_cast<std::int32_t>(s);
    limits.enter_island(index, island.last_row - island.first_row);
    mlcp_outcome outcome = simplex.solve(island, index, limits, counts, settings.trace ? &result.trace : nullptr);
    if (outcome == MLCP_INFEASIBLE) {
      keep_certificate(index);
      limits.enter_island(index, island.last_row - island.first_row);
      simplex.settle(island, limits, counts);
    } else if (outcome == MLCP_NOT_POSITIVE_DEFINITE) {
      indefinite = analysis.pattern.node[basis.factor.failed_position()];
    } else if (!cut_short(outcome)) {
      mark_redundant(island, basis, problem.n(), result.redundant.data(), counts);
    }
    result.island_outcome[s] = outcome;
  }
}

/// v = k / M where nothing couples to anything.
void Solver::State::solve_free_velocities(const Problem& problem) {
  for (const std::int32_t j : analysis.ordering.free_velocity) {
    const double mass = problem.mass.values[problem.mass.pointers[j]];
    if (!(mass > 0)) indefinite = j;
    result.v[j] = mass > 0 ? problem.momentum[j] / mass : 0;
  }
}

/// From elimination order back to the caller's.
void Solver::State::collect(const Problem& problem) {
  const std::int32_t n = problem.n(), m = problem.m();
  const KktPattern& pattern = analysis.pattern;
  for (std::int32_t j = 0; j < n; ++j)
    if (problem.prescribed(j)) result.v[j] = problem.given_velocity[j];
  result.row_island.assign(m, -1);
  result.mask.state.assign(m, MLCP_ROW_DISABLED);
  result.mask.key.assign(problem.key.span());
  result.gamma.assign(m, 0.0);
  const auto& islands = analysis.symbolic.islands;
  for (std::size_t s = 0; s < islands.size(); ++s) {
    for (std::int32_t p = islands[s].first; p < islands[s].last; ++p) {
      const std::int32_t node = pattern.node[p];
      if (node < n) {
        result.v[node] = basis.set.x[p];
        continue;
      }
      const std::uint8_t state = basis.set.state[pattern.row_ordinal[p]];
      if (state == ActiveSet::disabled) continue;
      result.row_island[node - n] = static_cast<std::int32_t>(s);
      result.mask.state[node - n] = row_state(state);
      result.gamma[node - n] = basis.set.x[p] == 0 ? 0.0 : -basis.set.x[p];
    }
  }
}

/// Success is what the caller's own numbers say, island by island; an error within the tolerance is a solution whatever stopped the method.
void Solver::State::judge(const Problem& problem, const Mask* enabled) {
  errors = measure.run(problem, enabled, result.v.span(), result.gamma.span());
  result.w.assign(measure.w.span());
  const KktPattern& pattern = analysis.pattern;
  const auto& islands = analysis.symbolic.islands;
  for (std::size_t s = 0; s < islands.size(); ++s) {
    double worst = 0;
    for (std::int32_t p = islands[s].first; p < islands[s].last; ++p) {
      const std::int32_t node = pattern.node[p];
      const double e = node < problem.n() ? measure.velocity_error[node] : measure.error[node - problem.n()];
      worst = e <= worst ? worst : e;
    }
    mlcp_outcome& outcome = result.island_outcome[s];
    if (worst <= settings.tolerance)
      outcome = MLCP_SOLVED;
    else if (outcome == MLCP_SOLVED)
      outcome = MLCP_ITERATION_LIMIT;
  }
}

void Solver::State::fill(const Problem& problem, mlcp_report& report, const Counts& counts) const {
  report.outcome = indefinite >= 0 ? MLCP_NOT_POSITIVE_DEFINITE : MLCP_SOLVED;
  report.islands = static_cast<std::int32_t>(result.island_outcome.size());
  report.islands_failed = 0;
  for (const mlcp_outcome o : result.island_outcome) {
    report.islands_failed += o != MLCP_SOLVED;
    if (severity(o) > severity(report.outcome)) report.outcome = o;
  }
  if (report.outcome == MLCP_SOLVED && !(errors.largest() <= settings.tolerance)) report.outcome = MLCP_ITERATION_LIMIT;
  report.method = MLCP_METHOD_SIMPLEX;
  report.momentum_error = errors.momentum;
  report.constraint_error = errors.constraints;
  report.largest_error = errors.largest();
  report.momentum_residual = errors.momentum_residual;
  report.constraint_residual = errors.constraint_residual;
  report.worst_velocity = indefinite >= 0 ? indefinite : errors.worst_velocity;
  report.worst_row = errors.worst_row;
  report.worst_body = indefinite >= 0 ? problem.body_of[indefinite] : -1;
  report.enabled_rows = report.active_rows = report.redundant_rows = 0;
  for (std::size_t i = 0; i < result.mask.state.size(); ++i) {
    report.enabled_rows += result.mask.state[i] != MLCP_ROW_DISABLED;
    report.active_rows += result.mask.state[i] == MLCP_ROW_ACTIVE;
    report.redundant_rows += result.redundant[i];
  }
  report.pivots = counts.pivots;
  report.toggles = counts.toggles;
  report.factorizations = counts.factorizations;
  report.refinements = counts.refinements;
  report.work = counts.work;
  report.factor_entries = analysis.symbolic.entries();
  report.seconds_factorize = counts.seconds_factorize;
  report.refactorized_for_drift = counts.drifts;
}

void Solver::solve(const Problem& problem, const Mask* enabled, const Mask* start, mlcp_report& report) {
  State& s = *state_;
  check_mask(start, problem, "start");
  s.result.valid = false;
  Limits limits(s.settings);
  const bool analyzed = s.analyze(problem, enabled);
  const double after_analysis = limits.seconds();
  limits.set_islands(static_cast<std::int32_t>(s.analysis.symbolic.islands.size()));

  Counts counts;
  s.indefinite = -1;
  s.result.v.assign(problem.n(), 0.0);
  s.result.redundant.assign(problem.m(), 0);
  s.result.trace.clear();
  s.result.certificates.clear();
  s.result.certificate_row.clear();
  s.result.certificate_y.clear();
  s.basis.prepare(problem, s.analysis, s.settings);
  s.basis.set.start(problem, s.analysis.pattern, s.basis.values, enabled, start);
  s.simplex.prepare(problem, enabled, s.settings);
  s.solve_free_velocities(problem);
  s.solve_islands(problem, limits, counts);
  const double after_solve = limits.seconds();
  s.collect(problem);
  s.judge(problem, enabled);
  s.fill(problem, report, counts);
  report.analyzed = analyzed;
  report.seconds_analyze = analyzed ? after_analysis : 0;
  report.seconds_solve = after_solve - after_analysis - counts.seconds_factorize;
  report.seconds = limits.seconds();
  report.seconds_report = report.seconds - after_solve;
  s.result.valid = true;
}

/// The order is kept, so that the next solve gives the same bits as without.
void Solver::trim() {
  State& s = *state_;
  s.imposed.assign(ordering());
  std::destroy_at(&s.simplex);
  std::destroy_at(&s.basis);
  std::destroy_at(&s.analysis);
  std::destroy_at(&s.measure);
  std::construct_at(&s.measure, s.memory);
  std::construct_at(&s.analysis, s.memory);
  std::construct_at(&s.basis, s.memory);
  std::construct_at(&s.simplex, s.memory, s.basis);
}

}  // namespace mlcp
