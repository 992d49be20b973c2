#pragma once
#include "rigid_scene.h"

namespace scenes {

/// A rope over two pegs with a weight at each end, the one heavier than the other: it slides as long as friction lets it (Euler and Eytelwein: it
/// rests while the weights differ by a factor of less than exp(µ·angle) over each peg), until it stands on the ground.
///
/// Models the rope as points in an upright plane, each with a row of fixed distance to the next and contacts with the pegs with friction that
/// act on the point itself, so that nothing rolls. Leaves out the rope's stiffness, torsion and contacts with itself; the turning of points
/// and weights is there but nothing drives it. Tension stands in the
/// rows' directions, which a step takes as they are at its start: links shorter than 2h √(tension/density) shake.
class RopeOverPegs : public RigidScene {
 public:
  /// heavy: mass of the weight at one end, in units of the other's.
  explicit RopeOverPegs(std::int32_t links, double heavy = 1.5, double friction = 0.3);
  /// Height of the heavier weight, m.
  double heavy_end() const { return bodies().back().frame.origin[2]; }
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList& rows) const override;
  void add_contacts(ContactList& contacts) const override;

 private:
  double friction_;
  std::vector<double> length_;  // from body i to i + 1, m
};

}  // namespace scenes
