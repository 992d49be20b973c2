#include "sphere_contacts.h"

#include <algorithm>
#include <cmath>

namespace scenes {

ContactPoint contact(const Plane& a, const Frame& frame_a, const Sphere& b, const Point& centre_b) {
  const Point n = frame_a.rotation * a.normal;
  const double gap = dot(n, centre_b - frame_a.origin) - a.offset - b.radius;
  return {centre_b - (b.radius + 0.5 * gap) * n, n, gap, 0};
}

ContactPoint contact(const Sphere& a, const Point& centre_a, const Sphere& b, const Point& centre_b) {
  const Point apart = centre_b - centre_a;
  const double distance = length(apart), gap = distance - a.radius - b.radius;
  const Point n = distance > 0 ? 1 / distance * apart : axes[2];
  return {centre_a + (a.radius + 0.5 * gap) * n, n, gap, 0};
}

ContactPoint contact(const Capsule& a, const Frame& frame_a, const Sphere& b, const Point& centre_b) {
  const double along = std::clamp(frame_a.to_local(centre_b)[2], -a.half_length, a.half_length);
  return contact(Sphere{a.radius}, frame_a.to_world({0, 0, along}), b, centre_b);
}

ContactPoint contact(const Box& a, const Frame& frame_a, const Sphere& b, const Point& centre_b) {
  const Point centre = frame_a.to_local(centre_b);
  Point nearest = centre;
  std::size_t face = 0;  // the one that is least deep below
  for (std::size_t axis = 0; axis < 3; ++axis) {
    nearest[axis] = std::clamp(centre[axis], -a.half_extent[axis], a.half_extent[axis]);
    if (a.half_extent[axis] - std::fabs(centre[axis]) < a.half_extent[face] - std::fabs(centre[face])) face = axis;
  }
  if (const double distance = length(centre - nearest); distance > 0)
    return contact(Sphere{0}, frame_a.to_world(nearest), b, centre_b);
  const Point n = frame_a.rotation * ((centre[face] < 0 ? -1.0 : 1.0) * axes[face]);
  const double gap = std::fabs(centre[face]) - a.half_extent[face] - b.radius;
  return {centre_b - (b.radius + 0.5 * gap) * n, n, gap, 0};
}

}  // namespace scenes
