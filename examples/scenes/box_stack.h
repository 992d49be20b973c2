#pragma once
#include <array>

#include "scene.h"
#include "vector.h"

namespace scenes {

struct Box {
  Point half_extent;  // m
  Point centre;       // m, z up
  double mass;        // kg
  Rotation rotation = {};
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
class BoxStack : public Scene {
 public:
  BoxStack(std::vector<Box> boxes, std::vector<Support> supports);

  std::span<const Box> boxes() const { return boxes_; }
  std::span<const Support> supports() const { return supports_; }
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList& rows) const override;
  void add_forces(std::span<double> force) const override;
  void advance(double h, std::span<const double> v) override;

 private:
  std::vector<Box> boxes_;
  std::vector<Support> supports_;
};

}  // namespace scenes
