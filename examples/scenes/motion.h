#pragma once
#include <array>
#include <vector>

#include "vector.h"

namespace scenes {

/// Velocity of a body or a rate per such velocity: linear, then angular, in the world's frame.
using Twist = std::array<double, 6>;

/// Which components of a twist a scene's bodies have: all, or those of a motion in an upright (x, z) or flat (x, y) plane. Positions are in
/// space all the same; the other components of forces and rows are dropped.
enum class Motion { Space, Upright, Flat };

/// Indices into a twist.
std::vector<std::size_t> coordinates(Motion motion);

/// The rate at which a point `arm` away from the centre moves along n, per velocity of the body.
Twist rate_along(const Point& n, const Point& arm);
/// The rate at which the body turns about n.
Twist rate_about(const Point& n);
Twist operator-(const Twist& twist);

}  // namespace scenes
