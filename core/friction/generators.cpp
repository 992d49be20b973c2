#include "friction/generators.h"

#include "measure/cones.h"

namespace mlcp {
namespace {

/// Guards at even places, generators to aim at odd ones.
constexpr std::int32_t most = 6;
constexpr std::int32_t hexagon = 6;
/// 1 − cos of an angle of 1e-8: the same direction.
constexpr double same = 5e-17;

bool guard(std::int32_t place) { return place % 2 == 0; }

std::int32_t places(const Cone& cone) { return cone.planar ? 2 : cone.facets > 0 ? std::min(cone.facets, most) : most; }

/// Place k of a cone: spread evenly over its facets.
Tangent first_direction(const Cone& cone, std::int32_t k) {
  if (cone.planar) return {k == 0 ? 1.0 : -1.0, 0};
  if (cone.facets == 0) return Cone{cone.mu, hexagon, false}.direction(k);
  const std::int32_t count = places(cone);
  return cone.direction(static_cast<std::int32_t>((std::int64_t(2) * k * cone.facets + count) / (2 * count)));
}

/// ½|a − b|² = 1 − cos of the angle between, without cancellation.
double apart(Tangent a, Tangent b) {
  const double x = a.x - b.x, y = a.y - b.y;
  return 0.5 * (x * x + y * y);
}

}  // namespace

void Generators::start(const Problem& problem, const Mask* enabled, std::int32_t facets) {
  facets_ = facets;
  contact.clear();
  first.clear();
  direction.clear();
  first.push_back(0);
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    if (!has_cone(problem.contacts[i], enabled)) continue;
    const Cone cone = cone_of(problem.contacts[i], facets);
    contact.push_back(static_cast<std::int32_t>(i));
    for (std::int32_t k = 0; k < places(cone); ++k) direction.push_back(first_direction(cone, k));
    first.push_back(static_cast<std::int32_t>(direction.size()));
  }
  tried.resize(contact.size());
  for (std::size_t c = 0; c < contact.size(); ++c) tried[c] = first[c + 1] - first[c];
}

bool Generators::complete(const Problem& problem, std::int32_t c) const {
  const Cone k = cone(problem, c);
  return k.planar || (k.facets > 0 && k.facets <= most);
}

std::int32_t Generators::aim(const Problem& problem, std::int32_t c, Tangent d, bool move, const mlcp_row_state* state, const double* w) {
  if (complete(problem, c)) return -1;
  Tangent* directions = direction.data() + first[c];
  const std::int32_t count = first[c + 1] - first[c];
  std::int32_t best = -1;
  for (std::int32_t k = 0; k < count; ++k) {
    if (apart(directions[k], d) <= same) return -1;
    if (guard(k)) continue;
    if (move ? best < 0 || apart(directions[k], d) < apart(directions[best], d)
             : state[k] != MLCP_ROW_ACTIVE && (best < 0 || w[k] > w[best]))
      best = k;
  }
  if (best < 0) return -1;
  directions[best] = d;
  ++tried[c];
  return first[c] + best;
}

}  // namespace mlcp
