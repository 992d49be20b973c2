// Mass ratios, long chains, redundant contacts and joints, step sizes: what engines are given every day.
#include <cmath>

#include "hard/cases/sketch.h"
#include "scenes/scenes.h"

namespace hard {
namespace {

const std::vector<double> mass_ratios{1e2, 1e4, 1e6, 1e8, 1e10, 1e12};
const std::vector<double> multiples{1, 2, 5, 10, 20, 50};

Case heavy_top(double ratio) { return {scenes::tower(10, ratio)}; }

Case heavy_end(double ratio) { return {scenes::chain(100, true, ratio)}; }

Case long_chain(double links) { return {scenes::chain(static_cast<int>(links), true, 1e4)}; }

/// Light and heavy cubes in turn, as two bodies a velocity each: the light ones carry what the heavy ones need.
Case sandwich(double ratio) {
  Sketch s;
  const int layers = 20;
  std::vector<double> k;
  for (int i = 0; i < layers; ++i) {
    const double mass = i % 2 ? ratio : 1;
    s.body(1, mass);
    k.push_back(-mass);
  }
  s.momentum(k);
  for (int i = 0; i < layers; ++i)
    if (i == 0) s.row({{0, 1}});
    else s.row({{i - 1, -1}, {i, 1}});
  return {s.take(), Fate::solved, std::vector<double>(layers, 0.0)};
}

/// A table on `legs` legs on a circle: three carry it, all of them hold.
Case table(double legs) {
  Sketch s;
  const double radius = 0.5;
  s.body({10, 1, 1});  // height, two tilts
  s.momentum({-0.981, 0, 0});
  for (int i = 0; i < static_cast<int>(legs); ++i) {
    const double angle = 2 * std::acos(-1.0) * i / legs;
    s.row({{0, 1}, {1, radius * std::cos(angle)}, {2, radius * std::sin(angle)}});
  }
  return {s.take(), Fate::solved, {0, 0, 0}};
}

/// Every contact of a wall as often as that.
Case repeated_contacts(double copies) { return {with_rows(scenes::wall(3, 4), {1}, static_cast<int>(copies))}; }

/// A bar on parallel rockers, pinned at both ends: from the third on the joints of a rocker say nothing new.
Case rockers(double count) {
  Sketch s;
  const int rockers = static_cast<int>(count);
  const double lean = 0.6, rise = 0.8, spacing = 0.25;
  const auto coupler = s.body({5, 5, 2});
  std::vector<double> k{0, -5 * 0.0981, 0};
  for (int i = 0; i < rockers; ++i) {
    const auto b = s.body({1, 1, 1.0 / 12});
    k.insert(k.end(), {0, -0.0981, 0});
    // v + ω × arm at both ends, arms ∓(lean, rise)/2; the coupler's arm is (spacing (i − middle), 0)
    s.row({{b, 1}, {b + 2, rise / 2}}, 0, bilateral);
    s.row({{b + 1, 1}, {b + 2, -lean / 2}}, 0, bilateral);
    s.row({{b, 1}, {b + 2, -rise / 2}, {coupler, -1}}, 0, bilateral);
    s.row({{b + 1, 1}, {b + 2, lean / 2}, {coupler + 1, -1}, {coupler + 2, -spacing * (i - 0.5 * (rockers - 1))}}, 0, bilateral);
  }
  s.momentum(k);
  return {s.take()};
}

Case step_size(double h) {
  scenes::Pile pile(100);
  return {scenes::Scene::problem_of_step(std::move(pile), h)};
}

/// Equal bricks, equal gaps: every choice of the method is a tie.
Case ties(double bricks) { return {scenes::wall(static_cast<int>(bricks), static_cast<int>(bricks))}; }

}  // namespace

std::vector<Family> multibody_families() {
  return {{"tower, heavy top", "mass ratio", mass_ratios, heavy_top},
          {"chain of 100, heavy end", "mass ratio", mass_ratios, heavy_end},
          {"light under heavy, 20 layers", "mass ratio", mass_ratios, sandwich},
          {"chain, end of 10 t", "links", {10, 100, 1000, 10000}, long_chain},
          {"table", "legs", {3, 4, 6, 12, 30, 60, 150}, table},
          {"wall, contacts repeated", "copies", multiples, repeated_contacts},
          {"parallel rockers", "rockers", {2, 3, 5, 10, 20, 50}, rockers},
          {"pile of 100 spheres", "step in s", {1e-5, 1e-4, 1e-3, 1e-2, 1e-1}, step_size},
          {"wall of equal bricks", "bricks a side", {1, 2, 4, 8}, ties}};
}

}  // namespace hard
