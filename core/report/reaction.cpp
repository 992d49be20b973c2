#include "report/reaction.h"

#include "assemble/bodies.h"
#include "assemble/validate.h"

namespace mlcp {

void reaction(const Problem& problem, const Result& result, std::int32_t id, std::span<double> out) {
  const Body& body = body_at(problem, id);
  check_length("count", static_cast<std::int64_t>(out.size()), body.dimension);
  if (!body.prescribed) throw Error(MLCP_ERROR_STATE, "body = %d is not prescribed", id);
  check_length("velocities of the solution", static_cast<std::int64_t>(result.v.size()), problem.n());
  check_length("rows of the solution", static_cast<std::int64_t>(result.gamma.size()), problem.m());

  const std::int32_t first = body.offset;
  for (std::int32_t j = 0; j < body.dimension; ++j) out[j] = -problem.momentum[first + j];
  for (std::int32_t j = 0; j < body.dimension; ++j)
    for (std::int32_t e = problem.mass.pointers[first + j]; e < problem.mass.pointers[first + j + 1]; ++e)
      out[problem.mass.indices[e] - first] += problem.mass.values[e] * result.v[first + j];
  for (std::int32_t i = 0; i < problem.m(); ++i) {
    if (result.gamma[i] == 0) continue;
    for (std::int32_t e = problem.jacobian.pointers[i]; e < problem.jacobian.pointers[i + 1]; ++e) {
      const std::int32_t j = problem.jacobian.indices[e] - first;
      if (j >= 0 && j < body.dimension) out[j] -= problem.jacobian.values[e] * result.gamma[i];
    }
  }
}

}  // namespace mlcp
