#pragma once
#include "rigid_scene.h"

namespace scenes {

/// Boxes piled to a wall in stretcher bond without mortar, and a ball that hits it.
///
/// Models boxes and ball as rigid bodies in space that touch each other and the ground with friction wherever they come to touch: faces,
/// edges and corners, in contrast to `wall`, which knows beforehand what stands on what. Leaves out rolling resistance.
class WallOfBoxes : public RigidScene {
 public:
  explicit WallOfBoxes(std::int32_t courses);
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList&) const override {}
  void add_contacts(ContactList& contacts) const override;

 private:
  std::int32_t boxes_;  // the ball comes behind them
};

}  // namespace scenes
