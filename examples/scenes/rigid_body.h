#pragma once
#include "geometry/shapes.h"

namespace scenes {

struct RigidBody {
  double mass;     // kg
  Point inertia;   // principal moments about the frame's axes, kg m²
  Frame frame;     // origin: the centre of mass
};

/// Solids of even density.
RigidBody solid(const Sphere& sphere, double mass, const Frame& frame);
RigidBody solid(const Box& box, double mass, const Frame& frame);
RigidBody solid(const Capsule& capsule, double mass, const Frame& frame);

/// I ω in the world's frame
Point angular_momentum(const RigidBody& body, const Point& omega);

}  // namespace scenes
