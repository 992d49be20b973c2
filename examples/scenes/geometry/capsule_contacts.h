#pragma once
#include <array>

#include "contact_point.h"
#include "shapes.h"

namespace scenes {

/// Both ends of a capsule b on a plane a.
std::array<ContactPoint, 2> contacts(const Plane& a, const Frame& frame_a, const Capsule& b, const Frame& frame_b);
/// Where two capsules are nearest; parallel ones have one contact, in the middle of what they have beside each other.
ContactPoint contact(const Capsule& a, const Frame& frame_a, const Capsule& b, const Frame& frame_b);
/// The same, but two contacts for capsules that lie beside each other within 30°, at the ends of what they share.
std::vector<ContactPoint> contacts(const Capsule& a, const Frame& frame_a, const Capsule& b, const Frame& frame_b);

}  // namespace scenes
