#pragma once
#include <vector>

#include "../vector.h"

namespace scenes {

/// Shapes in a frame of their own. In the plane a sphere is a disc and a capsule a stadium; m.

/// n · x ≥ offset is free.
struct Plane {
  Point normal = {0, 0, 1};
  double offset = 0;
};

struct Sphere {
  double radius;
};

/// All points within `radius` of the segment from −half_length to +half_length on the z axis.
struct Capsule {
  double half_length, radius;
};

struct Box {
  Point half_extent;
};

/// A ring about the z axis whose bore has this profile, z ascending: straight lines in the half-plane (z, distance from the axis).
/// The bore is free, the material lies outside.
struct AnnularCam {
  struct Station {
    double z, radius;
  };
  std::vector<Station> profile;
};

}  // namespace scenes
