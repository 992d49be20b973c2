#pragma once
#include <array>
#include <cmath>

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

/// A rotation as a unit quaternion w + (x, y, z).
struct Rotation {
  double w = 1;
  Point xyz = {0, 0, 0};

  Point operator*(const Point& a) const {
    const Point t = 2.0 * cross(xyz, a);
    return a + w * t + cross(xyz, t);
  }
  /// q ← q + h/2 ω q, to unit length again; ω in the world's frame.
  void advance(double h, const Point& omega) {
    const double w_new = w - 0.5 * h * dot(omega, xyz);
    const Point xyz_new = xyz + 0.5 * h * (w * omega + cross(omega, xyz));
    const double scale = 1 / std::sqrt(w_new * w_new + dot(xyz_new, xyz_new));
    w = scale * w_new;
    xyz = scale * xyz_new;
  }
};

}  // namespace scenes
