#pragma once
#include "rigid_scene.h"

namespace scenes {

/// What a designer may choose.
struct GripperDesign {
  double friction = 0.2;                         // of the pads on the part
  double clearance = 0.016;                      // between the pads of the open gripper and a part on its axis, m; what is left is the part
  double part_mass = 0.7, finger_mass = 0.06;    // kg
};

/// The self-centring gripper of the paper's Fig. 1: an annular cam slides to the left over eight fingers and closes them on a part, which
/// lies askew on the lower fingers and ends on the axis. The motor then holds it, lets go, and begins again.
///
/// Models cam and fingers as rigid bodies in space, six velocities each: a slider and the stops of its stroke, a hinge a finger, the
/// motor as a row with a target speed and a largest force, springs that open the fingers, the rollers in the conical bore of the cam as
/// contacts without friction (they roll), two elastic pads a finger on the round part as contacts with friction. The axis is x, z up.
/// Leaves out the spin of the rollers, the elasticity of all but the pads,
/// contacts of fingers with each other and of the part with anything but pads: none occurs in this stroke.
class Gripper : public RigidScene {
 public:
  /// fails: std::invalid_argument for a design that cannot be made.
  explicit Gripper(std::int32_t fingers, unsigned seed = 1, const GripperDesign& design = {});

  /// How far the part's axis lies from the gripper's, m.
  double part_off_centre() const;
  /// How far the part has slid out of the gripper along its axis, m.
  double part_slid() const;
  /// How far the cam has gone to the left, m, and how far it can.
  double closed() const;
  static constexpr double stroke = 0.03;
  /// The motor closes and holds, then opens; s.
  static constexpr double period = 1.6, hold_until = 1.0;

  bool driven() const override { return true; }
  std::vector<Measure> measures() const override;
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList& rows) const override;
  void add_contacts(ContactList& contacts) const override;
  void add_forces(std::span<double> force) const override;
  double potential_energy() const override;

 private:
  std::int32_t finger(std::int32_t i) const { return 2 + i; }
  double opening(std::int32_t i) const;  // angle of a finger from where its pads lie parallel to the axis, outwards, rad

  std::int32_t fingers_;
  Capsule part_;
  Material grip_;
  Joint slider_;
  std::vector<Joint> hinges_;
};

}  // namespace scenes
