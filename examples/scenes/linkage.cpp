#include "linkage.h"

#include <cmath>

namespace scenes {
namespace {

constexpr Box crank_beam = {{0.5 * Linkage::crank, 0.015, 0.02}}, rod_beam = {{0.5 * Linkage::rod, 0.015, 0.015}}, block = {{0.06, 0.04, 0.04}};
constexpr double crank_mass = 1.5, rod_mass = 1, block_mass = 2;  // kg
constexpr double torque = 60;                                     // of the motor, N m
constexpr std::int32_t crank_body = 0, rods = 2, slider_body = 1 + rods;

/// Features of rows beside joints.
constexpr std::int32_t motor = 6, low_stop = 7, high_stop = 8;

constexpr Point pin_place = {0, 0, Linkage::crank};  // the crank starts upright

double wrist_place() { return std::sqrt(Linkage::rod * Linkage::rod - Linkage::crank * Linkage::crank); }

std::vector<RigidBody> bodies_of() {
  const Point wrist = {wrist_place(), 0, 0};
  const double slope = std::asin(Linkage::crank / Linkage::rod);  // of the rod, downwards
  std::vector<RigidBody> bodies = {solid(crank_beam, crank_mass, {0.5 * pin_place, Rotation::about(axes[1], std::asin(-1.0))})};
  for (std::int32_t i = 0; i < rods; ++i) bodies.push_back(solid(rod_beam, rod_mass, {0.5 * (pin_place + wrist), Rotation::about(axes[1], slope)}));
  bodies.push_back(solid(block, block_mass, {wrist}));
  return bodies;
}

/// z along the guide.
Frame guide_at(const Point& place) { return {place, Rotation::about(axes[1], std::asin(1.0))}; }

}  // namespace

Linkage::Linkage(double stop)
    : RigidScene(Motion::Upright, bodies_of()), stop_(stop), main_(joint(MLCP_WORLD, crank_body, {})),
      guide_(joint(MLCP_WORLD, slider_body, guide_at({wrist_place(), 0, 0}))) {
  for (std::int32_t i = 1; i <= rods; ++i) {
    pins_.push_back(joint(crank_body, i, {pin_place}));
    wrists_.push_back(joint(i, slider_body, {{wrist_place(), 0, 0}}));
  }
}

double Linkage::angle() const {
  const Point along = frame(crank_body).axis(0);
  return std::atan2(along[2], along[0]);
}

double Linkage::slider() const { return frame(slider_body).origin[0]; }

void Linkage::add_rows(RowList& rows) const {
  add_pin(rows, main_);
  for (const Joint& pin : pins_) add_pin(rows, pin);
  for (const Joint& wrist : wrists_) add_pin(rows, wrist);
  add_slider(rows, guide_);
  const Twist turn = rate_about(-1.0 * axes[1]);  // the angle grows from x to z
  add_motor(rows, MLCP_WORLD, crank_body, {}, turn, speed, torque, motor, {frame(crank_body).origin, {0, 0, 0}});
  const Twist along = rate_along(axes[0], {0, 0, 0});
  const double place = slider() - rod;
  add_row(rows, RowKind::Contact, MLCP_WORLD, slider_body, {}, along, place + stop_, low_stop, {frame(slider_body).origin, axes[0]});
  add_row(rows, RowKind::Contact, MLCP_WORLD, slider_body, {}, -along, stop_ - place, high_stop, {frame(slider_body).origin, -1.0 * axes[0]});
}

void Linkage::draw(Drawing& to) const {
  to.eye = {0.15, -1, 0.25};
  to.boxes.push_back(corners(crank_beam, frame(crank_body)));
  for (const double side : {-1.0, 1.0})
    to.boxes.push_back(corners(rod_beam, frame(1) * Frame{{0, side * 2 * rod_beam.half_extent[1], 0}}));
  to.boxes.push_back(corners(block, frame(slider_body)));
  for (const double side : {-1.0, 1.0}) to.boxes.push_back(corners(Box{{0.01, 0.05, 0.05}}, {{rod + side * (stop_ + 0.07), 0, 0}}));
  to.paths.push_back({{rod - stop_ - 0.08, 0, -0.05}, {rod + stop_ + 0.08, 0, -0.05}});
  draw_actions(to);
}

}  // namespace scenes
