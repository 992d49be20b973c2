#include "chain.h"

#include <cmath>
#include <utility>

#include "random.h"

namespace scenes {
namespace {

constexpr double link_length = 0.1;      // m
constexpr double link_mass = 1;          // kg
constexpr double largest_gap = 3e-4;     // m; free fall onto the slope closes 2.7e-4 in a step of 0.01 s
constexpr double along[2] = {0.28, -0.96};  // down the slope, exactly of length 1
constexpr double normal[2] = {0.96, 0.28};  // away from it

/// A vector fixed in the link, turned into the world's frame.
struct Arm {
  double x, y;
  Arm(double local_x, double local_y, double angle)
      : x(std::cos(angle) * local_x - std::sin(angle) * local_y), y(std::sin(angle) * local_x + std::cos(angle) * local_y) {}
};

}  // namespace

Chain::Links Chain::on_slope(std::int32_t count, bool contacts, double mass_ratio, unsigned seed) {
  Random random(seed);
  Links links;
  double upper[2] = {0, 0};
  for (std::int32_t i = 0; i < count; ++i) {
    const double gap = contacts ? random.uniform(0, largest_gap) : 0;
    double lower[2], half[2];
    for (int axis = 0; axis < 2; ++axis) {
      lower[axis] = (i + 1) * link_length * along[axis] + gap * normal[axis];
      half[axis] = 0.5 * (lower[axis] - upper[axis]);
    }
    const double mass = i + 1 == count ? mass_ratio * link_mass : link_mass;
    links.push_back({upper[0] + half[0], upper[1] + half[1], 0, half[0], half[1], mass});
    upper[0] = lower[0];
    upper[1] = lower[1];
  }
  return links;
}

std::vector<double> Chain::mass_blocks(const Links& links) {
  std::vector<double> blocks;
  for (const Link& link : links) {
    const double m = link.mass;
    const double inertia = m / 3 * (link.half_x * link.half_x + link.half_y * link.half_y);  // slender rod: m l²/12
    blocks.insert(blocks.end(), {m, 0, 0, 0, m, 0, 0, 0, inertia});
  }
  return blocks;
}

Chain::Chain(std::int32_t links, bool contacts, double mass_ratio, unsigned seed)
    : Chain(on_slope(links, contacts, mass_ratio, seed), contacts) {}

Chain::Chain(Links&& links, bool contacts) : Scene(3, mass_blocks(links)), links_(std::move(links)), contacts_(contacts) {}

void Chain::add_rows(RowList& rows) const {
  double pin[2] = {0, 0};  // where the link above ends
  Arm above(0, 0, 0);
  for (std::int32_t b = 0; b < static_cast<std::int32_t>(links_.size()); ++b) {
    const std::int32_t a = b == 0 ? MLCP_WORLD : b - 1;
    const Link& link = links_[static_cast<std::size_t>(b)];
    const Arm lower(link.half_x, link.half_y, link.angle), upper(-link.half_x, -link.half_y, link.angle);
    rows.add(RowKind::Joint, a, b, {-1, 0, above.y}, {1, 0, -upper.y}, link.x + upper.x - pin[0], 0);
    rows.add(RowKind::Joint, a, b, {0, -1, -above.x}, {0, 1, upper.x}, link.y + upper.y - pin[1], 1);
    pin[0] = link.x + lower.x;
    pin[1] = link.y + lower.y;
    above = lower;
    if (!contacts_) continue;
    rows.add(RowKind::Contact, MLCP_WORLD, b, {}, {normal[0], normal[1], lower.x * normal[1] - lower.y * normal[0]},
             normal[0] * pin[0] + normal[1] * pin[1], 2);
  }
}

void Chain::add_forces(std::span<double> force) const {
  for (std::size_t i = 0; i < links_.size(); ++i) force[3 * i + 1] -= gravity * links_[i].mass;
}

void Chain::advance(double h, std::span<const double> v) {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    links_[i].x += h * v[3 * i];
    links_[i].y += h * v[3 * i + 1];
    links_[i].angle += h * v[3 * i + 2];
  }
}

double Chain::potential_energy() const {
  double sum = 0;
  for (const Link& link : links_) sum += gravity * link.mass * link.y;
  return sum;
}

void Chain::draw(Drawing& to) const {
  Drawing::Path& chain = to.paths.emplace_back(Drawing::Path{{0, 0, 0}});
  Point pin = {0, 0, 0};
  for (const Link& link : links_) {
    to.actions.push_back({pin, {1, 0, 0}});
    to.actions.push_back({pin, {0, 0, 1}});
    const Arm lower(link.half_x, link.half_y, link.angle);
    pin = {link.x + lower.x, 0, link.y + lower.y};
    chain.push_back(pin);
    if (contacts_) to.actions.push_back({pin, {normal[0], 0, normal[1]}});
  }
  const double length = link_length * static_cast<double>(links_.size());
  if (contacts_) to.paths.push_back({{0, 0, 0}, {length * along[0], 0, length * along[1]}});
}

Problem chain(int links, bool contacts, double mass_ratio) {
  return Scene::problem_of_step(Chain(links, contacts, mass_ratio));
}

}  // namespace scenes
