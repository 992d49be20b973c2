#include "contact_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <new>

#include "conflicts.h"
#include "friction/slip.h"
#include "memory/lazy.h"
#include "solve/warm_start.h"
#include "measure/cones.h"

namespace mlcp {
namespace {

constexpr std::int32_t default_shifts = 300;
/// Islands that the iteration has not solved by then are put where Lemke's method has them.
constexpr std::int32_t shifts_before_lemke = 75;
/// Momentum errors above this are looked at again.
constexpr double settled = 1e-13;
constexpr int most_sweeps = 4;

/// Whether anything beyond plain rows is asked for.
bool has_friction(const Problem& problem, const Mask* enabled) {
  if (!problem.couplings.empty()) return true;
  return std::any_of(problem.contacts.begin(), problem.contacts.end(), [&](const Contact& c) { return has_cone(c, enabled); });
}

/// A cone contact without a cone (µ = 0, no model, or a row of it disabled) has no tangent rows either.
bool leaves_tangents_out(const Contact& contact, const Mask* enabled) {
  return contact.model <= MLCP_FRICTION_COULOMB && !has_cone(contact, enabled);
}

bool stopped_from_outside(mlcp_outcome outcome) {
  return outcome == MLCP_WORK_LIMIT || outcome == MLCP_TIME_LIMIT || outcome == MLCP_INTERRUPTED;
}

/// Adds what one solve did to what the earlier ones did; the numbers that are not sums are those of the last.
void accumulate(const mlcp_report& one, mlcp_report& total) {
  const mlcp_report before = total;
  total = one;
  total.pivots += before.pivots;
  total.toggles += before.toggles;
  total.factorizations += before.factorizations;
  total.refinements += before.refinements;
  total.work += before.work;
  total.seconds_analyze += before.seconds_analyze;
  total.seconds_factorize += before.seconds_factorize;
  total.seconds_solve += before.seconds_solve;
  total.seconds_report += before.seconds_report;
  total.analyzed |= before.analyzed;
  total.fallbacks += before.fallbacks;
  total.refactorized_for_drift += before.refactorized_for_drift;
}

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What only contacts with friction need.
struct Friction {
  Generators generators;
  ConeRows rows;
  Slip slip;
  Conflicts conflicts;
  ConeMeasure cones;
  explicit Friction(const Memory& m) : generators(m), rows(m), slip(m), conflicts(m), cones(m) {}
};

}  // namespace

struct ContactSolver::State {
  Memory memory;
  Settings settings;
  Solver solver;
  Lazy<Friction> friction;
  Measure measure;
  Mask enabled;              ///< the caller's, without the tangents of contacts that have no friction
  Result result;             ///< where friction was at work, else the solver's own
  const Result* last;
  WarmStart warm_start;
  Array<double> v, gamma;    ///< the point that is being judged
  Array<double> scratch;
  Array<mlcp_contact_state> contact_state;
  Array<std::int32_t> contact_facets;
  Errors errors;             ///< of `result`

  State(const Settings& s, const Memory& m)
      : memory(m), settings(s), solver(s, m), friction(m), measure(m), enabled(m), result(m),
        last(&solver.result()), warm_start(m), v(m), gamma(m), scratch(m), contact_state(m), contact_facets(m) {}

  const Mask* enable(const Problem& problem, const Mask* mask);
  void solve_without(const Problem& problem, const Mask* mask, const Mask* start, mlcp_report& report);
  void solve_with(const Problem& problem, const Mask* mask, const Mask* start, mlcp_report& report);
  void settle_velocities(const Problem& problem);
  mlcp_outcome spend(const mlcp_report& spent, double seconds);
  void keep(const Problem& problem, const Errors& found);
  void judge_islands(const Problem& problem);
  void take_rows(const Problem& problem);
  void classify(const Problem& problem, const Mask* mask, const Result& from, mlcp_report& report);
  void keep_slip(const Problem& problem);
  void fill(const Problem& problem, mlcp_report& report) const;
};

ContactSolver::ContactSolver(const Settings& settings, const Memory& memory) {
  check_settings(settings);
  void* block = memory.reallocate(nullptr, 0, sizeof(State));
  try {
    state_ = new (block) State(settings, memory);
  } catch (...) {
    memory.release(block, sizeof(State));
    throw;
  }
}

ContactSolver::~ContactSolver() {
  const Memory memory = state_->memory;
  state_->~State();
  memory.release(state_, sizeof(State));
}

const Settings& ContactSolver::settings() const { return state_->settings; }
void ContactSolver::forget_result() {
  state_->result.valid = false;
  state_->solver.forget_result();
}
const Result& ContactSolver::result() const { return *state_->last; }
const Array<mlcp_contact_state>& ContactSolver::contact_states() const { return state_->contact_state; }
const Array<std::int32_t>& ContactSolver::contact_facets() const { return state_->contact_facets; }
const Analysis& ContactSolver::analysis() const { return state_->solver.analysis(); }
const Mask* ContactSolver::found_start(const Problem& problem) const { return state_->warm_start.found(problem); }
std::span<const std::int32_t> ContactSolver::ordering() const { return state_->solver.ordering(); }
void ContactSolver::impose_ordering(std::span<const std::int32_t> ordering) { state_->solver.impose_ordering(ordering); }

void ContactSolver::set_settings(const Settings& settings) {
  state_->solver.set_settings(settings);
  state_->settings = settings;
}

/// NULL: all rows.
const Mask* ContactSolver::State::enable(const Problem& problem, const Mask* mask) {
  if (mask && static_cast<std::int32_t>(mask->state.size()) != problem.m())
    throw Error(MLCP_ERROR_RANGE, "enabled has %zu rows, the problem has %d", mask->state.size(), problem.m());
  const auto leaves = [&](const Contact& c) { return leaves_tangents_out(c, mask); };
  if (std::none_of(problem.contacts.begin(), problem.contacts.end(), leaves)) return mask;
  if (mask)
    enabled.state.assign(mask->state.span());
  else
    enabled.state.assign(problem.m(), MLCP_ROW_ACTIVE);
  for (const Contact& c : problem.contacts)
    if (leaves(c)) std::fill_n(enabled.state.data() + c.row + 1, c.dimension - 1, static_cast<mlcp_row_state>(MLCP_ROW_DISABLED));
  return &enabled;
}

void ContactSolver::analyze(const Problem& problem, const Mask* mask) {
  State& s = *state_;
  const Mask* on = s.enable(problem, mask);
  if (!has_friction(problem, on)) return s.solver.analyze(problem, on);
  Friction& f = *s.friction;
  f.generators.start(problem, on, s.settings.facets);
  f.rows.build(problem, on, f.generators);
  s.solver.analyze(f.rows.inner, &f.rows.enabled);
}

void ContactSolver::solve(const Problem& problem, const Mask* enabled, const Mask* start, mlcp_report& report) {
  State& s = *state_;
  const Mask* on = s.enable(problem, enabled);
  if (start && static_cast<std::int32_t>(start->state.size()) != problem.m())
    throw Error(MLCP_ERROR_RANGE, "start has %zu rows, the problem has %d", start->state.size(), problem.m());
  s.warm_start.forget();
  if (!start && s.settings.warm_start && s.last->valid) start = s.warm_start.find(problem, s.last->mask);
  if (has_friction(problem, on))
    s.solve_with(problem, on, start, report);
  else
    s.solve_without(problem, on, start, report);
}

void ContactSolver::State::solve_without(const Problem& problem, const Mask* mask, const Mask* start, mlcp_report& report) {
  solver.measure_contacts(0, {}, false);
  solver.solve(problem, mask, start, report);
  last = &solver.result();
  classify(problem, mask, *last, report);
  report.cone_error = report.cone_residual = 0;
  report.worst_contact = -1;
  report.generators = report.facets = report.shift_iterations = report.islands_by_lemke = 0;
}

void ContactSolver::State::solve_with(const Problem& problem, const Mask* mask, const Mask* start, mlcp_report& report) {
  const Clock::time_point begin = Clock::now();
  last = &result;
  result.valid = false;
  auto& [generators, rows, slip, conflicts, cones] = *friction;
  generators.start(problem, mask, settings.facets);
  rows.build(problem, mask, generators);
  slip.start(problem, start, generators, rows);
  conflicts.start(problem);
  mlcp_report total{}, one{};
  std::int32_t shifts = 0, by_lemke = 0;
  mlcp_outcome stopped = MLCP_SOLVED;
  double seconds_measure = 0;
  errors = Errors{};
  const std::int32_t most = settings.max_shifts > 0 ? settings.max_shifts : default_shifts;
  solver.set_settings(settings);
  const bool shifts_slip = std::ranges::any_of(generators.contact, [&](std::int32_t c) { return problem.contacts[c].model == MLCP_FRICTION_COULOMB; });
  solver.measure_contacts(0.1 * settings.tolerance, rows.cone_of_row.span(), shifts_slip);  // generators of contacts that stick depend on each other by nature
  while (true) {
    // the first solve always takes place, if only to be stopped: it leaves a point
    if (shifts > 0 && (stopped = spend(total, since(begin))) != MLCP_SOLVED) break;
    if (shifts == 0)
      solver.solve(rows.inner, &rows.enabled, &rows.start, one);
    else
      solver.solve_again(rows.inner, &rows.enabled, rows.start, one);
    accumulate(one, total);
    const Result& inner = solver.result();
    if (one.outcome == MLCP_INFEASIBLE && spend(total, since(begin)) == MLCP_SOLVED) {
      mlcp_report spent{};
      conflicts.look(problem, mask, generators, rows, inner, solver.settings(), spent);
      accumulate(total, spent);
      total = spent;
    }
    if (shifts++ == 0) slip.group(problem, generators, rows, inner.row_island.span());
    const double before = since(begin);
    gamma.resize(problem.m());
    rows.impulses(problem, generators, inner.gamma.span(), gamma.span());
    v.assign(inner.v.span());
    Errors found = measure.run(problem, mask, v.span(), gamma.span());
    for (int sweep = 0; sweep < most_sweeps && found.momentum > settled; ++sweep) {
      settle_velocities(problem);
      found = measure.run(problem, mask, v.span(), gamma.span());
    }
    cones.run(problem, mask, settings.facets, v.span(), gamma.span(), measure, found);
    if (shifts == 1 || found.largest() <= errors.largest()) keep(problem, found);
    seconds_measure += since(begin) - before;
    if (stopped_from_outside(one.outcome) || shifts >= most) break;
    const Slip::Found point{measure.w.span(),     gamma.span(),                  measure.scale.span(), cones.error.span(),
                            measure.error.span(), inner.mask.state.span(), inner.w.span(), conflicts.proven()};
    if (!slip.advance(problem, point, settings.tolerance, generators, rows)) break;
    if (shifts == shifts_before_lemke)
      by_lemke = slip.fall_back(problem, mask, result.row_island.span(), point, settings.tolerance, settings.facets, generators, rows);
  }
  solver.set_settings(settings);
  conflicts.write(result);
  classify(problem, mask, result, total);
  keep_slip(problem);
  result.mask.impulse.assign(result.gamma.span());
  total.shift_iterations = shifts;
  total.islands_by_lemke = by_lemke;
  total.seconds_report += seconds_measure;
  total.struct_size = report.struct_size;
  report = total;
  fill(problem, report);
  if (report.outcome == MLCP_ITERATION_LIMIT && stopped != MLCP_SOLVED) report.outcome = stopped;
  report.warm = start != nullptr;
  report.seconds = since(begin);
  result.valid = true;
}

/// Generators of a contact may cancel in an impulse that is then exactly 0, while the velocity that they push still carries their rounding:
/// all of it, relative to nothing. One step of Jacobi's method on such velocities.
void ContactSolver::State::settle_velocities(const Problem& problem) {
  for (std::int32_t j = 0; j < problem.n(); ++j) {
    if (!(measure.velocity_error(j) > settled)) continue;
    for (std::int32_t t = problem.mass.pointers[j]; t < problem.mass.pointers[j + 1]; ++t) {
      const double mass = problem.mass.values[t];
      if (problem.mass.indices[t] != j || !(mass > 0)) continue;
      v[j] -= measure.momentum_residual(j) / mass;
    }
  }
}

/// Leaves to the next solve what is left of time and work; the limit that has been reached when that is nothing.
mlcp_outcome ContactSolver::State::spend(const mlcp_report& spent, double seconds) {
  if (settings.max_seconds == 0 && settings.max_work == 0) return MLCP_SOLVED;
  Settings left = settings;
  if (settings.max_seconds > 0) left.max_seconds -= seconds;
  if (settings.max_work > 0) left.max_work -= spent.work;
  if (settings.max_seconds > 0 && !(left.max_seconds > 0)) return MLCP_TIME_LIMIT;
  if (settings.max_work > 0 && left.max_work <= 0) return MLCP_WORK_LIMIT;
  solver.set_settings(left);
  return MLCP_SOLVED;
}

/// The point just measured becomes the result.
void ContactSolver::State::keep(const Problem& problem, const Errors& found) {
  errors = found;
  const Result& inner = solver.result();
  result.v.assign(v.span());
  result.gamma.assign(gamma.span());
  result.w.assign(measure.w.span());
  take_rows(problem);
  result.island_outcome.assign(inner.island_outcome.span());
  judge_islands(problem);
  result.trace.assign(inner.trace.span());
  for (mlcp_pivot& pivot : result.trace) {
    for (std::int32_t* const row : {&pivot.entering, &pivot.blocking}) *row = *row < 0 ? -1 : friction->rows.row_of[*row];
  }
}

/// States of the caller's rows, islands and redundancy from those inside. A contact is redundant when it is closed and none of its
/// generators is in the basis.
void ContactSolver::State::take_rows(const Problem& problem) {
  const Generators& generators = friction->generators;
  const ConeRows& rows = friction->rows;
  const Result& inner = solver.result();
  const std::int32_t m = problem.m();
  result.mask.state.assign(m, MLCP_ROW_DISABLED);
  result.mask.key.assign(problem.key.span());
  result.redundant.assign(m, 0);
  result.row_island.assign(m, -1);
  for (std::size_t row = 0; row < rows.row_of.size(); ++row) {
    const std::int32_t i = rows.row_of[row];
    result.row_island[i] = inner.row_island[row];
    if (rows.cone_of_row[row] >= 0) continue;
    result.mask.state[i] = inner.mask.state[row];
    result.redundant[i] = inner.redundant[row];
  }
  for (std::int32_t c = 0; c < generators.cones(); ++c) {
    const Contact& contact = problem.contacts[generators.contact[c]];
    const std::int32_t first = rows.inner_of[contact.row], count = generators.first[c + 1] - generators.first[c];
    const mlcp_row_state* state = inner.mask.state.data() + first;
    if (state[0] == MLCP_ROW_DISABLED) continue;
    const bool closed = std::find(state, state + count, MLCP_ROW_ACTIVE) != state + count;
    result.redundant[contact.row] = !closed && std::find(&inner.redundant[first], &inner.redundant[first] + count, 0) == &inner.redundant[first] + count;
    result.mask.state[contact.row] = closed ? MLCP_ROW_ACTIVE : MLCP_ROW_AT_LOWER;
    for (std::int32_t t = 1; t < contact.dimension; ++t) {
      result.mask.state[contact.row + t] = MLCP_ROW_AT_LOWER;
      result.row_island[contact.row + t] = result.row_island[contact.row];
    }
  }
}

/// As Solver does, with the errors of cones: an error within the tolerance is a solution, whatever stopped a method on the rows inside. Infeasible
/// is what has been proven, not what has no solution at the present shifts.
void ContactSolver::State::judge_islands(const Problem& problem) {
  Array<mlcp_outcome>& outcome = result.island_outcome;
  scratch.assign(outcome.size(), 0.0);  // the worst of each island
  const auto note = [&](std::int32_t row, double e) {
    const std::int32_t island = result.row_island[row];
    if (island >= 0 && !(e <= scratch[island])) scratch[island] = e;
  };
  for (std::int32_t i = 0; i < problem.m(); ++i) note(i, measure.error[i]);
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) note(problem.contacts[c].row, friction->cones.error[c]);
  const bool solved = errors.largest() <= settings.tolerance;
  for (std::size_t s = 0; s < outcome.size(); ++s) {
    if (outcome[s] == MLCP_INFEASIBLE || (outcome[s] == MLCP_SOLVED && !(scratch[s] <= settings.tolerance))) outcome[s] = MLCP_ITERATION_LIMIT;
    if (outcome[s] == MLCP_ITERATION_LIMIT && solved) outcome[s] = MLCP_SOLVED;
  }
  for (std::int32_t i = 0; i < problem.m(); ++i)
    if (friction->conflicts.proven()[i] && !solved) outcome[result.row_island[i]] = MLCP_INFEASIBLE;
}

/// What each contact does. Without a cone, and closed: it slides when it has no friction or a tangent row is at its bound.
void ContactSolver::State::classify(const Problem& problem, const Mask* mask, const Result& from, mlcp_report& report) {
  contact_state.assign(problem.contacts.size(), MLCP_CONTACT_DISABLED);
  contact_facets.assign(problem.contacts.size(), 0);
  report.contacts_open = report.contacts_sticking = report.contacts_sliding = 0;
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    const Contact& contact = problem.contacts[c];
    if (mask && mask->state[contact.row] == MLCP_ROW_DISABLED) continue;
    const mlcp_row_state* tangents = from.mask.state.data() + contact.row + 1;
    const bool open = !(from.gamma[contact.row] > 0);
    const bool slides = has_cone(contact, mask)
                            ? length(contact_vector(contact, from.w.data()).t) > settings.tolerance * measure.scale[contact.row]
                            : std::any_of(tangents, tangents + contact.dimension - 1, [](mlcp_row_state t) { return t != MLCP_ROW_ACTIVE; });
    contact_state[c] = open ? MLCP_CONTACT_OPEN : slides ? MLCP_CONTACT_SLIDING : MLCP_CONTACT_STICKING;
    ++(open ? report.contacts_open : slides ? report.contacts_sliding : report.contacts_sticking);
  }
}

/// The states of tangent rows of cones and how their contacts slip, for the next start.
void ContactSolver::State::keep_slip(const Problem& problem) {
  const Generators& generators = friction->generators;
  result.mask.slip.assign(problem.m(), 0.0);
  for (const Coupling& coupling : problem.couplings) result.mask.slip[coupling.row] = result.gamma[coupling.normal];
  for (std::int32_t cone = 0; cone < generators.cones(); ++cone) {
    const std::int32_t c = generators.contact[cone];
    const Contact& contact = problem.contacts[c];
    const std::int32_t i = contact.row;
    const Tangent w = contact_vector(contact, result.w.data()).t;
    const bool open = contact_state[c] == MLCP_CONTACT_OPEN, slips = length(w) > settings.tolerance * measure.scale[i];
    result.mask.slip[i] = slips ? contact.mu * length(w) : 0;
    for (std::int32_t t = 1; t < contact.dimension; ++t) {
      const double g = result.gamma[i + t];
      result.mask.state[i + t] = open ? MLCP_ROW_AT_LOWER : !slips || g == 0 ? MLCP_ROW_ACTIVE : g > 0 ? MLCP_ROW_AT_UPPER : MLCP_ROW_AT_LOWER;
      result.mask.slip[i + t] = slips ? result.w[i + t] : open ? 0 : g / (contact.mu * result.gamma[i]);
    }
    contact_facets[c] = generators.tried[cone];
  }
  friction->slip.keep(problem, generators, result.mask.slip.span());
}

void ContactSolver::State::fill(const Problem& problem, mlcp_report& report) const {
  const Generators& generators = friction.made()->generators;
  report.momentum_error = errors.momentum;
  report.constraint_error = errors.constraints;
  report.largest_error = errors.largest();
  report.momentum_residual = errors.momentum_residual;
  report.constraint_residual = errors.constraint_residual;
  report.worst_row = errors.worst_row;
  report.cone_error = errors.cones;
  report.cone_residual = errors.cone_residual;
  report.worst_contact = errors.worst_contact;
  if (report.outcome != MLCP_NOT_POSITIVE_DEFINITE) report.worst_velocity = errors.worst_velocity;
  const bool solved = errors.largest() <= settings.tolerance;
  if (report.outcome == MLCP_INFEASIBLE || (report.outcome == MLCP_SOLVED && !solved)) report.outcome = MLCP_ITERATION_LIMIT;
  if (report.outcome == MLCP_ITERATION_LIMIT && friction.made()->conflicts.any() && !solved) report.outcome = MLCP_INFEASIBLE;
  if (report.outcome == MLCP_ITERATION_LIMIT && solved) report.outcome = MLCP_SOLVED;
  report.enabled_rows = report.active_rows = report.redundant_rows = report.islands_failed = 0;
  for (std::int32_t i = 0; i < problem.m(); ++i) {
    report.enabled_rows += result.mask.state[i] != MLCP_ROW_DISABLED;
    report.active_rows += result.mask.state[i] == MLCP_ROW_ACTIVE;
    report.redundant_rows += result.redundant[i];
  }
  for (const mlcp_outcome o : result.island_outcome) report.islands_failed += o != MLCP_SOLVED;
  report.generators = static_cast<std::int32_t>(generators.direction.size());
  report.facets = 0;
  for (const std::int32_t tried : generators.tried) report.facets = std::max(report.facets, tried);
}

/// Results stay.
void ContactSolver::trim() {
  State& s = *state_;
  s.solver.trim();
  s.friction.reset();
  // the new one is there before the old one goes: there may be no memory for it
  const auto renew = [&](auto& part) { part = std::remove_reference_t<decltype(part)>(s.memory); };
  renew(s.measure);
  renew(s.enabled);
  for (Array<double>* a : {&s.v, &s.gamma, &s.scratch}) {
    a->clear();
    a->trim();
  }
}

}  // namespace mlcp
