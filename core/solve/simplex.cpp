#include "solve/simplex.h"

#include <cmath>

#include "memory/slice.h"

namespace mlcp {
namespace {

/// Rounds of "solve the final active set afresh, look again": more than a few only when rounding is what is left.
constexpr int most_rounds = 40;
/// A row that enters this often is one of a nearly dependent pair that replace each other: then both must be able to stay.
constexpr std::int32_t often = 4;
/// Directions of rows whose Schur pivot is below this, relative to a, are refined: their w and γ hang on its last digits.
constexpr double delicate = 1e-7;
/// What is left of a violation when the steps that mend it are as good as their directions.
constexpr double arrived = 1e-9;
/// Disagreement of the two ways to the Schur pivot, relative to a, that shows a drifted factor.
constexpr double drift = 1e-7;

}  // namespace

/// The paper's "un qualsiasi k": the row with the largest |w|/√a whose impulse can still move against it, least index on ties.
std::int32_t Simplex::entering_row(const Island& island) const {
  const ActiveSet& set = basis_.set;
  std::int32_t best = -1;
  double most = 0;
  const auto row = [&](std::int32_t o) { return basis_.pattern->node[basis_.position(o)]; };
  const double *slack = set.w.data(), *zero = set.tolerance.data();
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const double w = slack[o];
    if (std::abs(w) <= zero[o]) continue;
    const std::uint8_t state = set.state[o];
    if (state == ActiveSet::active || state == ActiveSet::disabled || state == (w > 0 ? ActiveSet::at_lower : ActiveSet::at_upper)) continue;
    const double size = basis_.values.a[o] > 0 ? std::abs(w) / basis_.values.root_a[o] : infinity;
    if (best < 0 || size > most || (size == most && row(o) < row(best))) {
      best = o;
      most = size;
    }
  }
  return best;
}

/// w of a unit of impulse on the entering row, z = K⁻¹ K(:,p) given: K(p,:) z − K_pp.
double Simplex::pivot_along(std::int32_t entering, const double* z) const {
  const KktPattern& pattern = *basis_.pattern;
  double sum = -basis_.values.diagonal[basis_.position(entering)];
  for (std::int32_t t = pattern.row_pointers[entering]; t < pattern.row_pointers[entering + 1]; ++t)
    sum += basis_.values.row[t] * z[pattern.row_columns[t]];
  return sum;
}

void Simplex::refine_direction(const Island& island, std::int32_t entering) {
  const KktPattern& pattern = *basis_.pattern;
  Workspace& work = basis_.work;
  std::fill(work.rhs.begin() + island.first, work.rhs.begin() + island.last, 0.0);
  std::fill(work.step.begin() + island.first, work.step.begin() + island.last, 0.0);
  for (std::int32_t t = pattern.row_pointers[entering]; t < pattern.row_pointers[entering + 1]; ++t)
    work.rhs[pattern.row_columns[t]] = basis_.values.row[t];
  for (std::int32_t q = island.first; q < island.last; ++q) work.rhs_size[q] = std::abs(work.rhs[q]);
  basis_.refinement.solve(island, pattern, basis_.values, basis_.factor, work.rhs.data(), work.rhs_size.data(), work.step.data(),
                          counts_.refinements, counts_.work);
}

/// Changes of x and w when the entering impulse moves by one unit: K dx = sign K(:,p) on what is in, dx_p = −sign.
void Simplex::find_direction(const Island& island, std::int32_t entering) {
  const std::int32_t p = basis_.position(entering);
  const double a = basis_.values.a[entering];
  double* dx = basis_.work.step.data();
  for (bool fresh = input_.settings.refactorize == MLCP_REFACTORIZE_ALWAYS;; fresh = true) {
    const double schur = -basis_.factor.solve_row(island, p, dx, counts_.work);
    direction_.schur = pivot_along(entering, dx);
    if (fresh || std::abs(schur - direction_.schur) <= drift * a) break;
    ++counts_.drifts;
    basis_.refactorize(island, lost_pivot, counts_);
  }
  if (std::abs(direction_.schur) <= delicate * a) {
    refine_direction(island, entering);
    direction_.schur = pivot_along(entering, dx);
  }
  direction_.schur = a > 0 ? direction_.schur / a : 0;
  direction_.dependent = !(direction_.schur > dependent_);
  dx[p] = -1;
  if (direction_.sign < 0) slice(dx, island.first, island.last) *= -1;
  // (3.3) for the change: dw = K(rows,:) dx on the rows that rest
  const KktPattern& pattern = *basis_.pattern;
  const std::uint8_t* state = basis_.set.state.data();
  const std::int32_t *start = pattern.row_pointers.data(), *columns = pattern.row_columns.data();
  const double* entries = basis_.values.row.data();
  double* dw = basis_.work.slope.data();
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    double sum = 0;
    if (state[o] != ActiveSet::active && !direction_.dependent)
      for (std::int32_t t = start[o]; t < start[o + 1]; ++t) sum += entries[t] * dx[columns[t]];
    dw[o] = sum;
  }
  if (!direction_.dependent) dw[entering] = direction_.sign * direction_.schur * a;
  counts_.work += pattern.row_pointers[island.last_row] - pattern.row_pointers[island.first_row];
}

void Simplex::reverse(const Island& island) {
  direction_.sign = -direction_.sign;
  slice(basis_.work.step.data(), island.first, island.last) *= -1;
}

void Simplex::advance(const Island& island, double length) {
  slice(basis_.set.x.data(), island.first, island.last) += length * slice(basis_.work.step.data(), island.first, island.last);
  slice(basis_.set.w.data(), island.first_row, island.last_row) += length * slice(basis_.work.slope.data(), island.first_row, island.last_row);
}

/// Rows whose impulse has left its bounds go to rest there. false: there is none.
bool Simplex::drop_beyond_bounds(const Island& island) {
  Flip* flips = basis_.work.flips.data() + island.first_row;
  std::size_t count = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if (basis_.set.state[o] == ActiveSet::active && (basis_.gamma(o) < basis_.values.lo[o] || basis_.gamma(o) > basis_.values.hi[o]))
      flips[count++] = {o, basis_.gamma(o) > basis_.values.hi[o] ? ActiveSet::at_upper : ActiveSet::at_lower};
  if (count == 0) return false;
  basis_.change(island, {flips, count}, lost_pivot, counts_);
  return true;
}

/// From any active mask to a point whose impulses are within their bounds: the active set only shrinks, so this ends.
mlcp_outcome Simplex::start(const Island& island) {
  if (!basis_.refactorize(island, lost_pivot, counts_)) return MLCP_NOT_POSITIVE_DEFINITE;
  do {
    if (const mlcp_outcome stop = limits_.check(counts_, 0); stop != MLCP_SOLVED) return stop;
    basis_.solve_point(island, counts_);
  } while (drop_beyond_bounds(island));
  return MLCP_SOLVED;
}

bool Simplex::depends(const Island& island, std::int32_t o) {
  return -basis_.factor.schur(island, basis_.position(o), counts_.work) <= dependent_ * basis_.values.a[o];
}

/// The point of the active set, smaller by the rows whose impulses it has beyond their bounds: it only shrinks, so this ends.
void Simplex::settle_point(const Island& island) {
  do basis_.solve_point(island, counts_);
  while (drop_beyond_bounds(island));
}

/// Ends a treatment in which the row did not arrive: its impulse goes back to where its state says.
mlcp_outcome Simplex::leave(const Island& island, std::int32_t entering, mlcp_outcome outcome) {
  const double moved = basis_.set.x[basis_.position(entering)];
  basis_.rest(entering, static_cast<ActiveSet::State>(basis_.set.state[entering]));
  if (outcome == MLCP_SOLVED && moved != basis_.set.x[basis_.position(entering)]) settle_point(island);
  return outcome;
}

void Simplex::record(Array<mlcp_pivot>& trace, std::int32_t entering, const Step& step) const {
  const auto row = [&](std::int32_t o) { return o < 0 ? -1 : basis_.pattern->node[basis_.position(o)] - input_.problem.n(); };
  const auto to = step.to == ActiveSet::active ? MLCP_ROW_ACTIVE : step.to == ActiveSet::at_upper ? MLCP_ROW_AT_UPPER : MLCP_ROW_AT_LOWER;
  trace.push_back({island_index_, row(entering), row(step.blocking), static_cast<mlcp_row_state>(to), direction_.dependent,
                   step.length * direction_.sign, basis_.set.w[entering], direction_.schur});
}

/// Nothing blocks a step along impulses alone: a proof that there is no solution, or else no dependence but a large mass ratio or a narrow
/// wedge. again: the row is to be tried once more, as an independent one. What the tolerance forgives needs no proof and stays violated.
mlcp_outcome Simplex::stand_still(const Island& island, std::int32_t entering, bool& again) {
  const double forgiven = basis_.set.tolerance[entering] * (input_.settings.tolerance / basis_.zero());
  if (certifying_ && std::abs(basis_.set.w[entering]) > forgiven && certify(island, entering)) return leave(island, entering, MLCP_INFEASIBLE);
  again = direction_.schur > lost_pivot;
  if (again) {
    dependent_ = std::max(lost_pivot, 0.5 * direction_.schur);
    return MLCP_SOLVED;
  }
  basis_.set.defer(entering);
  return leave(island, entering, MLCP_SOLVED);
}

/// The inner loop of the pseudocode: drives one violated row to w = 0 or to its far bound. By the printed rule rows come in on the way, so
/// that it may hold (w = 0) and depend on them: then its impulse goes back to rest and they take it over, or one of them leaves.
mlcp_outcome Simplex::treat(const Island& island, std::int32_t entering, Array<mlcp_pivot>* trace) {
  const double sign = basis_.set.w[entering] < 0 ? 1 : -1, violation = std::abs(basis_.set.w[entering]);
  while (true) {
    const bool holds = std::abs(basis_.set.w[entering]) <= std::max(basis_.set.tolerance[entering], arrived * violation);
    if (const mlcp_outcome stop = limits_.check(counts_, std::abs(basis_.set.w[entering])); stop != MLCP_SOLVED)
      return leave(island, entering, stop);
    direction_.sign = sign;
    find_direction(island, entering);
    if (holds && direction_.dependent) reverse(island);
    const mlcp_pivot_rule rule = input_.settings.pivot_rule;
    Step step = holds && !direction_.dependent ? Step{0, entering, ActiveSet::active} : ratio_test(island, basis_, direction_, entering, rule);
    while (step.to == ActiveSet::active && step.blocking >= 0 && step.blocking != entering && depends(island, step.blocking)) {
      basis_.work.slope[step.blocking] = 0;  // was rounding: its w cannot change without that of the active rows
      step = ratio_test(island, basis_, direction_, entering, rule);
    }
    ++counts_.pivots;
    if (trace) record(*trace, entering, step);
    if (step.blocking < 0) {
      bool again = false;
      const mlcp_outcome outcome = stand_still(island, entering, again);
      if (again) continue;
      return outcome;
    }
    if (step.length > 0) advance(island, step.length);
    if (step.to == ActiveSet::active)
      basis_.activate(island, step.blocking, counts_);
    else if (step.blocking == entering)
      basis_.rest(entering, step.to);  // exactly at the bound
    else
      basis_.deactivate(island, step.blocking, step.to, counts_);
    if (step.blocking != entering || step.to == ActiveSet::active) basis_.set.w[step.blocking] = 0;
    if (step.blocking == entering) return MLCP_SOLVED;
  }
}

/// dx over the rows −= that of K⁻¹ K (0, dx): with the velocities at 0, where they belong, Jᵀy and Σy are what is left to correct.
void Simplex::sharpen_certificate(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  Workspace& work = basis_.work;
  for (std::int32_t q = island.first; q < island.last; ++q) {
    if (!pattern.is_row(q)) work.step[q] = 0;
    work.residual[q] = basis_.values.diagonal[q] * static_cast<long double>(work.step[q]);
  }
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const long double x = work.step[basis_.position(o)];
    if (x == 0) continue;
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t)
      work.residual[pattern.row_columns[t]] += basis_.values.row[t] * x;
  }
  for (std::int32_t q = island.first; q < island.last; ++q) work.rhs[q] = static_cast<double>(work.residual[q]);
  basis_.factor.solve(island, work.rhs.data(), counts_.work);
  for (std::int32_t q = island.first; q < island.last; ++q)
    if (pattern.is_row(q) && basis_.factor.in(q)) work.step[q] -= work.rhs[q];
}

/// y = change of the impulses along the step on which nothing blocks, sharpened, since Jᵀy = 0 is asked to 1e-12. Entries that ought to
/// be 0 are rounding, and on a soft row Σy = 0 forgives none: more and more of the smallest are left out, until the rest is a proof.
bool Simplex::certify(const Island& island, std::int32_t entering) {
  const auto part = [&](auto& array) { return array.span().subspan(island.first_row, certificate_rows_); };
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (attempt > 0) sharpen_certificate(island);
    for (const double negligible : {1e-15, 1e-14, 1e-13, 1e-12, 1e-11}) {
      collect_certificate(island, entering, negligible);
      if (check_.holds(input_.problem, input_.enabled, part(basis_.work.certificate_row), part(basis_.work.certificate_y))) return true;
    }
  }
  return false;
}

void Simplex::collect_certificate(const Island& island, std::int32_t entering, double negligible) {
  const double per_unit = basis_.values.root_a[entering];
  certificate_rows_ = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (o != entering && basis_.set.state[o] != ActiveSet::active) continue;
    const double y = -basis_.work.step[basis_.position(o)];
    // the ratio test has shown that a sign against the bounds is rounding
    const bool against = y > 0 ? basis_.values.hi[o] < infinity : basis_.values.lo[o] > -infinity;
    if (o != entering && (against || std::abs(y) * basis_.values.root_a[o] <= negligible * per_unit)) continue;
    basis_.work.certificate_row[island.first_row + certificate_rows_] = basis_.pattern->node[basis_.position(o)] - input_.problem.n();
    basis_.work.certificate_y[island.first_row + certificate_rows_++] = y;
  }
}

mlcp_outcome Simplex::solve(const Island& island, std::int32_t index, Array<mlcp_pivot>* trace) {
  island_index_ = index;
  certifying_ = true;
  return run(island, trace);
}

void Simplex::settle(const Island& island) {
  basis_.values.soften(input_.problem, *basis_.pattern, island.first_row, island.last_row, least_violation_softness);
  std::fill(basis_.set.deferred.begin() + island.first_row, basis_.set.deferred.begin() + island.last_row, 0);
  certifying_ = false;
  run(island, nullptr);
  basis_.values.soften(input_.problem, *basis_.pattern, island.first_row, island.last_row, 0);
}

/// A nearly dependent pair of rows may replace each other for ever; then a row counts as dependent only at a smaller pivot.
void Simplex::tighten(const Island& island) {
  if (dependent_ <= lost_pivot) return;
  dependent_ *= 0.1;
  std::fill(basis_.set.deferred.begin() + island.first_row, basis_.set.deferred.begin() + island.last_row, 0);
  std::fill(basis_.work.entered.begin() + island.first_row, basis_.work.entered.begin() + island.last_row, 0);
  slack_tolerances(island, *basis_.pattern, basis_.values, basis_.zero(), basis_.set);
}

/// Risolvi_LCP.
mlcp_outcome Simplex::run(const Island& island, Array<mlcp_pivot>* trace) {
  dependent_ = dependent_pivot;
  std::fill(basis_.work.entered.begin() + island.first_row, basis_.work.entered.begin() + island.last_row, 0);
  mlcp_outcome outcome = start(island);
  if (outcome != MLCP_SOLVED) return outcome;
  for (int round = 0; round < most_rounds; ++round) {
    for (std::int32_t k = entering_row(island); k >= 0; k = entering_row(island)) {
      if (++basis_.work.entered[k] > often) tighten(island);
      outcome = treat(island, k, trace);
      if (outcome != MLCP_SOLVED) break;
    }
    // the answer comes from the linear system of the final active set, not from the sum of the steps
    settle_point(island);
    if (outcome != MLCP_SOLVED || entering_row(island) < 0) break;
  }
  return outcome;
}

}  // namespace mlcp
