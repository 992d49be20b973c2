#include "velocities.h"

#include "../scenes/handles.h"

namespace cli {

using handles::check;

Velocities velocities_of(const mlcp_problem* problem) {
  Velocities result;
  const auto count = static_cast<std::size_t>(mlcp_problem_velocity_count(problem));
  result.new_index.resize(count);
  result.given.resize(count);
  std::vector<std::int32_t> bodies(static_cast<std::size_t>(mlcp_problem_body_count(problem)));
  std::int32_t bodies_found = static_cast<std::int32_t>(bodies.size());
  check(mlcp_problem_bodies(problem, bodies_found, bodies.data(), &bodies_found));
  for (const std::int32_t body : bodies) {
    std::int32_t first = 0, dimension = 0, prescribed = 0;
    check(mlcp_problem_body_range(problem, body, &first, &dimension));
    check(mlcp_problem_body_state(problem, body, &prescribed, dimension, &result.given[static_cast<std::size_t>(first)]));
    result.prescribed_bodies += prescribed;
    for (std::int32_t j = first; j < first + dimension; ++j) {
      result.new_index[static_cast<std::size_t>(j)] = prescribed ? -1 : result.dynamic++;
    }
  }
  return result;
}

}  // namespace cli
