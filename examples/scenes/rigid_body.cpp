#include "rigid_body.h"

namespace scenes {

RigidBody solid(const Sphere& sphere, double mass, const Frame& frame) {
  const double moment = 0.4 * mass * sphere.radius * sphere.radius;
  return {mass, {moment, moment, moment}, frame};
}

RigidBody solid(const Box& box, double mass, const Frame& frame) {
  const Point& e = box.half_extent;
  return {mass, mass / 3 * Point{e[1] * e[1] + e[2] * e[2], e[0] * e[0] + e[2] * e[2], e[0] * e[0] + e[1] * e[1]}, frame};
}

RigidBody solid(const Capsule& capsule, double mass, const Frame& frame) {
  // a cylinder and two half balls, whose centres of mass lie 3/8 r beyond its ends
  const double l = capsule.half_length, r = capsule.radius;
  const double cylinder = mass * 2 * l / (2 * l + 4.0 / 3 * r), balls = mass - cylinder;
  const double along = (0.5 * cylinder + 0.4 * balls) * r * r;
  const double across = cylinder * (0.25 * r * r + l * l / 3) + balls * (0.4 * r * r + l * l + 0.75 * l * r);
  return {mass, {across, across, along}, frame};
}

Point angular_momentum(const RigidBody& body, const Point& omega) {
  Point sum = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point e = body.frame.axis(k);
    sum = sum + body.inertia[k] * dot(e, omega) * e;
  }
  return sum;
}

}  // namespace scenes
