#pragma once
#include <array>
#include <vector>

#include "geometry/shapes.h"

namespace scenes {

/// What there is to see of a scene, in the world's frame, m. A scene in the plane has y = 0 and its height in z.
struct Drawing {
  struct Sphere {
    Point centre;
    double radius;
  };
  /// Where a row acts and along what: γ/h is the force along `direction` on body b, and its opposite on body a.
  struct Action {
    Point point, direction;
  };
  /// Corner 4i + 2j + k lies at −x or +x (i), −y or +y (j), −z or +z (k) of the box.
  using Corners = std::array<Point, 8>;
  using Path = std::vector<Point>;

  std::vector<Sphere> spheres;
  std::vector<Corners> boxes;
  std::vector<Path> paths;      // bodies that are lines, and the ground
  std::vector<Action> actions;  // a row each, in the order of the rows
};

Drawing::Corners corners(const Box& box, const Frame& frame);

}  // namespace scenes
