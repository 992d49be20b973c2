#pragma once
#include <array>

#include "rigid_scene.h"

namespace scenes {

struct Brick {
  Box box;
  Point centre;  // m
  double mass;   // kg
};

/// Four points of `upper`'s underside, in its own frame, that stand on the top face of `lower` (or on the ground z = 0).
struct Support {
  std::int32_t lower, upper;
  std::array<Point, 4> points;
};

/// Boxes that stand on each other, six velocities each: the four points of a face that rests on another, one contact row a
/// point, one too many for every pair. That is what a collision detector hands over, and what makes A of (2.8) singular.
///
/// Leaves out every other contact (sides, edges, a box that slides off its neighbour) and friction: right while the stack stands.
class BoxStack : public RigidScene {
 public:
  BoxStack(std::span<const Brick> bricks, std::vector<Support> supports);

  using RigidScene::bodies;
  std::span<const Support> supports() const { return supports_; }
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList& rows) const override;

 private:
  std::vector<Box> boxes_;
  std::vector<Support> supports_;
};

}  // namespace scenes
