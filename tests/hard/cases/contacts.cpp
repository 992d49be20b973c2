// Angles and scales: rows that nearly depend on each other, rows of lengths far apart, numbers at the ends of the range.
#include <cmath>

#include "hard/cases/sketch.h"
#include "scenes/scenes.h"

namespace hard {
namespace {

const std::vector<double> angles{1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};

/// The power of two next to it, so that 1 ± angle is exact.
double binary(double angle) { return std::exp2(std::round(std::log2(angle))); }

/// A point pressed down against two planes an angle apart.
Case pressed(double angle) {
  const double d = binary(angle);
  Sketch s;
  s.body(2, 1);
  s.momentum({0, -10});
  s.row({{0, d}, {1, 1}}, 1);
  s.row({{0, -d}, {1, 1}}, 1);
  return {s.take(), Fate::solved, {0, 1}, 2e-11 / d};
}

/// Two joints whose directions are an angle apart hold a point at (1, 1).
Case nearly_parallel_joints(double angle) {
  const double d = binary(angle);
  Sketch s;
  s.body(2, 1);
  s.momentum({0, 0});
  s.row({{0, d}, {1, 1}}, 1 + d, bilateral);
  s.row({{0, -d}, {1, 1}}, 1 - d, bilateral);
  return {s.take(), Fate::solved, {1, 1}, 4e-12 / d};
}

/// Pushed down into a wedge of two walls that face each other: the walls push with 1 / (2 angle).
Case narrow_wedge(double angle) {
  const double d = binary(angle);
  Sketch s;
  s.body(2, 1);
  s.momentum({0, -1});
  s.row({{0, 1}, {1, d}});
  s.row({{0, -1}, {1, d}});
  return {s.take(), Fate::solved, {0, 0}};
}

/// The walls of the wedge close at 1 m/s each: what is between them leaves at 1 / angle.
Case closing_wedge(double angle) {
  const double d = binary(angle);
  Sketch s;
  s.body(2, 1);
  s.momentum({0, -1});
  s.row({{0, 1}, {1, d}}, 1);
  s.row({{0, -1}, {1, d}}, 1);
  return {s.take(), Fate::solved, {0, 1 / d}};
}

/// A wall whose rows have lengths 10^p and 10^−p in turn.
Case row_lengths(double power) {
  const double scale = std::exp2(std::round(power * std::log2(10.0)));
  return {with_rows(scenes::wall(3, 3), {scale, 1 / scale, 1}, 1)};
}

/// One row of length 10^p pushes a body of 1 kg to 1 m/s.
Case length_at_the_ends(double power) {
  const double x = std::pow(10.0, power);
  Sketch s;
  s.body(1, 1);
  s.momentum({0});
  s.row({{0, x}}, x);
  return {s.take(), Fate::solved, {1}};
}

/// All masses and momenta times 10^p.
Case mass_at_the_ends(double power) {
  const double x = std::pow(10.0, power);
  Sketch s;
  s.body(1, x);
  s.body(1, x);
  s.momentum({-x, 0});
  s.row({{0, 1}, {1, -1}});
  s.row({{0, 1}, {1, 1}}, -0.5, bilateral);
  return {s.take(), Fate::solved, {-0.25, -0.25}};
}

/// Boxes of all kinds, a body each: both bounds, one, lo = hi, and bounds far away.
Case boxes(double far) {
  Sketch s;
  struct Motor {
    double r, lo, hi, v;
  };
  const Motor motors[] = {{2, -1, 1, 1},  {-2, -1, 1, -1}, {0.5, -1, 1, 0.5},   {3, 0.25, 0.25, 0.25}, {-3, 0.25, 0.25, 0.25},
                          {1, 0, inf, 1}, {1, -inf, 0, 0}, {-1, -inf, 0, -1},   {5, -far, far, 5},     {-5, 0, far, 0},
                          {7, 0, 0, 0},   {2, 1, inf, 2},  {0.5, 1, inf, 1.0}};
  std::vector<double> v;
  for (const Motor& motor : motors) {
    const auto first = s.body(1, 1);
    s.row({{first, 1}}, motor.r, {motor.lo, motor.hi});
    v.push_back(motor.v);
  }
  return {s.take(), Fate::solved, v};
}

}  // namespace

std::vector<Family> contact_families() {
  return {{"point on two planes", "angle", angles, pressed},
          {"two joints", "angle", angles, nearly_parallel_joints},
          {"narrow wedge", "angle", angles, narrow_wedge},
          {"closing wedge", "angle", angles, closing_wedge},
          {"wall, rows of length 10^±p", "p", {0, 1, 2, 4, 6, 8}, row_lengths},
          {"one row of length 10^p", "p", {-300, -200, -150, -100, -20, 0, 20, 100, 150, 200, 300}, length_at_the_ends},
          {"masses of 10^p", "p", {-300, -150, -20, 0, 20, 150, 300}, mass_at_the_ends},
          {"motors", "far bound", {10, 1e8, 1e100, 1e300}, boxes}};
}

}  // namespace hard
