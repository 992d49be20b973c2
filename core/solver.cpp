#include "solver.h"

#include <algorithm>
#include <memory>
#include <new>
#include <thread>

#include "dense_stage.h"
#include "factorize/kernels.h"
#include "memory/lazy.h"
#include "measure/errors.h"
#include "solve/extended_simplex.h"
#include "stage.h"

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

void check_mask(const Mask* mask, const Problem& problem, const char* name) {
  if (mask && static_cast<std::int32_t>(mask->state.size()) != problem.m())
    throw Error(MLCP_ERROR_RANGE, "%s has %zu rows, the problem has %d", name, mask->state.size(), problem.m());
}

}  // namespace

struct Solver::State {
  Memory memory;
  Settings settings;
  DenseStage dense;  ///< tried first where every island is small
  Lazy<Stage> main;
  Lazy<Stage> exact;  ///< rows after velocities everywhere: for islands that newton gave up in another order, and for canonical answers
  Lazy<ExtendedSimplex> extended;  ///< for small islands that double precision cannot solve
  Pool pool;
  Measure measure;
  Result result;
  Array<std::int32_t> imposed;
  Mask given_up;       ///< rows of the islands that go to the exact stage
  Array<double> kept;  ///< v, while a canonical answer is tried
  Errors errors;
  std::int32_t indefinite = -1;  ///< the velocity whose pivot is not positive
  double contradiction = 0;
  bool follows_shifts = false;
  std::span<const std::int32_t> contact_of_row;
  bool large = false;            ///< `main` has solved the last problem, and its factors stand

  State(const Settings& s, const Memory& m)
      : memory(m), settings(s), dense(m), main(m), exact(m), extended(m), pool(m), measure(m), result(m), imposed(m), given_up(m), kept(m) {}

  bool analyze(const Problem& problem, const Mask* enabled, const Poll& poll = {});
  void clear_findings();
  void clear_result(const Problem& problem);
  void solve(const SolveInput& input, const Mask* start, bool again, mlcp_report& report);
  bool solve_small(const SolveInput& input, const Mask* start, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts);
  void solve_large(const SolveInput& input, const Mask* start, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts);
  void solve_large_again(const SolveInput& input, const Mask& start, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts);
  void take_answer(const SolveInput& input, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts);
  void find_row_islands(const SolveInput& input);
  void solve_free_velocities(const Problem& problem, const VelocityRuns& free);
  void read_ends(const Stage& stage, const Problem& problem, bool only_rows, mlcp_report& report, Counts& counts);
  void take_certificate(const Workspace& work, const Island& island, std::int32_t index, std::int32_t rows);
  void take_given_velocities(const Problem& problem);
  void collect(const SolveInput& input);
  void rescue(const SolveInput& input, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts);
  void extend(const SolveInput& input, Watch& watch, mlcp_report& report, Counts& counts);
  void make_canonical(const SolveInput& input, Watch& watch);
  void look_at_result(const SolveInput& input);
  void judge(const SolveInput& input);
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

const Settings& Solver::settings() const { return state_->settings; }
const Result& Solver::result() const { return state_->result; }
void Solver::forget_result() { state_->result.valid = false; }

void Solver::set_settings(const Settings& settings) {
  check_settings(settings);
  state_->settings = settings;
}

void Solver::measure_contacts(double contradiction, std::span<const std::int32_t> contact_of_row, bool follows_shifts) {
  state_->follows_shifts = follows_shifts;
  state_->contradiction = contradiction;
  state_->contact_of_row = contact_of_row;
}

const Analysis& Solver::analysis() const {
  static const Analysis none{Memory()};
  return state_->main.made() ? state_->main.made()->analysis : none;
}
std::span<const std::int32_t> Solver::ordering() const { return analysis().ordering.order.span(); }
void Solver::impose_ordering(std::span<const std::int32_t> ordering) { state_->imposed.assign(ordering); }

bool Solver::State::analyze(const Problem& problem, const Mask* enabled, const Poll& poll) {
  check_mask(enabled, problem, "enabled");
  const bool rows_last = settings.method == MLCP_METHOD_SIMPLEX;
  if (imposed.empty() && main->analysis.covers(problem, enabled, rows_last)) return false;
  if (imposed.empty() && settings.warm_start)
    main->analysis.run_again(problem, enabled, rows_last, poll);
  else
    main->analysis.run(problem, enabled, rows_last, imposed.span(), poll);
  imposed.clear();
  return true;
}

void Solver::analyze(const Problem& problem, const Mask* enabled) {
  state_->analyze(problem, enabled);
  state_->dense.takes({problem, enabled, state_->settings});  // finds the islands, which is all that a solve of small ones needs
}

/// v = k / M where nothing couples to anything.
void Solver::State::solve_free_velocities(const Problem& problem, const VelocityRuns& free) {
  const Kernels& kernels = kernels_for_this_cpu();
  for (const auto [first, last] : free.span()) {
    const double* const mass = problem.mass.values.data() + problem.mass.pointers[first];
    if (kernels.diagonal_solve(last - first, mass, problem.momentum.data() + first, result.v.data() + first)) continue;
    for (std::int32_t j = first; j < last; ++j)
      if (!(mass[j - first] > 0)) indefinite = j;
  }
}

/// Outcomes, certificates and counts of the islands that a stage has solved.
void Solver::State::read_ends(const Stage& stage, const Problem& problem, bool only_rows, mlcp_report& report, Counts& counts) {
  const KktPattern& pattern = stage.analysis.pattern;
  const auto& islands = stage.analysis.symbolic.islands;
  for (std::size_t s = 0; s < islands.size(); ++s) {
    const Island& island = islands[s];
    const IslandEnd& end = stage.ends[s];
    if (only_rows && island.first_row == island.last_row) continue;
    const auto index = only_rows ? result.row_island[pattern.node[pattern.row_position[island.first_row]] - problem.n()] : static_cast<std::int32_t>(s);
    result.island_outcome[index] = end.outcome;
    counts += end.counts;
    report.fallbacks += end.gave_up;
    if (island.first_row < island.last_row) report.method = report.method < 0 || report.method == end.method ? end.method : MLCP_METHOD_AUTO;
    if (end.indefinite >= 0) indefinite = pattern.node[end.indefinite];
    take_certificate(stage.basis.work, island, index, end.certificate_rows);
  }
}

/// The proof of `rows` rows that stands in the workspace; 0: none.
void Solver::State::take_certificate(const Workspace& work, const Island& island, std::int32_t index, std::int32_t rows) {
  if (rows == 0) return;
  result.certificates.push_back({index, static_cast<std::int32_t>(result.certificate_row.size()), rows});
  for (std::int32_t o = island.first_row; o < island.first_row + rows; ++o) {
    result.certificate_row.push_back(work.certificate_row[o]);
    result.certificate_y.push_back(work.certificate_y[o]);
  }
}

void Solver::State::take_given_velocities(const Problem& problem) {
  for (const Body& body : problem.bodies)
    if (body.prescribed) std::copy_n(problem.given_velocity.begin() + body.offset, body.dimension, result.v.begin() + body.offset);
}

/// From elimination order back to the caller's. Rows that a stopped analysis has left out rest.
void Solver::State::collect(const SolveInput& input) {
  const Problem& problem = input.problem;
  const std::int32_t m = problem.m();
  take_given_velocities(problem);
  result.mask.state.assign(m, MLCP_ROW_AT_LOWER);
  for (std::int32_t i = 0; i < m; ++i)
    if (input.enabled && input.enabled->state[i] == MLCP_ROW_DISABLED) result.mask.state[i] = MLCP_ROW_DISABLED;
  result.gamma.assign(m, 0.0);
  result.mask.impulse.clear();  // of the last solve, perhaps of another problem
  main->collect(problem, false, result);
}

/// Crowded islands that newton has given up: by the pivoting method, from where it got to.
void Solver::State::rescue(const SolveInput& input, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts) {
  const Problem& problem = input.problem;
  given_up.state.assign(problem.m(), MLCP_ROW_DISABLED);
  bool any = false;
  for (std::int32_t i = 0; i < problem.m(); ++i) {
    if (result.row_island[i] < 0 || !main->ends[result.row_island[i]].crowded) continue;
    given_up.state[i] = MLCP_ROW_ACTIVE;
    any = true;
  }
  if (!any) return;
  Settings pivoting = settings;
  pivoting.method = MLCP_METHOD_SIMPLEX;
  const SolveInput part{problem, &given_up, pivoting, input.contradiction, input.contact_of_row, input.follows_shifts};
  try {
    if (!exact->analysis.covers(problem, &given_up, true)) exact->analysis.run(problem, &given_up, true, {}, watch.poll());
  } catch (const Stopped&) {
    for (std::size_t s = 0; s < main->ends.size(); ++s)
      if (main->ends[s].crowded) result.island_outcome[s] = watch.stopped();
    return;
  }
  // where pivots from there lead to impulses that no double can balance, from rows at rest
  for (const Mask* start : {static_cast<const Mask*>(&result.mask), static_cast<const Mask*>(nullptr)}) {
    exact->load(part, start);
    exact->solve(part, watch, crew, false, result);
    read_ends(*exact, problem, true, report, counts);
    exact->collect(problem, true, result);
    if (settings.max_iterations > 0) return;
    judge(input);
    bool refused = false;
    for (std::size_t s = 0; s < main->ends.size(); ++s) refused |= main->ends[s].crowded && result.island_outcome[s] == MLCP_ITERATION_LIMIT;
    if (!refused) return;
  }
}

/// The answer from the active set alone: ordered, factored and solved as if nothing had been before. Kept if it is as good as what there is.
void Solver::State::make_canonical(const SolveInput& input, Watch& watch) {
  result.mask.impulse.clear();
  try {
    exact->analysis.run(input.problem, input.enabled, true, {}, watch.poll());
    exact->load(input, &result.mask);
    if (!exact->settle(watch)) return;
  } catch (const Stopped&) {
    return;
  }
  const double before = errors.largest();
  given_up.state.assign(result.mask.state.span());
  given_up.impulse.assign(result.gamma.span());
  kept.assign(result.v.span());
  exact->collect(input.problem, false, result);
  const Errors now = measure.run(input.problem, input.enabled, result.v.span(), result.gamma.span());
  if (now.largest() <= std::max(settings.tolerance, before)) return;
  result.v.assign(kept.span());
  result.gamma.assign(given_up.impulse.span());
  result.mask.state.assign(given_up.state.span());
}

/// Small islands that ended without an answer, though no limit of the caller's has stopped them: once more, in extended precision.
void Solver::State::extend(const SolveInput& input, Watch& watch, mlcp_report& report, Counts& counts) {
  const auto& islands = main->analysis.symbolic.islands;
  for (std::size_t s = 0; s < islands.size(); ++s) {
    IslandEnd& end = main->ends[s];
    const std::int32_t rows = islands[s].last_row - islands[s].first_row, index = static_cast<std::int32_t>(s);
    if (result.island_outcome[s] != MLCP_ITERATION_LIMIT || end.method == MLCP_METHOD_PGS || !ExtendedSimplex::takes(islands[s])) continue;
    if (settings.max_iterations > 0 && end.counts.pivots >= settings.max_iterations) continue;
    Counts spent;
    Limits limits(watch, index, static_cast<std::int32_t>(islands.size()), 4 * (rows + 10));
    end.kept = false;
    ++report.fallbacks;
    result.island_outcome[s] = extended->solve(input, islands[s], main->basis, limits, spent);
    counts += spent;
    if (result.island_outcome[s] != MLCP_SOLVED && result.island_outcome[s] != MLCP_INFEASIBLE) continue;
    main->collect(input.problem, islands[s], result);
    take_certificate(main->basis.work, islands[s], index, extended->certificate_rows());
    const bool answers = result.island_outcome[s] == MLCP_SOLVED;
    judge(input);
    for (const double roundings : {0x1p2, 0x1p8, 0x1p14, 0x1p20}) {
      if (!answers || result.island_outcome[s] == MLCP_SOLVED) break;
      extended->still(roundings);
      main->collect(input.problem, islands[s], result);
      judge(input);
    }
  }
}

void Solver::State::look_at_result(const SolveInput& input) {
  errors = measure.run(input.problem, input.enabled, result.v.span(), result.gamma.span(), input.contact_of_row);
  result.w.assign(measure.w.span());
}

/// Success is what the caller's own numbers say, island by island; an error within the tolerance is a solution whatever stopped the method.
void Solver::State::judge(const SolveInput& input) {
  const Problem& problem = input.problem;
  look_at_result(input);
  const KktPattern& pattern = main->analysis.pattern;
  const auto& islands = main->analysis.symbolic.islands;
  for (std::size_t s = 0; s < islands.size(); ++s) {
    double worst = 0;
    for (std::int32_t p = islands[s].first; p < islands[s].last; ++p) {
      const std::int32_t node = pattern.node[p];
      const double e = node < problem.n() ? measure.velocity_error(node) : measure.error[node - problem.n()];
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
  if (report.method < 0) report.method = settings.method == MLCP_METHOD_AUTO ? MLCP_METHOD_SIMPLEX : settings.method;
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
  report.seconds_factorize = counts.seconds_factorize;
  report.refactorized_for_drift = counts.drifts;
}

/// What a solve tells beside v, γ and redundancy.
void Solver::State::clear_findings() {
  indefinite = -1;
  result.trace.clear();
  result.certificates.clear();
  result.certificate_row.clear();
  result.certificate_y.clear();
}

void Solver::State::clear_result(const Problem& problem) {
  clear_findings();
  result.v.assign(problem.n(), 0.0);
  result.redundant.assign(problem.m(), 0);
}

/// Where every island is small.  false: it is not, or it could not be solved that way.
bool Solver::State::solve_small(const SolveInput& input, const Mask* start, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts) {
  if (!dense.takes(input)) return false;
  report.analyzed = !dense.knew();
  report.seconds_analyze = report.analyzed ? watch.seconds() : 0;
  const Problem& problem = input.problem;
  clear_findings();
  result.v.resize(problem.n());  // each of them is given, free or in an island
  result.redundant.assign(problem.m(), 0);
  take_given_velocities(problem);
  solve_free_velocities(problem, dense.components.free_velocities);
  if (indefinite >= 0 || !dense.solve(input, start, watch, crew, measure, result, errors, counts)) return false;
  result.w.assign(measure.w.span());
  result.island_outcome.assign(dense.components.count(), MLCP_SOLVED);
  result.row_island.assign(dense.components.of_row.span());
  report.method = MLCP_METHOD_NEWTON;
  report.factor_entries = dense.entries();
  return true;
}

void Solver::State::find_row_islands(const SolveInput& input) {
  const auto& islands = main->analysis.symbolic.islands;
  const KktPattern& pattern = main->analysis.pattern;
  result.row_island.assign(input.problem.m(), -1);
  for (std::size_t s = 0; s < islands.size(); ++s)
    for (std::int32_t o = islands[s].first_row; o < islands[s].last_row; ++o) {
      const std::int32_t row = pattern.node[pattern.row_position[o]] - input.problem.n();
      if (!input.enabled || input.enabled->state[row] != MLCP_ROW_DISABLED) result.row_island[row] = static_cast<std::int32_t>(s);
    }
}

void Solver::State::solve_large(const SolveInput& input, const Mask* start, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts) {
  const Problem& problem = input.problem;
  const double before = watch.seconds();
  report.analyzed = true;
  try {
    report.analyzed = analyze(problem, input.enabled, watch.poll());
  } catch (const Stopped&) {  // the analysis of nothing leads to the answer 0, which is judged like any other
  }
  report.seconds_analyze = report.analyzed ? watch.seconds() - before : 0;
  clear_result(problem);
  find_row_islands(input);
  main->load(input, start);
  main->solve(input, watch, crew, start != nullptr, result);
  take_answer(input, watch, crew, report, counts);
  large = true;
}

void Solver::State::solve_large_again(const SolveInput& input, const Mask& start, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts) {
  report.analyzed = false;
  report.seconds_analyze = 0;
  clear_findings();
  main->solve_again(input, watch, crew, start, result);
  take_answer(input, watch, crew, report, counts);
}

/// From the stage to the result, and its errors.
void Solver::State::take_answer(const SolveInput& input, Watch& watch, Crew& crew, mlcp_report& report, Counts& counts) {
  result.island_outcome.assign(main->analysis.symbolic.islands.size(), MLCP_SOLVED);
  read_ends(*main, input.problem, false, report, counts);
  solve_free_velocities(input.problem, main->analysis.ordering.free_velocities);
  collect(input);
  rescue(input, watch, crew, report, counts);
  judge(input);
  extend(input, watch, report, counts);
  report.factor_entries = main->analysis.symbolic.entries();
}

/// again: the numbers of rows alone have changed since the last call.
void Solver::State::solve(const SolveInput& input, const Mask* start, bool again, mlcp_report& report) {
  const Problem& problem = input.problem;
  result.valid = false;
  Watch watch(settings);
  Crew crew(watch, pool);
  Counts counts;
  report.fallbacks = 0;
  report.method = -1;
  bool small = false;
  if (again && large) {
    solve_large_again(input, *start, watch, crew, report, counts);
  } else {
    large = false;
    small = solve_small(input, start, watch, crew, report, counts);
    if (!small) solve_large(input, start, watch, crew, report, counts);
  }
  const double after_solve = watch.seconds();
  if (settings.canonical) {
    make_canonical(input, watch);
    small ? look_at_result(input) : judge(input);
  }
  result.mask.key.assign(problem.key.span());
  result.mask.impulse.assign(result.gamma.span());
  fill(problem, report, counts);
  if (report.outcome == MLCP_ITERATION_LIMIT && result.island_outcome.empty() && watch.stopped() != MLCP_SOLVED) report.outcome = watch.stopped();
  report.warm = start != nullptr;
  report.seconds_solve = after_solve - report.seconds_analyze - counts.seconds_factorize;
  report.seconds = watch.seconds();
  report.seconds_report = report.seconds - after_solve;
  result.valid = true;
}

void Solver::solve(const Problem& problem, const Mask* enabled, const Mask* start, mlcp_report& report) {
  State& s = *state_;
  check_mask(enabled, problem, "enabled");
  check_mask(start, problem, "start");
  s.pool.resize(s.settings.parallel_for ? 1 : s.settings.num_threads > 0 ? s.settings.num_threads : static_cast<std::int32_t>(std::max(1u, std::thread::hardware_concurrency())));
  s.solve({problem, enabled, s.settings, s.contradiction, s.contact_of_row, s.follows_shifts}, start, false, report);
}

void Solver::solve_again(const Problem& problem, const Mask* enabled, const Mask& start, mlcp_report& report) {
  state_->solve({problem, enabled, state_->settings, state_->contradiction, state_->contact_of_row, state_->follows_shifts}, &start, true, report);
}

/// The order is kept, so that the next solve of the same pattern gives the same bits as without.
void Solver::trim() {
  State& s = *state_;
  s.imposed.assign(ordering());
  s.dense = DenseStage(s.memory);
  s.main.reset();
  s.exact.reset();
  s.extended.reset();
  s.measure = Measure(s.memory);
  s.large = false;
}

}  // namespace mlcp
