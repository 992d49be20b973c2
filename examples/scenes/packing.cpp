#include "packing.h"

#include <algorithm>
#include <cmath>

#include "random.h"

namespace scenes {
namespace {

/// Spheres along one edge of the floor; the settled pile is about two thirds as high as wide.
int spheres_across(int count) {
  int across = 1;
  while (across * across * across < count) ++across;
  return across;
}

/// Square layers, every second one moved by half a cell so that it lies in the hollows (face-centred cubic), stretched until
/// spheres fill 58 % of the space, a little less than a random packing does.
Packing jittered_lattice(int count, unsigned seed) {
  Random random(seed);
  const int across = spheres_across(count);
  const double spacing = 2.2 * mean_radius;
  const double layer_height = 0.7071 * spacing;
  const double jitter = 0.3 * mean_radius;
  Packing packing;
  packing.side = (across + 0.5) * spacing;
  for (int i = 0; i < count; ++i) {
    packing.radius.push_back(random.uniform(0.8, 1.2) * mean_radius);
    const int layer = i / (across * across), row = i / across % across, column = i % across;
    const double shift = layer % 2 == 0 ? 0.5 : 1;
    Point centre = {(column + shift) * spacing, (row + shift) * spacing, mean_radius + layer * layer_height};
    for (double& coordinate : centre) coordinate += random.uniform(-jitter, jitter);
    packing.centre.push_back(centre);
  }
  return packing;
}

void push_apart(Packing& packing, std::size_t a, std::size_t b) {
  Point& p = packing.centre[a];
  Point& q = packing.centre[b];
  const Point d = q - p;
  const double reach = packing.radius[a] + packing.radius[b];
  const double squared = dot(d, d);
  if (squared >= reach * reach || squared == 0) return;
  const double distance = std::sqrt(squared);
  // mostly the upper one moves, so that the weight above does not squeeze the spheres below
  const double share = q[2] > p[2] ? 0.25 : 0.75;
  const Point apart = (reach - distance) / distance * d;
  p = p - share * apart;
  q = q + (1 - share) * apart;
}

void push_inside(Packing& packing, std::size_t i) {
  Point& p = packing.centre[i];
  const double r = packing.radius[i];
  for (std::size_t axis = 0; axis < 2; ++axis) p[axis] = std::clamp(p[axis], r, packing.side - r);
  p[2] = std::max(p[2], r);
}

}  // namespace

Packing settle_spheres(int count, unsigned seed) {
  Packing packing = jittered_lattice(count, seed);
  constexpr int sweeps = 60;
  constexpr double slowdown = 0.87;
  // in all a fifth of the height and a radius
  double fall = (0.2 * packing.centre.back()[2] + mean_radius) * (1 - slowdown);
  for (int sweep = 0; sweep < sweeps; ++sweep, fall *= slowdown) {
    for (Point& p : packing.centre) p[2] -= fall;
    const auto pairs = near_pairs(packing.centre, 2 * largest_radius);
    for (int pass = 0; pass < 3; ++pass) {
      for (const auto& [a, b] : pairs) push_apart(packing, static_cast<std::size_t>(a), static_cast<std::size_t>(b));
      for (std::size_t i = 0; i < packing.centre.size(); ++i) push_inside(packing, i);
    }
  }
  return packing;
}

}  // namespace scenes
