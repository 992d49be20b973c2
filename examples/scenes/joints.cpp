// The rows of joints: points of two bodies that stay together, so that every row is in m.
#include "rigid_scene.h"

namespace scenes {

Joint RigidScene::joint(std::int32_t a, std::int32_t b, const Frame& at) const { return {a, b, frame(a).seen(at), frame(b).seen(at)}; }

void RigidScene::add_offset(RowList& rows, const Joint& joint, const Point& place, const Point& n, std::int32_t feature) const {
  const Point at_a = frame(joint.a).to_world(joint.on_a.to_world(place)), at_b = frame(joint.b).to_world(joint.on_b.to_world(place));
  // n turns with a, so that a's arm ends at b's point
  add_row(rows, RowKind::Joint, joint.a, joint.b, -rate_along(n, at_b - frame(joint.a).origin), rate_along(n, at_b - frame(joint.b).origin),
          dot(n, at_b - at_a), feature, {at_b, n});
}

void RigidScene::add_pin(RowList& rows, const Joint& joint) const {
  const Frame on_a = frame(joint.a) * joint.on_a;
  add_offset(rows, joint, {0, 0, 0}, on_a.axis(0), 0);
  if (motion_ == Motion::Space) add_offset(rows, joint, {0, 0, 0}, on_a.axis(1), 1);
  add_offset(rows, joint, {0, 0, 0}, on_a.axis(2), 2);
}

void RigidScene::add_hinge(RowList& rows, const Joint& joint) const {
  const Frame on_a = frame(joint.a) * joint.on_a;
  add_pin(rows, joint);
  add_offset(rows, joint, joint.reach * axes[2], on_a.axis(0), 3);
  add_offset(rows, joint, joint.reach * axes[2], on_a.axis(1), 4);
}

void RigidScene::add_slider(RowList& rows, const Joint& joint) const {
  const Frame on_a = frame(joint.a) * joint.on_a;
  add_offset(rows, joint, {0, 0, 0}, on_a.axis(0), 0);
  add_offset(rows, joint, joint.reach * axes[2], on_a.axis(0), 1);
  if (motion_ != Motion::Space) return;
  add_offset(rows, joint, {0, 0, 0}, on_a.axis(1), 2);
  add_offset(rows, joint, joint.reach * axes[2], on_a.axis(1), 3);
  add_offset(rows, joint, joint.reach * axes[0], on_a.axis(1), 4);
}

}  // namespace scenes
