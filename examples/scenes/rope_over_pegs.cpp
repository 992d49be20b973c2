#include "rope_over_pegs.h"

#include <cmath>

#include "geometry/sphere_contacts.h"

namespace scenes {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr Sphere peg = {0.15}, strand = {0.015}, weight = {0.06};
constexpr double apart = 0.8;       // of the pegs, m
constexpr double density = 1;       // of the rope, kg/m
constexpr double weight_mass = 1;
constexpr double margin = 0.01;     // contacts are listed up to this gap, m
constexpr Plane ground = {axes[2], -1.1};
constexpr Point pegs[2] = {{-0.5 * apart, 0, 0}, {0.5 * apart, 0, 0}};

/// The point at arc length s of the rope's middle line: down, over the pegs, down.
Point on_rope(double s, double hanging) {
  const double radius = peg.radius + strand.radius, quarter = 0.5 * pi * radius;
  if (s < hanging) return pegs[0] + Point{-radius, 0, s - hanging};
  s -= hanging;
  if (s < quarter) return pegs[0] + radius * Point{-std::cos(s / radius), 0, std::sin(s / radius)};
  s -= quarter;
  if (s < apart) return pegs[0] + Point{s, 0, radius};
  s -= apart;
  if (s < quarter) return pegs[1] + radius * Point{std::sin(s / radius), 0, std::cos(s / radius)};
  return pegs[1] + Point{radius, 0, quarter - s};
}

std::vector<RigidBody> bodies_of(std::int32_t links, double heavy) {
  const double over = pi * (peg.radius + strand.radius) + apart, hanging = 0.5 * over;
  std::vector<RigidBody> bodies;
  for (std::int32_t i = 0; i < links; ++i)
    bodies.push_back(solid(strand, density * (over + 2 * hanging) / links, {on_rope((over + 2 * hanging) * (i + 0.5) / links, hanging)}));
  // the weights hang from the ends
  bodies.insert(bodies.begin(), solid(weight, weight_mass, {bodies.front().frame.origin - Point{0, 0, weight.radius + strand.radius}}));
  bodies.push_back(solid(weight, heavy * weight_mass, {bodies.back().frame.origin - Point{0, 0, weight.radius + strand.radius}}));
  return bodies;
}

}  // namespace

RopeOverPegs::RopeOverPegs(std::int32_t links, double heavy, double friction)
    : RigidScene(Motion::Upright, bodies_of(links, heavy)), friction_(friction) {
  for (std::int32_t i = 0; i <= links; ++i) length_.push_back(scenes::length(frame(i + 1).origin - frame(i).origin));
}

void RopeOverPegs::add_rows(RowList& rows) const {
  for (std::int32_t i = 0; i + 1 < static_cast<std::int32_t>(bodies().size()); ++i) {
    const Point across = frame(i + 1).origin - frame(i).origin;
    const Twist along = rate_along(unit(across), {0, 0, 0});
    add_row(rows, RowKind::Joint, i, i + 1, -along, along, scenes::length(across) - length_[static_cast<std::size_t>(i)], 0,
            {0.5 * (frame(i).origin + frame(i + 1).origin), unit(across)});
  }
}

void RopeOverPegs::add_contacts(ContactList& contacts) const {
  const Material hemp = {.friction = friction_};
  const auto count = static_cast<std::int32_t>(bodies().size());
  for (std::int32_t i = 1; i + 1 < count; ++i)
    for (std::int32_t p = 0; p < 2; ++p) {
      ContactPoint at = contact(peg, pegs[p], strand, frame(i).origin);
      at.feature = p;
      at.point = frame(i).origin;
      if (at.gap <= margin) add_contact(contacts, MLCP_WORLD, i, at, hemp);
    }
  for (const std::int32_t end : {0, count - 1}) {
    ContactPoint at = contact(ground, {}, weight, frame(end).origin);
    at.point = frame(end).origin;
    if (at.gap <= 0.1) add_contact(contacts, MLCP_WORLD, end, at, hemp);
  }
}

void RopeOverPegs::draw(Drawing& to) const {
  to.eye = {0, -1, 0};
  Drawing::Path line;
  for (const RigidBody& body : bodies()) line.push_back(body.frame.origin);
  to.paths.push_back(line);
  to.paths.push_back({{-1, 0, ground.offset}, {1, 0, ground.offset}});
  for (const Point& place : pegs) to.spheres.push_back({place, peg.radius, Drawing::Role::Ground});
  for (const RigidBody* body : {&bodies().front(), &bodies().back()})
    to.spheres.push_back({body->frame.origin, weight.radius, Drawing::Role::Product});
  draw_actions(to);
}

}  // namespace scenes
