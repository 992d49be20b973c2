// Coulomb's friction where it sticks, slides and jams.
#include <cmath>

#include "hard/cases/sketch.h"

namespace hard {
namespace {

const std::vector<double> coefficients{0, 0.1, 0.3, 0.5, 0.577, 0.578, 0.8, 1, 1.5, 2};
constexpr double g_h = 0.0981;  // of a step of 0.01 s

/// A point on a plane of 30°, in space: it slides with g h (sin − µ cos) or sticks.
Case slope(double mu) {
  const double s30 = 0.5, c30 = std::sqrt(0.75);
  Sketch s;
  s.body(3, 2);
  s.momentum({0, 0, -2 * g_h});
  const auto row = s.row({{0, s30}, {2, c30}});
  s.row({{0, c30}, {2, -s30}}, 0, bilateral);
  s.row({{1, 1}}, 0, bilateral);
  s.coulomb(row, 3, mu);
  const double along = std::min(0.0, -(s30 - mu * c30) * g_h);
  return {s.take(), Fate::solved, {-along * c30, 0, along * s30}, 1e-9};
}

/// A disc in a groove of two planes at ±45°, pushed along both: µ up to 2, where it can jam.
Case wedge(double mu) {
  const double c = std::sqrt(0.5);
  Sketch s;
  s.body({1, 1, 0.5});
  s.momentum({0.3, -1, 0.2});
  for (const double side : {1.0, -1.0}) {
    const auto row = s.row({{0, side * c}, {1, c}});
    s.row({{0, -c}, {1, side * c}, {2, 1}}, 0, bilateral);
    s.coulomb(row, 2, mu);
  }
  return {s.take()};
}

/// Painlevé's rod: its tip slides on the floor against its lean. Beyond µ = 4/3 no acceleration fits, an impulse always does.
Case painleve(double mu) {
  const double half = 1, mass = 1, inertia = mass * half * half / 3, angle = 1.1;
  const double x = half * std::cos(angle), y = half * std::sin(angle);
  Sketch s;
  s.body({mass, mass, inertia});
  s.momentum({3, -g_h, 0});
  const auto row = s.row({{1, 1}, {2, x}});        // tip at (x, −y) of the centre
  s.row({{0, 1}, {2, y}}, 0, bilateral);
  s.coulomb(row, 2, mu);
  return {s.take()};
}

/// A box on four corners, thrown along and around: which corner sticks is not told by symmetry.
Case spun_box(double mu) {
  Sketch s;
  s.body({1, 1, 1, 0.1, 0.1, 0.15});
  s.momentum({0.2, 0.05, -g_h, 0.01, 0, 0.1});
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) {
      const double z = -0.25;  // v + ω × (x, y, z)
      const auto row = s.row({{2, 1}, {3, y}, {4, -x}});
      s.row({{0, 1}, {4, z}, {5, -y}}, 0, bilateral);
      s.row({{1, 1}, {3, -z}, {5, x}}, 0, bilateral);
      s.coulomb(row, 3, mu);
    }
  return {s.take()};
}

}  // namespace

std::vector<Family> friction_families() {
  return {{"slope of 30 degrees", "friction", coefficients, slope},
          {"groove", "friction", coefficients, wedge},
          {"Painleve's rod", "friction", coefficients, painleve},
          {"box thrown and spun", "friction", coefficients, spun_box}};
}

}  // namespace hard
