#pragma once
#include <cstdint>
#include <string>

#include "scenes/handles.h"

namespace bench {

/// One step of a scene by name: pile (contacts), rope (links), wall (courses, as many bricks wide), tower (boxes), islands (piles
/// of 30 contacts beside each other). fails: std::runtime_error, an unknown name.
handles::Problem scene_problem(const std::string& family, std::int32_t size);

/// The rows of `problem` that `stride` steps over, the bodies as they are: row 0, stride, 2 stride, ...
handles::Problem every_row(const mlcp_problem* problem, std::int32_t stride);

}  // namespace bench
