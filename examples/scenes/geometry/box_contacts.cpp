#include "box_contacts.h"

#include <algorithm>
#include <cmath>

namespace scenes {
namespace {

/// A box's reach along the direction n.
double reach(const Box& box, const Frame& frame, const Point& n) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += box.half_extent[axis] * std::fabs(dot(frame.axis(axis), n));
  return sum;
}

/// A direction that may separate the boxes, from a to b, and how far they are apart along it.
struct Separation {
  Point normal;
  double gap = -INFINITY;
  std::size_t axis_a = 3, axis_b = 3;  // 3: not of that box
};

Separation separation(const Box& a, const Frame& frame_a, const Box& b, const Frame& frame_b, Point n, std::size_t axis_a,
                      std::size_t axis_b) {
  const Point apart = frame_b.origin - frame_a.origin;
  if (dot(n, apart) < 0) n = -1.0 * n;
  return {n, dot(n, apart) - reach(a, frame_a, n) - reach(b, frame_b, n), axis_a, axis_b};
}

Separation widest_separation(const Box& a, const Frame& frame_a, const Box& b, const Frame& frame_b) {
  Separation widest;
  const double preference = 1e-3 * *std::max_element(a.half_extent.begin(), a.half_extent.end());
  const auto consider = [&](const Separation& other, double handicap) {
    if (other.gap > widest.gap + handicap) widest = other;
  };
  for (std::size_t i = 0; i < 3; ++i) consider(separation(a, frame_a, b, frame_b, frame_a.axis(i), i, 3), 0);
  for (std::size_t j = 0; j < 3; ++j) consider(separation(a, frame_a, b, frame_b, frame_b.axis(j), 3, j), 1e-2 * preference);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Point n = cross(frame_a.axis(i), frame_b.axis(j));
      if (const double sine = length(n); sine > 1e-6)
        consider(separation(a, frame_a, b, frame_b, 1 / sine * n, i, j), preference);
    }
  }
  return widest;
}

struct Vertex {
  Point point;
  std::int32_t edge;  // the edge that begins here: 0 … 3 of the face that is clipped, 4 … 7 along the sides that clip
};

/// The part of a convex polygon where n · x ≤ offset; `side` names the edge along the cut.
std::vector<Vertex> clipped(const std::vector<Vertex>& polygon, const Point& n, double offset, std::int32_t side) {
  std::vector<Vertex> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vertex& from = polygon[i];
    const Vertex& to = polygon[(i + 1) % polygon.size()];
    const double out_from = dot(n, from.point) - offset, out_to = dot(n, to.point) - offset;
    const bool leaves = out_from <= 0 && out_to > 0, enters = out_from > 0 && out_to < 0;
    if (out_from < 0 || (out_from == 0 && !leaves)) inside.push_back(from);
    if (!leaves && !enters) continue;
    inside.push_back({from.point + out_from / (out_from - out_to) * (to.point - from.point), leaves ? side : from.edge});
  }
  return inside;
}

/// The corners of the face of the box that looks most against n, in order around it.
std::vector<Vertex> face_against(const Box& box, const Frame& frame, const Point& n) {
  std::size_t normal = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::fabs(dot(frame.axis(axis), n)) > std::fabs(dot(frame.axis(normal), n))) normal = axis;
  const std::size_t u = 4 >> ((normal + 1) % 3), v = 4 >> ((normal + 2) % 3);
  const std::size_t first = dot(frame.axis(normal), n) < 0 ? 4 >> normal : 0;
  std::vector<Vertex> face;
  for (const std::size_t index : {first, first + u, first + u + v, first + v})
    face.push_back({frame.to_world(corner(box, index)), static_cast<std::int32_t>(face.size())});
  return face;
}

/// Face `axis` of a, whose outward normal is n, against the face of b that looks at it.
std::vector<ContactPoint> face_contacts(const Box& a, const Frame& frame_a, std::size_t axis, const Point& n, const Box& b,
                                        const Frame& frame_b, double margin) {
  std::vector<Vertex> polygon = face_against(b, frame_b, n);
  for (std::int32_t side = 0; side < 4; ++side) {
    const std::size_t across = (axis + 1 + static_cast<std::size_t>(side / 2)) % 3;
    const Point outward = (side % 2 == 0 ? -1.0 : 1.0) * frame_a.axis(across);
    polygon = clipped(polygon, outward, dot(outward, frame_a.origin) + a.half_extent[across], 4 + side);
  }
  std::vector<ContactPoint> found;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vertex& at = polygon[i];
    const Vertex& before = polygon[(i + polygon.size() - 1) % polygon.size()];
    const double gap = dot(n, at.point - frame_a.origin) - a.half_extent[axis];
    // a corner of a convex polygon is named by the two edges that meet in it
    if (gap <= margin) found.push_back({at.point - 0.5 * gap * n, n, gap, 8 * before.edge + at.edge});
  }
  return found;
}

/// The middle of the edge along `axis` that reaches farthest along n.
Point edge_towards(const Box& box, const Frame& frame, std::size_t axis, const Point& n) {
  Point middle = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    if (i != axis) middle[i] = dot(frame.axis(i), n) < 0 ? -box.half_extent[i] : box.half_extent[i];
  return frame.to_world(middle);
}

ContactPoint edge_contact(const Box& a, const Frame& frame_a, const Box& b, const Frame& frame_b, const Separation& by) {
  const Point u = frame_a.axis(by.axis_a), v = frame_b.axis(by.axis_b);
  const Point p = edge_towards(a, frame_a, by.axis_a, by.normal), q = edge_towards(b, frame_b, by.axis_b, -1.0 * by.normal);
  // p + s u is the point of a's edge nearest to b's
  const double uv = dot(u, v);
  const double s = (dot(q - p, u) - uv * dot(q - p, v)) / (1 - uv * uv);
  const auto feature = static_cast<std::int32_t>(64 + 3 * by.axis_a + by.axis_b);
  return {p + s * u + 0.5 * by.gap * by.normal, by.normal, by.gap, feature};
}

}  // namespace

Point corner(const Box& box, std::size_t index) {
  const Point& e = box.half_extent;
  return {index & 4 ? e[0] : -e[0], index & 2 ? e[1] : -e[1], index & 1 ? e[2] : -e[2]};
}

std::vector<ContactPoint> contacts(const Plane& a, const Frame& frame_a, const Box& b, const Frame& frame_b, double margin) {
  const Point n = frame_a.rotation * a.normal;
  std::vector<ContactPoint> found;
  for (std::size_t index = 0; index < 8; ++index) {
    const Point at = frame_b.to_world(corner(b, index));
    const double gap = dot(n, at - frame_a.origin) - a.offset;
    if (gap <= margin) found.push_back({at - 0.5 * gap * n, n, gap, static_cast<std::int32_t>(index)});
  }
  return found;
}

std::vector<ContactPoint> contacts(const Box& a, const Frame& frame_a, const Box& b, const Frame& frame_b, double margin) {
  const Separation by = widest_separation(a, frame_a, b, frame_b);
  if (by.gap > margin) return {};
  if (by.axis_a < 3 && by.axis_b < 3) return {edge_contact(a, frame_a, b, frame_b, by)};
  if (by.axis_a < 3) return face_contacts(a, frame_a, by.axis_a, by.normal, b, frame_b, margin);
  std::vector<ContactPoint> found = face_contacts(b, frame_b, by.axis_b, -1.0 * by.normal, a, frame_a, margin);
  for (ContactPoint& contact : found) {
    contact = reversed(contact);
    contact.feature += 128;
  }
  return found;
}

}  // namespace scenes
