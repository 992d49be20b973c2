#include "pile.h"

#include <algorithm>
#include <utility>

namespace scenes {
namespace {

constexpr double density = 1000;  // kg/m³
constexpr double pi = 3.14159265358979323846;

double mass_of(double radius) { return density * 4 / 3 * pi * radius * radius * radius; }

std::vector<double> mass_blocks(const Packing& packing) {
  std::vector<double> blocks;
  for (const double radius : packing.radius) {
    const double m = mass_of(radius);
    blocks.insert(blocks.end(), {m, 0, 0, 0, m, 0, 0, 0, m});
  }
  return blocks;
}

/// A sphere near another one or near a wall. normal points at b, the direction in which b moves away.
struct Touch {
  std::int32_t a, b, feature;
  Point normal;
  double gap;
};

std::vector<Touch> touches(const Packing& packing, double margin) {
  std::vector<Touch> found;
  const auto near = [&](Touch touch) {
    if (touch.gap <= margin) found.push_back(touch);
  };
  for (std::size_t i = 0; i < packing.centre.size(); ++i) {
    const Point& p = packing.centre[i];
    const double r = packing.radius[i];
    const auto b = static_cast<std::int32_t>(i);
    near({MLCP_WORLD, b, 0, {0, 0, 1}, p[2] - r});
    near({MLCP_WORLD, b, 1, {1, 0, 0}, p[0] - r});
    near({MLCP_WORLD, b, 2, {-1, 0, 0}, packing.side - p[0] - r});
    near({MLCP_WORLD, b, 3, {0, 1, 0}, p[1] - r});
    near({MLCP_WORLD, b, 4, {0, -1, 0}, packing.side - p[1] - r});
  }
  for (const auto& [a, b] : near_pairs(packing.centre, 2 * largest_radius + margin)) {
    const Point& p = packing.centre[static_cast<std::size_t>(a)];
    const Point& q = packing.centre[static_cast<std::size_t>(b)];
    const Point d = q - p;
    const double distance = length(d);
    const double reach = packing.radius[static_cast<std::size_t>(a)] + packing.radius[static_cast<std::size_t>(b)];
    near({a, b, 0, 1 / distance * d, distance - reach});
  }
  return found;
}

}  // namespace

Pile::Pile(std::int32_t spheres, unsigned seed) : Pile(settle_spheres(spheres, seed)) {}

Pile::Pile(Packing&& packing) : Scene(3, mass_blocks(packing)), packing_(std::move(packing)) {}

void Pile::limit_contacts(std::int32_t count) {
  std::vector<double> gaps;
  for (const Touch& touch : touches(packing_, 2 * mean_radius)) gaps.push_back(touch.gap);
  if (gaps.empty() || count < 1) return;
  const std::size_t rank = std::min(gaps.size(), static_cast<std::size_t>(count)) - 1;
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(rank), gaps.end());
  margin_ = gaps[rank];
}

void Pile::add_rows(RowList& rows) const {
  for (const Touch& touch : touches(packing_, margin_)) {
    const Point& n = touch.normal;
    rows.add(RowKind::Contact, touch.a, touch.b, {-n[0], -n[1], -n[2]}, {n[0], n[1], n[2]}, touch.gap, touch.feature);
  }
}

void Pile::add_forces(std::span<double> force) const {
  for (std::size_t i = 0; i < packing_.radius.size(); ++i) force[3 * i + 2] -= gravity * mass_of(packing_.radius[i]);
}

void Pile::advance(double h, std::span<const double> v) {
  for (std::size_t i = 0; i < packing_.centre.size(); ++i) {
    packing_.centre[i] = packing_.centre[i] + h * Point{v[3 * i], v[3 * i + 1], v[3 * i + 2]};
  }
}

double Pile::potential_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < packing_.centre.size(); ++i) sum += gravity * mass_of(packing_.radius[i]) * packing_.centre[i][2];
  return sum;
}

void Pile::draw(Drawing& to) const {
  for (std::size_t i = 0; i < packing_.centre.size(); ++i) to.spheres.push_back({packing_.centre[i], packing_.radius[i]});
  const double s = packing_.side;
  to.paths.push_back({{0, 0, 0}, {s, 0, 0}, {s, s, 0}, {0, s, 0}, {0, 0, 0}});
  for (const Touch& touch : touches(packing_, margin_)) {
    const auto b = static_cast<std::size_t>(touch.b);
    to.actions.push_back({packing_.centre[b] - packing_.radius[b] * touch.normal, touch.normal});
  }
}

Problem pile(int contacts, unsigned seed) {
  Pile scene(std::max(1, contacts / 3), seed);
  scene.limit_contacts(contacts);
  return Scene::problem_of_step(std::move(scene));
}

}  // namespace scenes
