#pragma once
#include <array>
#include <span>
#include <vector>

#include "geometry/shapes.h"

namespace scenes {

/// What there is to see of a scene, in the world's frame, m. A scene in the plane has y = 0 and its height in z.
struct Drawing {
  /// What a thing is to the scene; pictures give each a colour. The ground lies under everything.
  enum class Role { Body, Product, Machine, Drive, Ground };
  struct Ball {
    Point centre;
    double radius;
    Role role = Role::Body;
  };
  /// A flat polygon, seen from the side where its corners run counterclockwise.
  struct Face {
    std::vector<Point> corners;
    Role role;
  };
  /// Where a row acts and along what: γ/h is the force along `direction` on body b, and its opposite on body a.
  struct Action {
    Point point, direction;
  };
  /// Corner 4i + 2j + k lies at −x or +x (i), −y or +y (j), −z or +z (k) of the box.
  using Corners = std::array<Point, 8>;
  using Path = std::vector<Point>;

  std::vector<Ball> spheres;
  std::vector<Corners> boxes;
  std::vector<Face> faces;      // other solids, the machine among them
  std::vector<Path> paths;      // bodies that are lines, and the ground
  std::vector<Action> actions;  // a row each, in the order of the rows
  Point eye = {0, -1, 0};       // the direction from which the scene is best seen
};

Drawing::Corners corners(const Box& box, const Frame& frame);

void draw(Drawing& to, const Box& box, const Frame& frame, Drawing::Role role);
void draw(Drawing& to, const Capsule& capsule, const Frame& frame, Drawing::Role role);

/// A solid of revolution about the frame's z axis, turned from angle `from` by `sweep` (rad; less than a whole turn shows the cut).
/// profile: (z, distance from the axis), a loop that goes along outer surfaces with z ascending.
void draw_turned(Drawing& to, std::span<const AnnularCam::Station> profile, const Frame& frame, Drawing::Role role, int segments = 24,
                 double from = 0, double sweep = 6.283185307179586);

}  // namespace scenes
