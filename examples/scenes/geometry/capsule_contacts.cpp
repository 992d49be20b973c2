#include "capsule_contacts.h"

#include <algorithm>
#include <cmath>

#include "sphere_contacts.h"

namespace scenes {

std::array<ContactPoint, 2> contacts(const Plane& a, const Frame& frame_a, const Capsule& b, const Frame& frame_b) {
  std::array<ContactPoint, 2> ends;
  for (std::int32_t end = 0; end < 2; ++end) {
    const double z = end == 0 ? -b.half_length : b.half_length;
    ContactPoint& at = ends[static_cast<std::size_t>(end)];
    at = contact(a, frame_a, Sphere{b.radius}, frame_b.to_world({0, 0, z}));
    at.feature = end;
  }
  return ends;
}

ContactPoint contact(const Capsule& a, const Frame& frame_a, const Capsule& b, const Frame& frame_b) {
  // the nearest s, t in the box |s| ≤ half_a, |t| ≤ half_b of |from_a + s u − t v|²; Ericson (2005), 5.1.9
  const Point u = frame_a.axis(2), v = frame_b.axis(2), from_b = frame_a.origin - frame_b.origin;
  const double uv = dot(u, v), au = dot(from_b, u), av = dot(from_b, v);
  const double sine_squared = 1 - uv * uv;
  const auto on_a = [&](double s) { return std::clamp(s, -a.half_length, a.half_length); };
  const auto on_b = [&](double t) { return std::clamp(t, -b.half_length, b.half_length); };
  double s = 0;
  if (sine_squared > 1e-12) {
    s = on_a((uv * av - au) / sine_squared);
  } else {
    const double reach = b.half_length;  // parallel: the middle of the overlap, seen from a's centre
    s = 0.5 * (on_a(-au - reach) + on_a(-au + reach));
  }
  const double t = on_b(av + s * uv);
  s = on_a(t * uv - au);
  return contact(Sphere{a.radius}, frame_a.to_world({0, 0, s}), Sphere{b.radius}, frame_b.to_world({0, 0, t}));
}

std::vector<ContactPoint> contacts(const Capsule& a, const Frame& frame_a, const Capsule& b, const Frame& frame_b) {
  const Point u = frame_a.axis(2), v = frame_b.axis(2), from_b = frame_a.origin - frame_b.origin;
  const double uv = dot(u, v), reach = std::fabs(uv) * b.half_length;
  const double low = std::max(-dot(from_b, u) - reach, -a.half_length), high = std::min(-dot(from_b, u) + reach, a.half_length);
  if (uv * uv < 0.75 || high - low < 0.1 * b.radius) return {contact(a, frame_a, b, frame_b)};
  std::vector<ContactPoint> ends;
  for (const double s : {low, high}) {
    const double t = std::clamp(dot(from_b, v) + s * uv, -b.half_length, b.half_length);
    ends.push_back(contact(Sphere{a.radius}, frame_a.to_world({0, 0, s}), Sphere{b.radius}, frame_b.to_world({0, 0, t})));
    ends.back().feature = static_cast<std::int32_t>(ends.size());
  }
  return ends;
}

}  // namespace scenes
