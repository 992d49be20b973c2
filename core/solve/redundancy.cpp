#include "solve/redundancy.h"

#include <cmath>

namespace mlcp {

void mark_redundant(const Island& island, Basis& basis, std::int32_t n, std::uint8_t* redundant, Counts& counts) {
  const double holds = 1e-9 / basis.zero();
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const auto state = basis.set.state[o];
    if (state == ActiveSet::active || state == ActiveSet::disabled || basis.values.lo[o] == basis.values.hi[o]) continue;
    if (!(std::abs(basis.set.w[o]) <= holds * basis.set.tolerance[o])) continue;
    const std::int32_t p = basis.position(o);
    const double schur = -basis.factor.schur(island, p, counts.work);
    redundant[basis.pattern->node[p] - n] = schur <= dependent_pivot * basis.values.a[o];
  }
}

}  // namespace mlcp
