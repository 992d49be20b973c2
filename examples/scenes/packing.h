#pragma once
#include <vector>

#include "grid.h"

namespace scenes {

/// Spheres at rest in a box with floor z = 0 and walls at 0 and `side` in x and y.
struct Packing {
  std::vector<double> radius;
  std::vector<Point> centre;
  double side = 0;
};

constexpr double mean_radius = 0.05;  // m
constexpr double largest_radius = 1.2 * mean_radius;

/// A random packing, two and a half contacts a sphere that touch and as many that nearly do. Starts as a jittered lattice, is
/// pulled down by ever smaller steps and pushed apart where spheres overlap (position-based dynamics, Müller et al. 2007).
/// Overlaps of about a hundredth of a radius stay. Only + − × ÷ √, so the bits are the same everywhere. Cost: O(n log n) a
/// sweep, a fixed number of sweeps.
Packing settle_spheres(int count, unsigned seed);

}  // namespace scenes
