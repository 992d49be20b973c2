#include "drawing.h"

#include <algorithm>
#include <cmath>

#include "geometry/box_contacts.h"

namespace scenes {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Leaves out corners that fall together, and faces that this makes lines.
void draw_face(Drawing& to, std::span<const Point> corners, Drawing::Role role) {
  std::vector<Point> kept;
  for (const Point& corner : corners)
    if (kept.empty() || (length(corner - kept.back()) > 1e-9 && length(corner - kept.front()) > 1e-9)) kept.push_back(corner);
  if (kept.size() > 2) to.faces.push_back({kept, role});
}

}  // namespace

Drawing::Corners corners(const Box& box, const Frame& frame) {
  Drawing::Corners corners;
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = frame.to_world(corner(box, i));
  return corners;
}

/// In slices along the longest edge: pictures sort faces by the depth of their middles, which long faces would mislead.
void draw(Drawing& to, const Box& box, const Frame& frame, Drawing::Role role) {
  constexpr std::size_t faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};  // −x, +x, −y …
  const Point& e = box.half_extent;
  const std::size_t longest = static_cast<std::size_t>(std::max_element(e.begin(), e.end()) - e.begin());
  const double second = std::max(e[(longest + 1) % 3], e[(longest + 2) % 3]);
  const int slices = static_cast<int>(std::ceil(e[longest] / (3 * second)));
  Box slice = box;
  slice.half_extent[longest] /= slices;
  for (int s = 0; s < slices; ++s) {
    const Frame middle = frame * Frame{((2 * s + 1.0) / slices - 1) * e[longest] * axes[longest]};
    const Drawing::Corners at = corners(slice, middle);
    for (std::size_t face = 0; face < 6; ++face) {
      const bool inside = face / 2 == longest && s != (face % 2 == 0 ? 0 : slices - 1);
      const auto& [i, j, k, l] = faces[face];
      if (!inside) draw_face(to, std::array{at[i], at[j], at[k], at[l]}, role);
    }
  }
}

void draw(Drawing& to, const Capsule& capsule, const Frame& frame, Drawing::Role role) {
  constexpr int parts = 4;  // of a quarter circle
  std::vector<AnnularCam::Station> profile;
  for (int i = -parts; i <= parts; ++i) {
    const double angle = 0.5 * pi * i / parts, end = i < 0 ? -capsule.half_length : capsule.half_length;
    if (i == 0) profile.push_back({-capsule.half_length, capsule.radius});
    profile.push_back({end + capsule.radius * std::sin(angle), capsule.radius * std::cos(angle)});
  }
  draw_turned(to, profile, frame, role, 16);
}

void draw_turned(Drawing& to, std::span<const AnnularCam::Station> profile, const Frame& frame, Drawing::Role role, int segments,
                 double from, double sweep) {
  const auto at = [&](const AnnularCam::Station& station, int i) {
    const double angle = from + sweep * i / segments;
    return frame.to_world({station.radius * std::cos(angle), station.radius * std::sin(angle), station.z});
  };
  for (int i = 0; i < segments; ++i) {
    for (std::size_t j = 0; j < profile.size(); ++j) {
      const AnnularCam::Station &a = profile[j], &b = profile[(j + 1) % profile.size()];
      draw_face(to, std::array{at(a, i), at(a, i + 1), at(b, i + 1), at(b, i)}, role);
    }
  }
  if (sweep > 2 * pi - 1e-9) return;
  std::vector<Point> near_cut, far_cut;
  for (const AnnularCam::Station& station : profile) {
    near_cut.push_back(at(station, 0));
    far_cut.insert(far_cut.begin(), at(station, segments));
  }
  draw_face(to, near_cut, role);
  draw_face(to, far_cut, role);
}

}  // namespace scenes
