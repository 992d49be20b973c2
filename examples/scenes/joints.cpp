// The rows of joints.
#include "rigid_scene.h"

namespace scenes {

Joint RigidScene::joint(std::int32_t a, std::int32_t b, const Frame& at) const { return {a, b, frame(a).seen(at), frame(b).seen(at)}; }

void RigidScene::add_offset(RowList& rows, const Joint& joint, const Point& n, std::int32_t feature) const {
  const Point at_a = frame(joint.a).to_world(joint.on_a.origin), at_b = frame(joint.b).to_world(joint.on_b.origin);
  // n turns with a, so that a's arm ends at b's point
  add_row(rows, RowKind::Joint, joint.a, joint.b, -rate_along(n, at_b - frame(joint.a).origin), rate_along(n, at_b - frame(joint.b).origin),
          dot(n, at_b - at_a), feature, {at_b, n});
}

void RigidScene::add_square(RowList& rows, const Joint& joint, std::size_t axis_a, std::size_t axis_b, std::int32_t feature) const {
  const Point n_a = (frame(joint.a) * joint.on_a).axis(axis_a), n_b = (frame(joint.b) * joint.on_b).axis(axis_b);
  const Twist rate = rate_about(cross(n_b, n_a));
  add_row(rows, RowKind::Joint, joint.a, joint.b, -rate, rate, dot(n_a, n_b), feature,
          {frame(joint.b).to_world(joint.on_b.origin), {0, 0, 0}});
}

void RigidScene::add_pin(RowList& rows, const Joint& joint) const {
  const Point at_a = frame(joint.a).to_world(joint.on_a.origin), at_b = frame(joint.b).to_world(joint.on_b.origin);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (motion_ != Motion::Space && axes[axis] == plane_normal()) continue;
    // along the world's axes, which do not turn with a
    add_row(rows, RowKind::Joint, joint.a, joint.b, -rate_along(axes[axis], at_a - frame(joint.a).origin),
            rate_along(axes[axis], at_b - frame(joint.b).origin), dot(axes[axis], at_b - at_a), static_cast<std::int32_t>(axis),
            {at_b, axes[axis]});
  }
}

void RigidScene::add_hinge(RowList& rows, const Joint& joint) const {
  add_pin(rows, joint);
  add_square(rows, joint, 0, 2, 3);
  add_square(rows, joint, 1, 2, 4);
}

void RigidScene::add_slider(RowList& rows, const Joint& joint) const {
  const Frame on_a = frame(joint.a) * joint.on_a;
  add_offset(rows, joint, on_a.axis(0), 0);
  if (motion_ == Motion::Space) {
    add_offset(rows, joint, on_a.axis(1), 1);
    add_square(rows, joint, 1, 2, 3);
    add_square(rows, joint, 0, 1, 4);
  }
  add_square(rows, joint, 0, 2, 5);
}

}  // namespace scenes
