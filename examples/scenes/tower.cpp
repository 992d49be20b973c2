#include "tower.h"

#include <utility>

namespace scenes {

BoxStack tower_scene(int boxes, double mass_ratio) {
  constexpr double half = 0.25;  // m
  constexpr double mass = 10;    // kg
  std::vector<Brick> cubes;
  std::vector<Support> supports;
  for (int i = 0; i < boxes; ++i) {
    cubes.push_back({{{half, half, half}}, {0, 0, half + 2 * half * i}, i + 1 == boxes ? mass_ratio * mass : mass});
    supports.push_back({i == 0 ? MLCP_WORLD : i - 1, i,
                        {{{-half, -half, -half}, {half, -half, -half}, {-half, half, -half}, {half, half, -half}}}});
  }
  return BoxStack(cubes, std::move(supports));
}

Problem tower(int boxes, double mass_ratio) { return Scene::problem_of_step(tower_scene(boxes, mass_ratio)); }

}  // namespace scenes
