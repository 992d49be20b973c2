#include "rope.h"

#include <cmath>
#include <utility>

#include "random.h"

namespace scenes {
namespace {

constexpr double node_mass = 0.01;      // kg
constexpr double link_length = 0.02;    // m, as laid out; jitter changes it a little
constexpr double peg_radius = 0.05;     // m; the centres lie on the ground
constexpr double peg_distance = 0.4;    // m
constexpr double largest_lift = 1.5e-3; // m; free fall closes 9.8e-4 in a step of 0.01 s
constexpr double largest_speed = 0.05;  // m/s

struct Surface {
  double normal_x, normal_y, gap;
  bool peg;
};

/// The nearer of the ground and the nearest peg, seen from (x, y).
Surface nearest_surface(double x, double y) {
  const double dx = x - peg_distance * (std::floor(x / peg_distance) + 0.5);
  const double distance = std::sqrt(dx * dx + y * y);
  if (distance - peg_radius <= y && distance > 0) return {dx / distance, y / distance, distance - peg_radius, true};
  return {0, 1, y, false};
}

std::vector<double> mass_blocks(std::int32_t nodes) {
  std::vector<double> blocks;
  for (std::int32_t i = 0; i < nodes; ++i) blocks.insert(blocks.end(), {node_mass, 0, 0, node_mass});
  return blocks;
}

}  // namespace

Rope::Rope(std::int32_t links, unsigned seed) : Scene(2, mass_blocks(links + 1)) {
  Random random(seed);
  double x = 0, y = 0;  // walks along the surface
  for (std::int32_t i = 0; i <= links; ++i) {
    const Surface at = nearest_surface(x, y);
    const double lift = random.uniform(0, largest_lift);
    nodes_.push_back({x + lift * at.normal_x, y + lift * at.normal_y});
    for (double& v : velocity(i)) v = random.uniform(-largest_speed, largest_speed);
    // a step along the tangent, then back onto the surface
    x += link_length * at.normal_y;
    y = std::fmax(0, y - link_length * at.normal_x);
    const Surface next = nearest_surface(x, y);
    x -= next.gap * next.normal_x;
    y -= next.gap * next.normal_y;
  }
  for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
    const double dx = nodes_[i + 1].x - nodes_[i].x, dy = nodes_[i + 1].y - nodes_[i].y;
    rest_length_.push_back(std::sqrt(dx * dx + dy * dy));
  }
}

void Rope::add_rows(RowList& rows) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto body = static_cast<std::int32_t>(i);
    const Node& node = nodes_[i];
    const Surface at = nearest_surface(node.x, node.y);
    rows.add(RowKind::Contact, MLCP_WORLD, body, {}, {at.normal_x, at.normal_y}, at.gap, at.peg ? 1 : 0);
    if (i + 1 == nodes_.size()) break;
    const double dx = nodes_[i + 1].x - node.x, dy = nodes_[i + 1].y - node.y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    const double x = dx / distance, y = dy / distance;
    rows.add(RowKind::Joint, body, body + 1, {-x, -y}, {x, y}, distance - rest_length_[i], 0);
  }
}

void Rope::add_forces(std::span<double> force) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) force[2 * i + 1] -= gravity * node_mass;
}

void Rope::advance(double h, std::span<const double> v) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].x += h * v[2 * i];
    nodes_[i].y += h * v[2 * i + 1];
  }
}

double Rope::potential_energy() const {
  double sum = 0;
  for (const Node& node : nodes_) sum += gravity * node_mass * node.y;
  return sum;
}

void Rope::draw(Drawing& to) const {
  const auto in_space = [](double x, double y) { return Point{x, 0, y}; };
  Drawing::Path& rope = to.paths.emplace_back();
  for (const Node& node : nodes_) rope.push_back(in_space(node.x, node.y));
  const double end = nodes_.back().x;
  to.paths.push_back({in_space(nodes_.front().x, 0), in_space(end, 0)});
  for (double x = 0.5 * peg_distance; x < end; x += peg_distance) to.spheres.push_back({in_space(x, 0), peg_radius});
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const Surface at = nearest_surface(node.x, node.y);
    to.actions.push_back({in_space(node.x, node.y), in_space(at.normal_x, at.normal_y)});
    if (i + 1 == nodes_.size()) break;
    const double dx = nodes_[i + 1].x - node.x, dy = nodes_[i + 1].y - node.y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    to.actions.push_back({in_space(node.x + dx / 2, node.y + dy / 2), in_space(dx / distance, dy / distance)});
  }
}

Problem rope(int links, unsigned seed) { return Scene::problem_of_step(Rope(links, seed)); }

}  // namespace scenes
