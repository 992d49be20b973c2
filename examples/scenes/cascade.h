#pragma once
#include "rigid_scene.h"

namespace scenes {

/// The cascade of rigid bodies of the paper's Fig. 4: balls and pills fall from tray to tray between two panes into a bin.
///
/// Models balls and pills (capsules) as rigid bodies in space, six velocities each, that touch each other, the trays (boxes), the panes and
/// the bin with friction, and bounce a little. Leaves out rolling resistance; a pill touches a tray with its ends and its middle, which misses
/// the rest of it only where it lies across an edge.
class Cascade : public RigidScene {
 public:
  explicit Cascade(std::int32_t bodies, unsigned seed = 1);
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList&) const override {}
  void add_contacts(ContactList& contacts) const override;

 private:
  struct Pieces;
  explicit Cascade(Pieces&& pieces);
  const Capsule& shape(std::int32_t body) const { return shapes_[static_cast<std::size_t>(body)]; }

  std::vector<Capsule> shapes_;  // of a ball: half_length 0
};

}  // namespace scenes
