#pragma once
#include "contact_point.h"
#include "shapes.h"

namespace scenes {

/// Contacts of a sphere b with a shape a: one point each. Concentric spheres touch along z.
ContactPoint contact(const Plane& a, const Frame& frame_a, const Sphere& b, const Point& centre_b);
ContactPoint contact(const Sphere& a, const Point& centre_a, const Sphere& b, const Point& centre_b);
ContactPoint contact(const Capsule& a, const Frame& frame_a, const Sphere& b, const Point& centre_b);
/// A centre inside the box is pushed out through the nearest face.
ContactPoint contact(const Box& a, const Frame& frame_a, const Sphere& b, const Point& centre_b);

}  // namespace scenes
