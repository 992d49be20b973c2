#pragma once
#include <vector>

#include "contact_point.h"
#include "shapes.h"

namespace scenes {

/// Corner 4i + 2j + k lies at −x or +x (i), −y or +y (j), −z or +z (k).
Point corner(const Box& box, std::size_t index);

/// The corners of a box b that are nearer than `margin` to a plane a; feature: the corner.
std::vector<ContactPoint> contacts(const Plane& a, const Frame& frame_a, const Box& b, const Frame& frame_b, double margin);

/// The contacts of two boxes nearer than `margin`: a face of one against the clipped face of the other, up to eight points, or one point
/// where two edges cross. Faces win over edges by a thousandth of the box, so that stacked boxes keep their contacts.
/// source: separating axes, Gottschalk, Lin & Manocha (1996); clipping, Sutherland & Hodgman (1974).
std::vector<ContactPoint> contacts(const Box& a, const Frame& frame_a, const Box& b, const Frame& frame_b, double margin);

}  // namespace scenes
