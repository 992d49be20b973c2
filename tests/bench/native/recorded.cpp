#include "recorded.h"

#include <stdexcept>

#include "assembly.h"
#include "scenes/gallery.h"

namespace bench {

std::vector<handles::Problem> record(const Recording& which) {
  const auto scene = scenes::make_scene(which.scene, which.size, which.seed);
  std::vector<handles::Problem> problems;
  for (std::int32_t step = 0; step < which.first + which.steps; ++step) {
    scene->prepare(which.h);
    if (step >= which.first) {
      mlcp_problem* copy = nullptr;
      handles::check(mlcp_problem_clone(scene->problem(), &copy));
      problems.emplace_back(copy);
    }
    if (scene->finish().outcome != MLCP_SOLVED) throw std::runtime_error(which.scene + ": step " + std::to_string(step) + " was not solved");
  }
  return problems;
}

handles::Problem plain(const mlcp_problem* problem, std::int32_t facets) { return Assembly(problem, facets).build(); }

}  // namespace bench
