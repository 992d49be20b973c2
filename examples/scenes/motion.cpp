#include "motion.h"

namespace scenes {

std::vector<std::size_t> coordinates(Motion motion) {
  switch (motion) {
    case Motion::Upright: return {0, 2, 4};
    case Motion::Flat: return {0, 1, 5};
    case Motion::Space: break;
  }
  return {0, 1, 2, 3, 4, 5};
}

Twist rate_along(const Point& n, const Point& arm) {
  const Point turn = cross(arm, n);
  return {n[0], n[1], n[2], turn[0], turn[1], turn[2]};
}

Twist rate_about(const Point& n) { return {0, 0, 0, n[0], n[1], n[2]}; }

Twist operator-(const Twist& twist) {
  return {-twist[0], -twist[1], -twist[2], -twist[3], -twist[4], -twist[5]};
}

}  // namespace scenes
