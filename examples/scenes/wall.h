#pragma once
#include "box_stack.h"

namespace scenes {

/// Bricks in stretcher bond: courses of `width` bricks, every second one moved by half a brick and closed with a half brick at
/// each end. A brick stands on two below with four contacts each, the corners of the face they share. Bricks of one course do
/// not touch: head joints carry nothing in a wall at rest.
BoxStack wall_scene(int width, int height);

/// The first step of a wall, at rest.
Problem wall(int width, int height);

}  // namespace scenes
