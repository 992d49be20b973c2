#include "solve/ratio_test.h"

#include <cmath>

namespace mlcp {
namespace {

/// Components of a direction below this, with rows scaled to a = 1, are rounding.
constexpr double negligible = 1e-12;

}  // namespace

Step ratio_test(const Island& island, const Basis& basis, const Direction& direction, std::int32_t entering, mlcp_pivot_rule rule) {
  const ActiveSet& set = basis.set;
  const KktValues& k = basis.values;
  const double* slopes = basis.work.slope.data();
  Step step;
  const auto row = [&](std::int32_t o) { return basis.pattern->node[basis.position(o)]; };
  const double per_unit = k.root_a[entering];
  // the entering row arrives: at w = 0, or at its far bound
  const auto arrive = [&](double length, ActiveSet::State to) {
    if (std::max(length, 0.0) < step.length) step = {std::max(length, 0.0), entering, to};
  };
  if (!direction.dependent) arrive(-set.w[entering] / slopes[entering], ActiveSet::active);
  const double gamma = basis.gamma(entering);
  if (direction.sign > 0 && k.hi[entering] < infinity) arrive(k.hi[entering] - gamma, ActiveSet::at_upper);
  if (direction.sign < 0 && k.lo[entering] > -infinity) arrive(gamma - k.lo[entering], ActiveSet::at_lower);

  // row o blocks after `distance` at `slope`, both of one sign. Where it does not come before the present one, a product tells; the entering
  // row wins ties, which ends the inner loop
  const auto offer = [&](double distance, double slope, double scale, std::int32_t o, ActiveSet::State to) {
    if (std::abs(distance) > step.length * std::abs(slope) || std::abs(slope) * scale <= negligible * per_unit) return;
    const double length = std::max(distance / slope, 0.0);
    const bool before = step.blocking >= 0 && step.blocking != entering && row(o) < row(step.blocking);
    if (length < step.length || (length == step.length && before)) step = {length, o, to};
  };
  const std::uint8_t* state = set.state.data();
  const std::int32_t* position = basis.pattern->row_position.data();
  const double* dx = basis.work.step.data();
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (state[o] != ActiveSet::active) continue;
    const double slope = -dx[position[o]];
    if (slope < 0 && k.lo[o] > -infinity) offer(std::min(k.lo[o] - basis.gamma(o), 0.0), slope, k.root_a[o], o, ActiveSet::at_lower);
    if (slope > 0 && k.hi[o] < infinity) offer(std::max(k.hi[o] - basis.gamma(o), 0.0), slope, k.root_a[o], o, ActiveSet::at_upper);
  }
  if (rule == MLCP_PIVOT_PRINTED && !direction.dependent) {
    for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
      const double w = set.w[o], slope = slopes[o], zero = set.tolerance[o];
      if (o == entering || zero == infinity) continue;
      if (set.state[o] == ActiveSet::at_lower && w >= -zero && slope < 0) offer(std::min(-w, 0.0), slope, 1 / k.root_a[o], o, ActiveSet::active);
      if (set.state[o] == ActiveSet::at_upper && w <= zero && slope > 0) offer(std::max(-w, 0.0), slope, 1 / k.root_a[o], o, ActiveSet::active);
    }
  }
  return step;
}

}  // namespace mlcp
