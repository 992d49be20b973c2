#include "record.h"

#include <algorithm>
#include <string>

namespace scenes {

int record(Scene& scene, int steps, const std::filesystem::path& folder, double h) {
  std::filesystem::create_directories(folder);
  for (int step = 0; step < steps; ++step) {
    scene.prepare(h);
    std::string name = std::to_string(step);
    name.insert(0, 3 - std::min<std::size_t>(3, name.size()), '0');
    const std::string path = (folder / (name + ".mlcp")).string();
    char message[512];
    check(mlcp_snapshot_save(path.c_str(), scene.problem(), scene.solver(), nullptr, scene.start(), message, sizeof message),
          message);
    if (scene.finish().outcome != MLCP_SOLVED) return step + 1;
  }
  return steps;
}

}  // namespace scenes
