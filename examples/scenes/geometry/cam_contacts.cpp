#include "cam_contacts.h"

#include <algorithm>
#include <cmath>

namespace scenes {
ContactPoint contact(const AnnularCam& a, const Frame& frame_a, const Sphere& b, const Point& centre_b) {
  const Point local = frame_a.to_local(centre_b);
  const double from_axis = std::sqrt(local[0] * local[0] + local[1] * local[1]);
  const Point outward = from_axis > 0 ? 1 / from_axis * Point{local[0], local[1], 0} : axes[0];
  // in the half-plane (z, distance from the axis) the free side of a segment lies towards the axis
  double distance = INFINITY;
  Point normal = -1.0 * outward;
  for (std::size_t i = 0; i + 1 < a.profile.size(); ++i) {
    const auto [z0, r0] = a.profile[i];
    const auto [z1, r1] = a.profile[i + 1];
    const double dz = z1 - z0, dr = r1 - r0, squared = dz * dz + dr * dr;
    const double share = std::clamp(((local[2] - z0) * dz + (from_axis - r0) * dr) / squared, 0.0, 1.0);
    const double away_z = local[2] - z0 - share * dz, away_r = from_axis - r0 - share * dr;
    const double towards_axis = (away_z * dr - away_r * dz) / std::sqrt(squared);
    const double reach = std::sqrt(away_z * away_z + away_r * away_r);
    if (reach >= std::fabs(distance)) continue;
    distance = towards_axis < 0 ? -reach : reach;
    const bool at_end = share == 0 || share == 1;
    const double scale = at_end && reach > 0 ? 1 / distance : 1 / std::sqrt(squared);
    normal = at_end && reach > 0 ? scale * away_r * outward + Point{0, 0, scale * away_z}
                                 : -scale * dz * outward + Point{0, 0, scale * dr};
  }
  const Point n = frame_a.rotation * normal;
  const double gap = distance - b.radius;
  return {centre_b - (b.radius + 0.5 * gap) * n, n, gap, 0};
}

}  // namespace scenes
