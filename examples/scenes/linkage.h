#pragma once
#include "rigid_scene.h"

namespace scenes {

/// A slider-crank: a motor turns the crank, a pair of rods drives the slider along its guide, whose ends are stops. A turn takes a second as long
/// as the motor is strong enough.
///
/// Models crank, rods and slider as rigid bodies in an upright plane with five pins and a slider: twelve rows for twelve velocities, one of which
/// depends on the others, because one rod would do. The motor is a row with a target speed and a largest torque; the stops are unilateral
/// rows that the slider never reaches unless they are moved in. Leaves out friction and play in the joints, and what happens across the plane:
/// joints in space would add rows that are all 0 = 0.
class Linkage : public RigidScene {
 public:
  /// stop: of the slider on either side of the middle of its stroke, m.
  explicit Linkage(double stop = 0.25);

  static constexpr double crank = 0.20, rod = 0.60;  // lengths, m
  static constexpr double speed = 6.283185307179586;  // of the motor, rad/s
  /// The crank's angle from the guide, rad, and the slider's place, m from the crank's axis.
  double angle() const;
  double slider() const;

  bool driven() const override { return true; }
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList& rows) const override;

 private:
  double stop_;
  Joint main_, guide_;
  std::vector<Joint> pins_, wrists_;  // of each rod
};

}  // namespace scenes
