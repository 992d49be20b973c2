#include "solve/proximal_simplex.h"

#include <algorithm>
#include <cmath>

#include "memory/slice.h"

namespace mlcp {
namespace {

constexpr int most_steps = 60;
/// Steps that are longer than half of the one before, one after the other, before they are taken for those of an unbounded problem.
constexpr int patience = 6;
/// Of the largest momentum: what a step adds to it when refinement reaches the point itself.
constexpr double near = 1e-4;
constexpr double refined = 1e-13;

}  // namespace

/// Around the present velocities.
void ProximalSimplex::add_mass(const Island& island) {
  for (std::int32_t p = island.first; p < island.last; ++p) {
    if (basis_.pattern->is_row(p)) continue;
    const double v = basis_.set.x[p];
    basis_.work.center[p] = std::isfinite(v) ? v : 0;
  }
  basis_.values.add_proximal_mass(*basis_.pattern, island, semidefinite_delta, basis_.work.center.data());
}

/// How far the last step is from standing still: max δⱼ|v − u|ⱼ over the largest momentum, or max |v − u| over the largest velocity, whichever is less. Not by
/// component: a velocity that tends to 0 has no scale.
double ProximalSimplex::moved(const Island& island) {
  const KktValues& k = basis_.values;
  double most = 0, size = 0, way = 0, speed = 0;
  basis_.refinement.error(island, *basis_.pattern, k, basis_.factor, k.b.data(), k.size.data(), basis_.set.x.data(), counts_.work);
  for (std::int32_t p = island.first; p < island.last; ++p) {
    if (basis_.pattern->is_row(p)) continue;
    const double v = basis_.set.x[p], step = std::abs(v - basis_.work.center[p]);
    most = std::max(most, (k.factored[p] - k.diagonal[p]) * step);
    size = std::max(size, basis_.refinement.scale(p));
    way = std::max(way, step);
    speed = std::max(speed, std::abs(v));
  }
  return way == 0 || most == 0 ? 0 : std::min(most / size, way / speed);
}

/// Whether the point of the active set solves the problem itself; else x stays.
bool ProximalSimplex::solves(const Island& island) {
  auto x = slice(basis_.set.x.data(), island.first, island.last);
  auto saved = slice(basis_.work.step.data(), island.first, island.last);
  saved = x;
  bool right = basis_.refine(island, counts_, true) <= refined;
  for (std::int32_t o = island.first_row; o < island.last_row && right; ++o) {
    const double gamma = basis_.gamma(o);
    const bool beyond = basis_.set.state[o] == ActiveSet::active && (gamma < basis_.values.lo[o] || gamma > basis_.values.hi[o]);
    right = !beyond && !basis_.set.violated(o);
  }
  if (!right) x = saved;
  return right;
}

mlcp_outcome ProximalSimplex::solve(const Island& island, std::int32_t index, Array<mlcp_pivot>* trace) {
  const KktPattern& pattern = *basis_.pattern;
  KktValues& k = basis_.values;
  double before = infinity;
  mlcp_outcome outcome = MLCP_SOLVED;
  for (int step = 0, left = patience; step < most_steps && left > 0; ++step) {
    add_mass(island);
    outcome = simplex_.solve(island, index, trace);
    k.take_proximal_mass_away(problem_, pattern, island);
    if (outcome != MLCP_SOLVED) break;
    limits_.restart(counts_);
    const double now = moved(island);
    if (now <= near && solves(island)) return MLCP_SOLVED;
    outcome = now <= near ? MLCP_ITERATION_LIMIT : MLCP_NOT_POSITIVE_DEFINITE;
    left = now == 0 ? 0 : now <= 0.5 * before ? patience : left - 1;
    before = now;
  }
  k.regularise(pattern, island, 0, 0);
  return outcome;
}

void ProximalSimplex::settle(const Island& island) {
  add_mass(island);
  simplex_.settle(island);
  basis_.values.take_proximal_mass_away(problem_, *basis_.pattern, island);
  basis_.values.regularise(*basis_.pattern, island, 0, 0);
}

}  // namespace mlcp
