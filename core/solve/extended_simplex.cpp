#include "solve/extended_simplex.h"

#include <cmath>

namespace mlcp {
namespace {

constexpr std::int32_t most_velocities = 96, most_rows = 96;
/// Pivots up to this, relative to their terms, are rounding; so are shares of an impulse.
constexpr double dependent = 0x1p14 * extended_epsilon, no_share = 0x1p30 * extended_epsilon;
constexpr int refinements = 2;
/// What a proof may leave of Jᵀy, relative to the terms of yᵀA y, both as energies: the product of two angles that doubles can tell from 0 is more.
constexpr double proven = 0x1p24 * extended_epsilon;

}  // namespace

bool ExtendedSimplex::takes(const Island& island) {
  const std::int32_t rows = island.last_row - island.first_row;
  return rows <= most_rows && island.last - island.first - rows <= most_velocities;
}

/// Σ yᵢ² aᵢ, y being what row k and the active rows do together: the terms of its Schur pivot yᵀA y.
Extended ExtendedSimplex::terms(std::int32_t k) const {
  Extended sum = a_[k - island_.first_row];
  for (std::int32_t j = island_.first_row; j < island_.last_row; ++j)
    if (tableau_.in(position(j))) sum += share(j, k) * share(j, k) * a_[j - island_.first_row];
  return sum;
}

/// Active row j has more than rounding in those terms.
bool ExtendedSimplex::moves(std::int32_t j, std::int32_t k, Extended terms) const {
  return tableau_.in(position(j)) && share(j, k) * share(j, k) * a_[j - island_.first_row] > no_share * no_share * terms;
}

void ExtendedSimplex::rest(std::int32_t o, ActiveSet::State to) {
  basis_->set.state[o] = to;
  x_[position(o)] = ActiveSet::resting_x(to, basis_->values.lo[o], basis_->values.hi[o]);
}

/// Row o goes from rest to active or back.
void ExtendedSimplex::sweep(std::int32_t o, ActiveSet::State to, Counts& counts) {
  counts.work += tableau_.sweep(position(o));
  if (to == ActiveSet::active)
    basis_->set.state[o] = to;
  else
    rest(o, to);
}

/// The point of the active set, and w.
void ExtendedSimplex::find_point(Counts& counts) {
  const std::int32_t size = tableau_.size();
  const double* b = basis_->values.b.data() + island_.first;
  for (std::int32_t p = 0; p < size; ++p) rhs_[p] = tableau_.in(p) ? Extended{b[p]} : x_[p];
  tableau_.multiply(rhs_.data(), image_.data());
  counts.work += static_cast<std::int64_t>(size) * size;
  for (std::int32_t p = 0; p < size; ++p) {
    if (tableau_.in(p))
      x_[p] = -image_[p];
    else
      image_[p] -= b[p];
  }
}

/// Rows whose impulse has left its bounds go to rest there. false: there is none.
bool ExtendedSimplex::drop_beyond_bounds(Counts& counts) {
  bool any = false;
  for (std::int32_t o = island_.first_row; o < island_.last_row; ++o) {
    if (basis_->set.state[o] != ActiveSet::active) continue;
    const bool below = gamma(o) < basis_->values.lo[o];
    if (!below && !(gamma(o) > basis_->values.hi[o])) continue;
    sweep(o, below ? ActiveSet::at_lower : ActiveSet::at_upper, counts);
    any = true;
  }
  return any;
}

/// From any active set to one whose rows are independent and whose impulses are within their bounds: it only shrinks, so this ends.
mlcp_outcome ExtendedSimplex::start(Limits& limits, Counts& counts) {
  const KktPattern& pattern = *basis_->pattern;
  tableau_.load(island_, pattern, basis_->values);
  const std::int32_t size = tableau_.size();
  x_.assign(size, 0);
  step_.resize(size);
  rhs_.resize(size);
  image_.resize(size);
  a_.resize(island_.last_row - island_.first_row);
  for (std::int32_t p = 0; p < size; ++p) {
    if (pattern.is_row(island_.first + p)) continue;
    if (!(tableau_(p, p) > dependent * basis_->values.diagonal[island_.first + p])) return MLCP_ITERATION_LIMIT;
    if (const mlcp_outcome stop = limits.check(counts, 0); stop != MLCP_SOLVED) return stop;
    counts.work += tableau_.sweep(p);
  }
  for (std::int32_t o = island_.first_row; o < island_.last_row; ++o) a_[o - island_.first_row] = pivot(o);
  for (std::int32_t o = island_.first_row; o < island_.last_row; ++o) {
    const double lo = basis_->values.lo[o], hi = basis_->values.hi[o];
    const auto state = static_cast<ActiveSet::State>(basis_->set.state[o]);
    basis_->set.deferred[o] = 0;
    if (const mlcp_outcome stop = limits.check(counts, 0); stop != MLCP_SOLVED) return stop;
    if (state != ActiveSet::active)
      rest(o, state);
    else if (pivot(o) > dependent * terms(o))
      sweep(o, ActiveSet::active, counts);
    else
      rest(o, ActiveSet::resting(lo, hi));
  }
  do {
    if (const mlcp_outcome stop = limits.check(counts, 0); stop != MLCP_SOLVED) return stop;
    find_point(counts);
  } while (drop_beyond_bounds(counts));
  return MLCP_SOLVED;
}

/// The answer in double.
void ExtendedSimplex::round() {
  for (std::int32_t p = 0; p < tableau_.size(); ++p) basis_->set.x[island_.first + p] = static_cast<double>(x_[p]);
  for (std::int32_t o = island_.first_row; o < island_.last_row; ++o)
    basis_->set.w[o] = tableau_.in(position(o)) ? 0 : static_cast<double>(image_[position(o)]);
}

/// The violated row that would move its bodies most.  −1: there is none.
std::int32_t ExtendedSimplex::entering_row() {
  round();
  slack_tolerances(island_, *basis_->pattern, basis_->values, basis_->zero(), basis_->set);
  std::int32_t chosen = -1;
  Extended most = 0;
  for (std::int32_t o = island_.first_row; o < island_.last_row; ++o) {
    if (!basis_->set.violated(o)) continue;
    const Extended w = image_[position(o)], a = a_[o - island_.first_row], energy = a > 0 ? w * w / a : w * w;
    if (chosen >= 0 && energy <= most) continue;
    chosen = o;
    most = energy;
  }
  return chosen;
}

/// Change of x when the impulse of row k moves by `sign`, refined against K.  true: no velocity moves, which the pivot, a square, cannot tell.
/// terms: of that pivot; rows that push soft rows alone move nothing, and what J makes of their rounding is no measure.
bool ExtendedSimplex::find_still_step(std::int32_t k, int sign, Extended terms, Counts& counts) {
  const KktPattern& pattern = *basis_->pattern;
  const KktValues& values = basis_->values;
  const std::int32_t size = tableau_.size(), first = island_.first;
  for (std::int32_t p = 0; p < size; ++p) step_[p] = tableau_.in(p) ? sign * tableau_(p, position(k)) : Extended{0};
  step_[position(k)] = -sign;
  refine(nullptr, step_.data(), counts);
  // M dv = Jᵀy, in terms of energy
  for (std::int32_t p = 0; p < size; ++p) rhs_[p] = 0;
  for (std::int32_t p = 0; p < size; ++p) {
    if (pattern.is_row(first + p)) continue;
    rhs_[p] += values.diagonal[first + p] * step_[p];
    for (std::int32_t t = pattern.lower_pointers[first + p]; t < pattern.lower_pointers[first + p + 1]; ++t) {
      const std::int32_t q = pattern.lower_rows[t] - first;
      if (pattern.is_row(first + q)) continue;
      rhs_[p] += values.lower[t] * step_[q];
      rhs_[q] += values.lower[t] * step_[p];
    }
  }
  Extended moved = 0;
  for (std::int32_t p = 0; p < size; ++p) {
    if (pattern.is_row(first + p)) continue;
    moved = std::max(moved, rhs_[p] * rhs_[p] / values.diagonal[first + p]);
  }
  return moved <= proven * proven * terms;
}

/// y = change of the impulses when that of row k moves: nothing blocks it and no velocity feels it.
bool ExtendedSimplex::certify(const SolveInput& input, std::int32_t k, int sign, Extended terms, Counts& counts) {
  if (!find_still_step(k, sign, terms, counts)) return false;
  certificate_rows_ = 0;
  for (std::int32_t o = island_.first_row; o < island_.last_row; ++o) {
    if (o != k && !moves(o, k, terms)) continue;
    const std::int32_t at = island_.first_row + certificate_rows_++;
    basis_->work.certificate_row[at] = basis_->pattern->node[basis_->position(o)] - input.problem.n();
    basis_->work.certificate_y[at] = -static_cast<double>(step_[position(o)]);
  }
  const auto part = [&](auto& array) { return array.span().subspan(island_.first_row, certificate_rows_); };
  check_.prepare(input.problem);
  if (check_.holds(input.problem, input.enabled, part(basis_->work.certificate_row), part(basis_->work.certificate_y))) return true;
  certificate_rows_ = 0;
  return false;
}

/// Drives row k to w = 0 or to its far bound. Impulses that reach their bounds on the way leave the active set.
mlcp_outcome ExtendedSimplex::treat(const SolveInput& input, std::int32_t k, Limits& limits, Counts& counts) {
  const KktValues& values = basis_->values;
  const int sign = image_[position(k)] < 0 ? 1 : -1;
  const double forgiven = basis_->set.tolerance[k] * (input.settings.tolerance / basis_->zero());
  while (true) {
    const Extended w = image_[position(k)], sum = terms(k);
    if (const mlcp_outcome stop = limits.check(counts, static_cast<double>(magnitude(w))); stop != MLCP_SOLVED) return stop;
    ++counts.pivots;
    const bool arrives = pivot(k) > dependent * sum;
    Extended length = arrives ? -sign * w / pivot(k) : Extended{infinity};
    std::int32_t blocking = -1;
    // γ of row o moves by `rate` per unit of the step
    const auto block = [&](std::int32_t o, Extended rate) {
      const double bound = rate > 0 ? values.hi[o] : values.lo[o];
      if (std::isinf(bound)) return;
      const Extended room = std::max((bound - gamma(o)) / rate, Extended{0});
      if (!(room < length)) return;
      length = room;
      blocking = o;
    };
    block(k, sign);
    for (std::int32_t j = island_.first_row; j < island_.last_row; ++j)
      if (moves(j, k, sum)) block(j, sign * share(j, k));
    if (blocking < 0 && !arrives) {
      rest(k, static_cast<ActiveSet::State>(basis_->set.state[k]));
      if (magnitude(w) > forgiven) return certify(input, k, sign, sum, counts) ? MLCP_INFEASIBLE : MLCP_ITERATION_LIMIT;
      basis_->set.defer(k);  // what the tolerance forgives stays violated
      find_point(counts);
      return MLCP_SOLVED;
    }
    x_[position(k)] -= sign * length;
    if (blocking < 0)
      sweep(k, ActiveSet::active, counts);
    else if (blocking == k)
      rest(k, sign > 0 ? ActiveSet::at_upper : ActiveSet::at_lower);
    else
      sweep(blocking, sign * share(blocking, k) > 0 ? ActiveSet::at_upper : ActiveSet::at_lower, counts);
    find_point(counts);
    if (blocking < 0 || blocking == k) return MLCP_SOLVED;
  }
}

/// K x = b (NULL: 0) on what is in, with the rest of x as it is; against K itself, since Schur complements have squared the angles.
void ExtendedSimplex::refine(const double* b, Extended* x, Counts& counts) {
  const KktPattern& pattern = *basis_->pattern;
  const KktValues& values = basis_->values;
  const std::int32_t size = tableau_.size(), first = island_.first;
  for (int step = 0; step < refinements; ++step) {
    for (std::int32_t p = 0; p < size; ++p) rhs_[p] = (b ? b[first + p] : 0) - values.diagonal[first + p] * x[p];
    for (std::int32_t p = 0; p < size; ++p)
      for (std::int32_t t = pattern.lower_pointers[first + p]; t < pattern.lower_pointers[first + p + 1]; ++t) {
        const std::int32_t q = pattern.lower_rows[t] - first;
        rhs_[p] -= values.lower[t] * x[q];
        rhs_[q] -= values.lower[t] * x[p];
      }
    for (std::int32_t p = 0; p < size; ++p)
      if (!tableau_.in(p)) rhs_[p] = 0;
    tableau_.multiply(rhs_.data(), image_.data());
    for (std::int32_t p = 0; p < size; ++p)
      if (tableau_.in(p)) x[p] -= image_[p];
    counts.work += static_cast<std::int64_t>(size) * size;
    ++counts.refinements;
  }
}

void ExtendedSimplex::still(double roundings) {
  const double rounding = roundings * extended_epsilon;
  const KktPattern& pattern = *basis_->pattern;
  const KktValues& values = basis_->values;
  const std::int32_t size = tableau_.size(), first = island_.first;
  const auto energy = [&](std::int32_t p) {
    const std::int32_t o = pattern.row_ordinal[first + p];
    return x_[p] * x_[p] * (o >= 0 ? a_[o - island_.first_row] : Extended{values.diagonal[first + p]});
  };
  Extended largest = 0;
  for (std::int32_t p = 0; p < size; ++p) {
    largest = std::max(largest, energy(p));
    if (values.diagonal[first + p] > 0) largest = std::max(largest, Extended{values.b[first + p]} * values.b[first + p] / values.diagonal[first + p]);
  }
  for (std::int32_t p = 0; p < size; ++p)
    if (tableau_.in(p) && energy(p) <= rounding * rounding * largest) x_[p] = 0;
  round_within_bounds();
}

mlcp_outcome ExtendedSimplex::run(const SolveInput& input, Limits& limits, Counts& counts) {
  if (const mlcp_outcome outcome = start(limits, counts); outcome != MLCP_SOLVED) return outcome;
  for (std::int32_t k = entering_row(); k >= 0; k = entering_row())
    if (const mlcp_outcome outcome = treat(input, k, limits, counts); outcome != MLCP_SOLVED) return outcome;
  refine(basis_->values.b.data(), x_.data(), counts);
  round_within_bounds();
  return MLCP_SOLVED;
}

void ExtendedSimplex::round_within_bounds() {
  round();
  for (std::int32_t o = island_.first_row; o < island_.last_row; ++o) {
    double& x = basis_->set.x[basis_->position(o)];
    if (basis_->set.state[o] == ActiveSet::active) x = std::clamp(x, -basis_->values.hi[o], -basis_->values.lo[o]);
  }
}

mlcp_outcome ExtendedSimplex::solve(const SolveInput& input, const Island& island, Basis& basis, Limits& limits, Counts& counts) {
  island_ = island;
  basis_ = &basis;
  certificate_rows_ = 0;
  const mlcp_outcome outcome = run(input, limits, counts);
  if (outcome != MLCP_INFEASIBLE) return outcome;
  const auto soften = [&](double amount) { basis.values.soften(input.problem, *basis.pattern, island.first_row, island.last_row, amount); };
  soften(least_violation_softness);
  limits.restart(counts);
  run(input, limits, counts);
  soften(0);
  return outcome;
}

}  // namespace mlcp
