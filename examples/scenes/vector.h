#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace scenes {

using Point = std::array<double, 3>;

inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

constexpr Point axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

inline Point unit(const Point& a) { return 1 / length(a) * a; }

/// A unit vector at right angles to the unit vector n.
inline Point perpendicular(const Point& n) {
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::fabs(n[axis]) < std::fabs(n[least])) least = axis;
  return unit(cross(n, axes[least]));
}

/// A rotation as a unit quaternion w + (x, y, z).
struct Rotation {
  double w = 1;
  Point xyz = {0, 0, 0};

  /// About a unit vector, right-handed, in rad.
  static Rotation about(const Point& axis, double angle) { return {std::cos(0.5 * angle), std::sin(0.5 * angle) * axis}; }

  Point operator*(const Point& a) const {
    const Point t = 2.0 * cross(xyz, a);
    return a + w * t + cross(xyz, t);
  }
  /// This one after `first`.
  Rotation operator*(const Rotation& first) const {
    return {w * first.w - dot(xyz, first.xyz), w * first.xyz + first.w * xyz + cross(xyz, first.xyz)};
  }
  Rotation inverse() const { return {w, -1.0 * xyz}; }
  /// q ← q + h/2 ω q, to unit length again; ω in the world's frame.
  void advance(double h, const Point& omega) {
    const double w_new = w - 0.5 * h * dot(omega, xyz);
    const Point xyz_new = xyz + 0.5 * h * (w * omega + cross(omega, xyz));
    const double scale = 1 / std::sqrt(w_new * w_new + dot(xyz_new, xyz_new));
    w = scale * w_new;
    xyz = scale * xyz_new;
  }
};

/// Where something stands and how it is turned.
struct Frame {
  Point origin = {0, 0, 0};
  Rotation rotation = {};

  Point to_world(const Point& local) const { return origin + rotation * local; }
  Point to_local(const Point& world) const { return rotation.inverse() * (world - origin); }
  Point axis(std::size_t i) const { return rotation * axes[i]; }
  /// A frame that is given in this one.
  Frame operator*(const Frame& local) const { return {to_world(local.origin), rotation * local.rotation}; }
  /// A frame of the world as seen from this one.
  Frame seen(const Frame& world) const { return {to_local(world.origin), rotation.inverse() * world.rotation}; }
};

}  // namespace scenes
