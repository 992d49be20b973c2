#pragma once
#include "rigid_scene.h"

namespace scenes {

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
  explicit Gripper(std::int32_t fingers, unsigned seed = 1);

  /// How far the part's axis lies from the gripper's, m.
  double part_off_centre() const;
  /// How far the cam has gone to the left, m, and how far it can.
  double closed() const;
  static constexpr double stroke = 0.03;
  /// The motor closes and holds, then opens; s.
  static constexpr double period = 1.6, hold_until = 1.0;

  bool driven() const override { return true; }
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
  Joint slider_;
  std::vector<Joint> hinges_;
};

}  // namespace scenes
