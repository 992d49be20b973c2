#pragma once
#include <filesystem>

#include "scene.h"

namespace scenes {

/// Runs `steps` steps of length h and saves what each one solved, with settings, ordering and start, as the snapshots 000.mlcp,
/// 001.mlcp… in `folder`, which is made if need be. Stops at the first step that is not solved and returns the number of files;
/// that last file then holds the problem that failed.
int record(Scene& scene, int steps, const std::filesystem::path& folder, double h = default_step);

}  // namespace scenes
