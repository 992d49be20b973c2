#include "oracle.h"

#include <algorithm>
#include <array>

#include "../../../capi/handles.h"
#include "clock.h"

namespace bench {

Oracle::Oracle(const mlcp_problem* problem, const mlcp_mask* final_mask) : problem_(problem) {
  active_.state.assign(problem->problem.m(), MLCP_ROW_DISABLED);
  for (std::int32_t i = 0; i < problem->problem.m(); ++i)
    if (final_mask->mask.state[i] == MLCP_ROW_ACTIVE) active_.state[i] = MLCP_ROW_ACTIVE;
}

void Oracle::analyze() {
  analysis_.run(problem_->problem, &active_, true, {});
}

void Oracle::factorize_and_solve() {
  basis_.prepare(problem_->problem, analysis_, settings_);
  basis_.set.start(problem_->problem, analysis_.pattern, basis_.values, &active_, &active_);
  for (const mlcp::Island& island : analysis_.symbolic.islands) {
    basis_.refactorize(island, mlcp::lost_pivot, counts_);
    std::copy(basis_.values.b.begin() + island.first, basis_.values.b.begin() + island.last, basis_.set.x.begin() + island.first);
    basis_.factor.solve(island, basis_.set.x.data(), counts_.work);
  }
}

double Oracle::median_seconds() {
  analyze();
  std::array<double, 5> seconds;
  for (double& one : seconds) {
    const double start = wall_seconds();
    factorize_and_solve();
    one = wall_seconds() - start;
  }
  std::nth_element(seconds.begin(), seconds.begin() + 2, seconds.end());
  return seconds[2];
}

}  // namespace bench
