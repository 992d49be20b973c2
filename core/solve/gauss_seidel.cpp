#include "solve/gauss_seidel.h"

#include <cmath>

#include "measure/errors.h"
#include "solve/subspace.h"

namespace mlcp {
namespace {

/// A guess is good enough for the exact methods when a sweep moves at most one row in so many from or to a bound.
constexpr std::int32_t quiet = 200;
constexpr int first_sweeps = 20, most_cycles = 8;
/// Of each cycle: conjugate gradients on the rows between their bounds, then sweeps.
constexpr int gradients = 15, sweeps_between = 10;
constexpr int sweeps_between_looks = 8;

}  // namespace

bool GaussSeidel::prepare(const Island& island) { return basis_.response.compute(island, basis_.values, counts_.work); }

/// v = M⁻¹(k + Jᵀγ)
void GaussSeidel::start(const Island& island) {
  double* x = basis_.set.x.data();
  for (std::int32_t p = island.first; p < island.last; ++p)
    if (!basis_.pattern->is_row(p)) x[p] = basis_.values.b[p];
  basis_.response.solve(island, x);
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if (const double gamma = basis_.gamma(o); gamma != 0) basis_.response.add(o, gamma, x);
}

/// returns the number of rows that left a bound or reached one.
std::int32_t GaussSeidel::sweep(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  double* x = basis_.set.x.data();
  std::int32_t moved = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (basis_.set.state[o] == ActiveSet::disabled) continue;
    const std::int32_t p = pattern.row_position[o];
    double w = k.diagonal[p] * x[p] - k.b[p];
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) w += k.row[t] * x[pattern.row_columns[t]];
    const double gamma = -x[p], lo = k.lo[o], hi = k.hi[o], a = basis_.response.diagonal[o];
    if (!(a > 0)) continue;
    double next = gamma - w / a;
    next = next < lo ? lo : next > hi ? hi : next;
    const double change = next - gamma;
    if (change == 0 || !std::isfinite(change)) continue;
    moved += (gamma == lo) != (next == lo) || (gamma == hi) != (next == hi);
    x[p] = -next;
    basis_.response.add(o, change, x);
  }
  counts_.work += pattern.row_pointers[island.last_row] - pattern.row_pointers[island.first_row];
  ++counts_.pivots;
  return moved;
}

/// The constraint error of the report, from numbers of the factor's order.
double GaussSeidel::error(const Island& island) {
  ActiveSet& set = basis_.set;
  const KktValues& k = basis_.values;
  slacks(island, *basis_.pattern, k, set.x.data(), set.w.data());
  slack_tolerances(island, *basis_.pattern, k, 1, set);
  double worst = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (set.state[o] == ActiveSet::disabled) continue;
    const double residual = std::abs(natural_residual(set.w[o], k.a[o], basis_.gamma(o), k.lo[o], k.hi[o]));
    worst = std::max(worst, residual == 0 ? 0 : residual / set.tolerance[o]);
  }
  return worst;
}

/// returns the number of rows whose state was another.
std::int32_t GaussSeidel::settle(const Island& island) {
  std::int32_t moved = 0;
  const KktValues& k = basis_.values;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (basis_.set.state[o] == ActiveSet::disabled || !(k.lo[o] < k.hi[o])) continue;
    const double gamma = basis_.gamma(o);
    const std::uint8_t state = gamma <= k.lo[o] ? ActiveSet::at_lower : gamma >= k.hi[o] ? ActiveSet::at_upper : ActiveSet::active;
    moved += basis_.set.state[o] != state;
    basis_.set.state[o] = state;
  }
  return moved;
}

void GaussSeidel::guess(const Island& island) {
  start(island);
  const std::int32_t rows = island.last_row - island.first_row;
  const auto enough = [&](std::int32_t moved) { return quiet * moved <= rows || limits_.check(counts_, 0) != MLCP_SOLVED; };
  for (int s = 0; s < first_sweeps; ++s) sweep(island);
  settle(island);
  Subspace subspace(basis_, counts_);
  for (int c = 0; c < most_cycles; ++c) {
    subspace.minimise(island, gradients);
    for (int s = 0; s < sweeps_between; ++s) sweep(island);
    if (enough(settle(island))) break;
  }
}

mlcp_outcome GaussSeidel::solve(const Island& island, double tolerance) {
  start(island);
  mlcp_outcome outcome = MLCP_SOLVED;
  while (error(island) > tolerance && outcome == MLCP_SOLVED) {
    for (int s = 0; s < sweeps_between_looks; ++s) sweep(island);
    start(island);  // without the rounding of the sweeps
    outcome = limits_.check(counts_, 0);
  }
  settle(island);
  return outcome;
}

}  // namespace mlcp
