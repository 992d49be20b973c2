#include "gripper.h"

#include <cmath>
#include <stdexcept>

#include "geometry/cam_contacts.h"
#include "geometry/sphere_contacts.h"
#include "random.h"

namespace scenes {
namespace {

constexpr double pi = 3.14159265358979323846;

// A finger's frame: x along the axis of the gripper, z away from it, y the hinge; its origin the centre of mass. The hinge lies at x = 0.
constexpr double hinge_radius = 0.040;            // of the circle of the hinges about the axis, m
constexpr Point mass_centre = {-0.060, 0, 0.004};  // seen from the hinge
constexpr Point roller_place = {-0.045, 0, 0.020};
constexpr Point pad_places[2] = {{-0.100, 0, -0.008}, {-0.130, 0, -0.008}};
constexpr Sphere roller = {0.008}, pad = {0.006};
constexpr Box beam = {{0.067, 0.006, 0.005}};      // of the finger
constexpr double spring = 0.6, preload = 0.12;     // of a finger, opening it: N m/rad, rad
constexpr double widest = 0.16;                    // opening at the stop, rad

const AnnularCam cam = {{{-0.030, 0.0790}, {0.012, 0.0665}, {0.030, 0.0665}}};  // z towards +x
constexpr double cam_rest = -0.035;                // of its origin on the axis, open, m
constexpr double cam_outside = 0.088;              // radius, m
constexpr double cam_mass = 1.2;
constexpr double motor_speed = 0.06, motor_force = 250;

constexpr double part_half_length = 0.028, part_place = -0.115;  // m, along the axis
constexpr double free_radius = 0.042;              // of the circle that the pads of the open gripper leave free, m
constexpr double grip_stiffness = 1e6;

constexpr std::int32_t part_body = 0, cam_body = 1;

/// The gripper looks a little up, as on a robot's arm: x is its axis.
Frame base() { return {{0, 0, 0}, Rotation::about(axes[1], 0.12) * Rotation::about(axes[0], pi / 16)}; }

/// On the axis, with z along it: for the part, the cam and their joints.
Frame on_axis(double x) { return base() * Frame{{x, 0, 0}, Rotation::about(axes[1], 0.5 * pi)}; }

/// The frame of a finger's hinge, y its axis, when the pads are parallel to the gripper's axis.
Frame hinge_frame(double angle) {
  const Rotation turned = Rotation::about(axes[0], angle);
  return base() * Frame{turned * Point{0, 0, hinge_radius}, turned};
}

Capsule part_of(const GripperDesign& design) {
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  if (!(design.friction >= 0 && std::isfinite(design.friction))) throw std::invalid_argument("friction is negative or not finite");
  if (!positive(design.clearance) || design.clearance >= free_radius) throw std::invalid_argument("clearance is not between 0 and 0.042 m");
  if (!positive(design.part_mass) || !positive(design.finger_mass)) throw std::invalid_argument("part_mass and finger_mass are positive");
  return {part_half_length, free_radius - design.clearance};
}

std::vector<RigidBody> bodies_of(std::int32_t fingers, unsigned seed, const GripperDesign& design) {
  Random random(seed);
  Frame part_frame = on_axis(part_place);
  part_frame.origin = part_frame.origin + Point{0, random.uniform(-0.002, 0.002), -0.0085};
  std::vector<RigidBody> bodies = {solid(part_of(design), design.part_mass, part_frame)};
  const double r2 = cam_outside * cam_outside;
  bodies.push_back({cam_mass, cam_mass * Point{0.4 * r2, 0.4 * r2, 0.8 * r2}, on_axis(cam_rest)});
  for (std::int32_t i = 0; i < fingers; ++i) {
    const Frame open = hinge_frame(2 * pi * i / fingers) * Frame{{0, 0, 0}, Rotation::about(axes[1], widest)};
    bodies.push_back(solid(beam, design.finger_mass, {open.to_world(mass_centre), open.rotation}));
  }
  return bodies;
}

/// Of a finger's point, given from the hinge, in the finger's frame.
Point seen_from_centre(const Point& from_hinge) { return from_hinge - mass_centre; }

}  // namespace

Gripper::Gripper(std::int32_t fingers, unsigned seed, const GripperDesign& design)
    : RigidScene(Motion::Space, bodies_of(fingers, seed, design)), fingers_(fingers), part_(part_of(design)),
      grip_{.friction = design.friction, .stiffness = grip_stiffness}, slider_(joint(MLCP_WORLD, cam_body, on_axis(cam_rest))) {
  for (std::int32_t i = 0; i < fingers; ++i) {
    // the hinge's axis is z of the joint
    const Frame hinge = hinge_frame(2 * pi * i / fingers);
    const Rotation z_to_y = Rotation::about(axes[0], -0.5 * pi);
    Joint made = {MLCP_WORLD, finger(i), {hinge.origin, hinge.rotation * z_to_y}, {seen_from_centre({0, 0, 0}), z_to_y}};
    hinges_.push_back(made);
  }
}

double Gripper::closed() const { return cam_rest - base().to_local(frame(cam_body).origin)[0]; }

double Gripper::part_off_centre() const {
  const Point centre = base().to_local(frame(part_body).origin);
  return std::sqrt(centre[1] * centre[1] + centre[2] * centre[2]);
}

double Gripper::part_slid() const { return part_place - base().to_local(frame(part_body).origin)[0]; }

std::vector<Scene::Measure> Gripper::measures() const {
  return {{"part_off_centre", part_off_centre()}, {"part_slid", part_slid()}, {"closed", closed()}};
}

double Gripper::opening(std::int32_t i) const {
  // x of the finger leans towards −z of the hinge's frame as the tips, at −x, go outwards
  const Point tip = hinge_frame(2 * pi * i / fingers_).rotation.inverse() * frame(finger(i)).axis(0);
  return std::atan2(-tip[2], tip[0]);
}

void Gripper::add_rows(RowList& rows) const {
  add_slider(rows, slider_);
  const Point at = frame(cam_body).origin;
  const Point axis = base().axis(0);
  const auto along = [&](double sign) { return rate_along(sign * axis, {0, 0, 0}); };
  // stops of the cam
  add_row(rows, RowKind::Contact, MLCP_WORLD, cam_body, {}, along(-1), closed(), 6, {at, -1.0 * axis});
  add_row(rows, RowKind::Contact, MLCP_WORLD, cam_body, {}, along(1), stroke - closed(), 7, {at, axis});
  const bool closing = std::fmod(time(), period) < hold_until;
  add_motor(rows, MLCP_WORLD, cam_body, {}, along(-1), closing ? motor_speed : -motor_speed, motor_force, 8, {at, -1.0 * axis});
  for (std::int32_t i = 0; i < fingers_; ++i) {
    const std::int32_t body = finger(i);
    const Joint& hinge = hinges_[static_cast<std::size_t>(i)];
    add_hinge(rows, hinge);
    const Point turns_about = hinge.on_a.axis(2);
    add_row(rows, RowKind::Contact, MLCP_WORLD, body, {}, -rate_about(turns_about), widest - opening(i), 6,
            {hinge.on_a.origin, {0, 0, 0}});
    add_contact(rows, cam_body, body,
                contact(cam, frame(cam_body), roller, frame(body).to_world(seen_from_centre(roller_place))));
  }
}

void Gripper::add_contacts(ContactList& contacts) const {
  for (std::int32_t i = 0; i < fingers_; ++i) {
    for (std::int32_t at = 0; at < 2; ++at) {
      const Point centre = frame(finger(i)).to_world(seen_from_centre(pad_places[at]));
      ContactPoint touch = contact(part_, frame(part_body), pad, centre);
      touch.feature = at;
      add_contact(contacts, part_body, finger(i), touch, grip_);
    }
  }
}

void Gripper::add_forces(std::span<double> force) const {
  RigidScene::add_forces(force);
  for (std::int32_t i = 0; i < fingers_; ++i) {
    const Point axis = hinges_[static_cast<std::size_t>(i)].on_a.axis(2);
    const double torque = spring * (widest + preload - opening(i));
    for (std::size_t k = 0; k < 3; ++k) force[static_cast<std::size_t>(finger(i)) * 6 + 3 + k] += torque * axis[k];
  }
}

double Gripper::potential_energy() const {
  double sum = RigidScene::potential_energy();
  for (std::int32_t i = 0; i < fingers_; ++i) sum += 0.5 * spring * std::pow(widest + preload - opening(i), 2);
  return sum;
}

void Gripper::draw(Drawing& to) const {
  using Role = Drawing::Role;
  to.eye = {-0.62, -0.70, 0.36};
  scenes::draw(to, part_, frame(part_body), Role::Product);
  for (std::int32_t i = 0; i < fingers_; ++i) {
    const Frame& at = frame(finger(i));
    const auto solid_at = [&](const Point& half_extent, const Point& from_hinge, const Rotation& turn = {}) {
      scenes::draw(to, Box{half_extent}, at * Frame{seen_from_centre(from_hinge), turn}, Role::Body);
    };
    solid_at({0.070, 0.006, 0.005}, {-0.068, 0, 0.001});
    solid_at({0.006, 0.004, 0.008}, {roller_place[0], 0, 0.012});
    scenes::draw(to, Capsule{0.017, pad.radius}, at * Frame{seen_from_centre({-0.115, 0, -0.008}), Rotation::about(axes[1], 0.5 * pi)}, Role::Body);
    scenes::draw(to, Capsule{0.004, roller.radius}, at * Frame{seen_from_centre(roller_place), Rotation::about(axes[0], 0.5 * pi)}, Role::Drive);
  }
  // the ring, cut open in front; outer surface, then the bore backwards
  std::vector<AnnularCam::Station> ring = {{cam.profile.front().z, cam_outside}, {cam.profile.back().z, cam_outside}};
  ring.insert(ring.end(), cam.profile.rbegin(), cam.profile.rend());
  draw_turned(to, ring, frame(cam_body), Role::Drive, 36, 0, 2 * pi);
  const AnnularCam::Station hub[] = {{-0.010, 0}, {-0.010, 0.034}, {0.012, 0.034}, {0.012, 0.055}, {0.030, 0.055}, {0.030, 0}};
  draw_turned(to, hub, on_axis(0), Role::Machine, 32);
  draw_actions(to);
}

}  // namespace scenes
