#include "box_stack.h"

#include <utility>

namespace scenes {
namespace {

std::vector<RigidBody> solids(std::span<const Brick> bricks) {
  std::vector<RigidBody> bodies;
  for (const Brick& brick : bricks) bodies.push_back(solid(brick.box, brick.mass, {brick.centre}));
  return bodies;
}

}  // namespace

BoxStack::BoxStack(std::span<const Brick> bricks, std::vector<Support> supports)
    : RigidScene(Motion::Space, solids(bricks)), supports_(std::move(supports)) {
  for (const Brick& brick : bricks) boxes_.push_back(brick.box);
}

void BoxStack::add_rows(RowList& rows) const {
  for (const Support& support : supports_) {
    const bool on_ground = support.lower == MLCP_WORLD;
    const Frame& lower = frame(support.lower);
    const Point n = lower.axis(2);
    const double height = on_ground ? 0 : boxes_[static_cast<std::size_t>(support.lower)].half_extent[2];
    for (std::size_t corner = 0; corner < support.points.size(); ++corner) {
      const Point point = frame(support.upper).to_world(support.points[corner]);
      const double gap = dot(n, point - lower.origin) - height;
      add_contact(rows, support.lower, support.upper, {point, n, gap, static_cast<std::int32_t>(corner)});
    }
  }
}

void BoxStack::draw(Drawing& to) const {
  for (std::size_t i = 0; i < boxes_.size(); ++i) to.boxes.push_back(corners(boxes_[i], bodies()[i].frame));
  draw_actions(to);
}

}  // namespace scenes
