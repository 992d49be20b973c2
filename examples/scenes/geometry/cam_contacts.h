#pragma once
#include "contact_point.h"
#include "shapes.h"

namespace scenes {

/// The bore of a ring a and a sphere b inside it: where the sphere is nearest to the profile. A centre on the axis touches along x.
ContactPoint contact(const AnnularCam& a, const Frame& frame_a, const Sphere& b, const Point& centre_b);

}  // namespace scenes
