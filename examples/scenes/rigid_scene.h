#pragma once
#include "motion.h"
#include "rigid_body.h"
#include "scene.h"

namespace scenes {

/// A place where two bodies (or MLCP_WORLD and a body) are joined: the same frame as each of them sees it. In a plane its y axis is the
/// plane's normal.
struct Joint {
  std::int32_t a, b;
  Frame on_a, on_b;
  double reach = 0.1;  // how far from the origin the points lie that keep directions, m
};

/// Rigid bodies in space or in a plane: their masses, gravity along −z, gyroscopic forces, and how they move. A derived scene says what
/// touches and what is joined.
class RigidScene : public Scene {
 protected:
  RigidScene(Motion motion, std::vector<RigidBody> bodies);

  /// The bodies, and the world's frame for MLCP_WORLD.
  const Frame& frame(std::int32_t body) const;
  std::span<const RigidBody> bodies() const { return bodies_; }

  /// Of the centre of mass; 0 for the world.
  Point velocity_of(std::int32_t body) const;
  void place_body(std::int32_t body, const Frame& at);
  void set_velocity(std::int32_t body, const Twist& velocity);
  void prescribe(std::int32_t body, const Twist& velocity);

  /// One row: the rates of φ with the velocities of both bodies, and where and along what its force acts on b.
  void add_row(RowList& rows, RowKind kind, std::int32_t a, std::int32_t b, const Twist& rate_a, const Twist& rate_b, double phi,
               std::int32_t feature, const Drawing::Action& action) const;
  void add_motor(RowList& rows, std::int32_t a, std::int32_t b, const Twist& rate_a, const Twist& rate_b, double speed, double force,
                 std::int32_t feature, const Drawing::Action& action) const;
  /// A joint of two bodies at their present positions; `at` in the world's frame.
  Joint joint(std::int32_t a, std::int32_t b, const Frame& at) const;
  /// The origins stay together: a ball joint; in a plane a hinge. 3 rows, 2 in a plane.
  void add_pin(RowList& rows, const Joint& joint) const;
  /// Turns about the joint's z axis, in space. 5 rows.
  void add_hinge(RowList& rows, const Joint& joint) const;
  /// Slides along the joint's z axis. 5 rows, 2 in a plane.
  void add_slider(RowList& rows, const Joint& joint) const;

  void add_contact(ContactList& contacts, std::int32_t a, std::int32_t b, const ContactPoint& at, const Material& material) const;

  /// A frictionless contact: one row.
  void add_contact(RowList& rows, std::int32_t a, std::int32_t b, const ContactPoint& at) const;

  void draw_actions(Drawing& to) const;

  void add_forces(std::span<double> force) const override;
  void advance(double h, std::span<const double> v) override;
  double potential_energy() const override;

 private:
  /// φ = n · (p_b − p_a) of the points at `place` in the joint's frame, with n fixed in a.
  void add_offset(RowList& rows, const Joint& joint, const Point& place, const Point& n, std::int32_t feature) const;

  Point plane_normal() const;
  /// The components that move.
  std::vector<double> kept(const Twist& twist) const;
  /// The velocity of a body, with zeros where it does not move.
  Twist twist(std::span<const double> v, std::size_t body) const;

  Motion motion_;
  std::vector<std::size_t> coordinates_;
  std::vector<RigidBody> bodies_;
};

}  // namespace scenes
