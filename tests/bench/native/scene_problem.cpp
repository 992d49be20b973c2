#include "scene_problem.h"

#include <vector>

#include "assembly.h"
#include "scenes/scenes.h"

namespace bench {
namespace {

handles::Problem islands(std::int32_t count) {
  Assembly all;
  for (std::int32_t i = 0; i < count; ++i) all.append(Assembly(scenes::pile(30, static_cast<unsigned>(i + 1)).get()), static_cast<std::uint64_t>(i));
  return all.build();
}

}  // namespace

handles::Problem scene_problem(const std::string& family, std::int32_t size) {
  if (family == "pile") return scenes::pile(size);
  if (family == "rope") return scenes::rope(size);
  if (family == "wall") return scenes::wall(size, size);
  if (family == "tower") return scenes::tower(size);
  if (family == "islands") return islands(size);
  throw std::runtime_error("no scene is called " + family);
}

handles::Problem every_row(const mlcp_problem* problem, std::int32_t stride) {
  mlcp_problem* copy = nullptr;
  handles::check(mlcp_problem_clone(problem, &copy));
  handles::Problem part(copy);
  std::vector<std::int32_t> others;
  for (std::int32_t i = 0; i < mlcp_problem_row_count(problem); ++i)
    if (i % stride != 0) others.push_back(i);
  handles::check(mlcp_problem_rows_remove(copy, static_cast<std::int32_t>(others.size()), others.data()), part);
  return Assembly(copy).build();
}

}  // namespace bench
