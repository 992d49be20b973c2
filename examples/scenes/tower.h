#pragma once
#include "box_stack.h"

namespace scenes {

/// Cubes on top of each other, four corner contacts each, the top one heavier by mass_ratio: with 10⁴ and more the hardest of
/// the small scenes, for light boxes must carry what the heavy one needs to every digit.
BoxStack tower_scene(int boxes, double mass_ratio = 1);

/// The first step of a tower, at rest.
Problem tower(int boxes, double mass_ratio = 1);

}  // namespace scenes
