#include "rigid_scene.h"

#include <algorithm>
#include <utility>

namespace scenes {
namespace {

/// diag(m, m, m, Σ Iₖ eₖ eₖᵀ) with the body's axes eₖ in the world's frame, the coordinates that move.
std::vector<double> mass_block(const RigidBody& body, std::span<const std::size_t> coordinates) {
  std::array<Twist, 6> whole = {};
  for (std::size_t i = 0; i < 3; ++i) whole[i][i] = body.mass;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point e = body.frame.axis(k);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) whole[3 + i][3 + j] += body.inertia[k] * (e[i] * e[j]);
    }
  }
  std::vector<double> block;
  for (const std::size_t i : coordinates)
    for (const std::size_t j : coordinates) block.push_back(whole[i][j]);
  return block;
}

std::vector<double> mass_blocks(std::span<const RigidBody> bodies, std::span<const std::size_t> coordinates) {
  std::vector<double> blocks;
  for (const RigidBody& body : bodies) {
    const std::vector<double> block = mass_block(body, coordinates);
    blocks.insert(blocks.end(), block.begin(), block.end());
  }
  return blocks;
}

}  // namespace

RigidScene::RigidScene(Motion motion, std::vector<RigidBody> bodies)
    : Scene(motion == Motion::Space ? 6 : 3, mass_blocks(bodies, coordinates(motion)), motion == Motion::Space ? 3 : 2),
      motion_(motion), coordinates_(coordinates(motion)), bodies_(std::move(bodies)) {}

const Frame& RigidScene::frame(std::int32_t body) const {
  static const Frame world;
  return body == MLCP_WORLD ? world : bodies_[static_cast<std::size_t>(body)].frame;
}

Point RigidScene::plane_normal() const { return motion_ == Motion::Upright ? axes[1] : axes[2]; }

std::vector<double> RigidScene::kept(const Twist& twist) const {
  std::vector<double> values;
  for (const std::size_t i : coordinates_) values.push_back(twist[i]);
  return values;
}

Twist RigidScene::twist(std::span<const double> v, std::size_t body) const {
  Twist whole = {};
  for (std::size_t i = 0; i < coordinates_.size(); ++i) whole[coordinates_[i]] = v[body * coordinates_.size() + i];
  return whole;
}

Point RigidScene::velocity_of(std::int32_t body) const {
  if (body == MLCP_WORLD) return {0, 0, 0};
  const Twist v = twist(velocities(), static_cast<std::size_t>(body));
  return {v[0], v[1], v[2]};
}

void RigidScene::place_body(std::int32_t body, const Frame& at) {
  RigidBody& placed = bodies_[static_cast<std::size_t>(body)];
  placed.frame = at;
  set_mass(body, mass_block(placed, coordinates_));
}

void RigidScene::set_velocity(std::int32_t body, const Twist& velocity) {
  const std::vector<double> values = kept(velocity);
  std::copy(values.begin(), values.end(), this->velocity(body).begin());
}

void RigidScene::prescribe(std::int32_t body, const Twist& velocity) { Scene::prescribe(body, kept(velocity)); }

void RigidScene::add_row(RowList& rows, RowKind kind, std::int32_t a, std::int32_t b, const Twist& rate_a, const Twist& rate_b,
                         double phi, std::int32_t feature, const Drawing::Action& action) const {
  rows.add(kind, a, b, kept(rate_a), kept(rate_b), phi, feature);
  rows.acts(action);
}

void RigidScene::add_motor(RowList& rows, std::int32_t a, std::int32_t b, const Twist& rate_a, const Twist& rate_b, double speed,
                           double force, std::int32_t feature, const Drawing::Action& action) const {
  rows.add_motor(a, b, kept(rate_a), kept(rate_b), speed, force, feature);
  rows.acts(action);
}

void RigidScene::add_contact(RowList& rows, std::int32_t a, std::int32_t b, const ContactPoint& at) const {
  const Point arm_a = at.point - frame(a).origin, arm_b = at.point - frame(b).origin;
  add_row(rows, RowKind::Contact, a, b, -rate_along(at.normal, arm_a), rate_along(at.normal, arm_b), at.gap, at.feature,
          {at.point, at.normal});
}

void RigidScene::add_contact(ContactList& contacts, std::int32_t a, std::int32_t b, const ContactPoint& at,
                             const Material& material) const {
  std::array<Point, 3> directions = {at.normal};
  std::size_t count = 2;
  if (motion_ == Motion::Space) {
    directions[1] = perpendicular(at.normal);
    directions[2] = cross(at.normal, directions[1]);
    count = 3;
  } else {
    directions[1] = cross(plane_normal(), at.normal);
  }
  std::vector<double> jacobian_a, jacobian_b;
  for (std::size_t row = 0; row < count; ++row) {
    for (const double value : kept(-rate_along(directions[row], at.point - frame(a).origin))) jacobian_a.push_back(value);
    for (const double value : kept(rate_along(directions[row], at.point - frame(b).origin))) jacobian_b.push_back(value);
  }
  contacts.add(a, b, jacobian_a, jacobian_b, std::span(directions).first(count), at, material);
}

void RigidScene::draw_actions(Drawing& to) const {
  listed_rows().draw(to);
  listed_contacts().draw(to);
}

void RigidScene::add_forces(std::span<double> force) const {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const Twist v = twist(velocities(), body);
    const Point omega = {v[3], v[4], v[5]};
    const Point gyroscopic = cross(omega, angular_momentum(bodies_[body], omega));
    const Twist on_body = {0, 0, -gravity * bodies_[body].mass, -gyroscopic[0], -gyroscopic[1], -gyroscopic[2]};
    for (std::size_t i = 0; i < coordinates_.size(); ++i) force[body * coordinates_.size() + i] += on_body[coordinates_[i]];
  }
}

void RigidScene::advance(double h, std::span<const double> v) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Twist u = twist(v, i);
    Frame& frame = bodies_[i].frame;
    frame.origin = frame.origin + h * Point{u[0], u[1], u[2]};
    frame.rotation.advance(h, {u[3], u[4], u[5]});
    if (motion_ == Motion::Space) set_mass(static_cast<std::int32_t>(i), mass_block(bodies_[i], coordinates_));
  }
}

double RigidScene::potential_energy() const {
  double sum = 0;
  for (const RigidBody& body : bodies_) sum += gravity * body.mass * body.frame.origin[2];
  return sum;
}

}  // namespace scenes
