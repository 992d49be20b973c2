#include "solve/gauss_seidel.h"

#include <algorithm>
#include <cmath>

#include "measure/errors.h"
#include "solve/subspace.h"

namespace mlcp {
namespace {

/// A guess is good enough for the exact methods when a cycle moves at most one row in so many from or to a bound; from impulses that are nearly right
/// cycles move few rows from the start.
constexpr std::int32_t quiet = 100, quiet_warm = 1200;
/// The same of half as many sweeps alone.
constexpr std::int32_t quiet_alone = 800;
/// Twice the products of a factorization, by the numbers that a sweep reads, from which on cycles pay.
constexpr double dear = 140;
constexpr int first_sweeps = 8, most_cycles = 8;
/// Of each cycle: conjugate gradients on the rows between their bounds, then sweeps.
constexpr int gradients = 15, sweeps_between = 8;
constexpr int sweeps_between_looks = 8;

/// So many rows, far apart in the elimination order, take turns in a sweep: neighbours share bodies and would wait for each other. Not where the rows and
/// what they touch exceed the caches.
constexpr std::int32_t lanes = 4, most_apart = 16384;

}  // namespace

bool GaussSeidel::prepare(const Island& island) { return basis_.response.compute(island, basis_.values, counts_.work); }

/// v = M⁻¹(k + Jᵀγ)
void GaussSeidel::start(const Island& island) {
  basis_.response.solve(island, basis_.values.b.data());
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if (const double gamma = basis_.gamma(o); gamma != 0) basis_.response.rows().add(o, gamma, basis_.response.velocity.data());
}

void GaussSeidel::sweep(const Island& island) {
  const KktPattern& pattern = *basis_.pattern;
  const KktValues& k = basis_.values;
  const MassResponse::Rows rows = basis_.response.rows();
  const std::uint8_t* state = basis_.set.state.data();
  const std::int32_t *position = pattern.row_position.data(), *beside = basis_.response.parts().beside.data(), *row_end = pattern.row_pointers.data() + 1;
  const double *diagonal = k.diagonal.data(), *b = k.b.data(), *lo = k.lo.data(), *hi = k.hi.data();
  const double *a = basis_.response.diagonal.data(), *inverse = basis_.response.inverse.data();
  double *x = basis_.set.x.data(), *velocity = basis_.response.velocity.data();
  const auto relax = [&, rows](std::int32_t o) {
    if (state[o] == ActiveSet::disabled || !(a[o] > 0)) return;
    const std::int32_t p = position[o];
    double w = rows.product(o, velocity) + (diagonal[p] * x[p] - b[p]);
    for (std::int32_t t = beside[o]; t < row_end[o]; ++t) w += k.row[t] * x[pattern.row_columns[t]];
    const double gamma = -x[p], next = std::min(std::max(gamma - w * inverse[o], lo[o]), hi[o]), change = next - gamma;
    if (change == 0 || !std::isfinite(change)) return;
    x[p] = -next;
    rows.add(o, change, velocity);
  };
  const std::int32_t count = island.last_row - island.first_row, apart = count <= most_apart ? (count + lanes - 1) / lanes : count;
  for (std::int32_t i = island.first_row; i < island.first_row + apart; ++i)
    for (std::int32_t o = i; o < island.last_row; o += apart) relax(o);
  counts_.work += pattern.row_pointers[island.last_row] - pattern.row_pointers[island.first_row];
  ++counts_.pivots;
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

void GaussSeidel::guess(const Island& island, bool warm) {
  const std::int32_t rows = island.last_row - island.first_row;
  const auto go_on = [&] { return limits_.check(counts_, 0) == MLCP_SOLVED; };
  const auto sweeps = [&](int count) {
    for (int s = 0; s < count && go_on(); ++s) sweep(island);
    return settle(island);
  };
  start(island);
  if (!warm) sweeps(first_sweeps);
  std::int32_t moved = sweeps(sweeps_between / 2);
  if (cycles_pay(island) && !must_depend(island)) {
    Subspace subspace(basis_, counts_);
    const std::int32_t enough = rows / (warm ? quiet_warm : quiet);
    for (int c = 0; moved > enough && c < most_cycles && go_on(); ++c) {
      subspace.minimise(island, gradients);
      moved = sweeps(sweeps_between);
    }
  } else if (!must_depend(island)) {
    for (int c = 0; moved > rows / quiet_alone && c < most_cycles && go_on(); ++c) moved = sweeps(sweeps_between / 2);
  }
  basis_.response.give(island, basis_.set.x.data());
}

bool GaussSeidel::must_depend(const Island& island) const {
  const std::uint8_t* state = basis_.set.state.data();
  const auto active = std::count(state + island.first_row, state + island.last_row, ActiveSet::active);
  const std::int32_t velocities = island.last - island.first - (island.last_row - island.first_row);
  return velocities > 0 && active > velocities;
}

bool GaussSeidel::cycles_pay(const Island& island) const {
  const Symbolic& symbolic = basis_.factor.symbolic();
  const MassParts& parts = basis_.response.parts();
  const auto& row_pointers = basis_.pattern->row_pointers;
  const auto entries = static_cast<double>(4 * (parts.four_pointers[island.last_row] - parts.four_pointers[island.first_row]) +
                                           row_pointers[island.last_row] - row_pointers[island.first_row]);
  double products = 0;  // of a factorization, twice
  for (std::int32_t p = island.first; p < island.last; ++p) {
    const auto rows = static_cast<double>(symbolic.pointers[p + 1] - symbolic.pointers[p]);
    products += rows * rows;
  }
  return products >= dear * entries;
}

mlcp_outcome GaussSeidel::solve(const Island& island, double tolerance) {
  mlcp_outcome outcome = MLCP_SOLVED;
  for (;;) {
    start(island);  // without the rounding of the sweeps
    basis_.response.give(island, basis_.set.x.data());
    if (error(island) <= tolerance || outcome != MLCP_SOLVED) break;
    for (int s = 0; s < sweeps_between_looks; ++s) sweep(island);
    outcome = limits_.check(counts_, 0);
  }
  settle(island);
  return outcome;
}

}  // namespace mlcp
