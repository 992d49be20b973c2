#include "solve/redundancy.h"

#include <cmath>

namespace mlcp {
namespace {

/// A dependent row has the pivot ε a and rounding.
constexpr double hardly_more = 100;

}  // namespace

bool mark_redundant(const Island& island, Basis& basis, double epsilon, std::int32_t n, std::uint8_t* redundant, Counts& counts) {
  if (island.crowded) return true;
  const double holds = 1e-9 / basis.zero(), least = std::max(dependent_pivot, hardly_more * epsilon);
  bool shared = false;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::uint8_t state = basis.set.state[o];
    const std::int32_t p = basis.position(o);
    double pivot;
    if (state == ActiveSet::active) {
      if (epsilon == 0) continue;
      pivot = -basis.factor.pivot(p);
    } else {
      if (state == ActiveSet::disabled || basis.values.lo[o] == basis.values.hi[o]) continue;
      if (!(std::abs(basis.set.w[o]) <= holds * basis.set.tolerance[o])) continue;
      shared = true;
      pivot = -basis.factor.schur(island, p, counts.work);
    }
    if (pivot > least * basis.values.a[o]) continue;
    redundant[basis.pattern->node[p] - n] = 1;
    shared = true;
  }
  return shared;
}

}  // namespace mlcp
