#include "factor_bench.h"

#include <cmath>

namespace bench {

SolvedBasis::SolvedBasis(scenes::Problem problem, bool solve) : owner(std::move(problem)) {
  const mlcp::Problem& p = owner->problem;
  mlcp::Mask start(memory);
  if (solve) {
    mlcp::Solver solver(settings, memory);
    mlcp_report report{};
    solver.solve(p, nullptr, nullptr, report);
    start = solver.result().mask;
  } else {
    start.state.assign(p.m(), MLCP_ROW_ACTIVE);
  }
  analysis.run(p, nullptr, true, {});
  basis.prepare(p, analysis, settings);
  basis.set.start(p, analysis.pattern, basis.values, nullptr, &start);
  for (const mlcp::Island& island : analysis.symbolic.islands) basis.refactorize(island, mlcp::lost_pivot, counts);
}

const mlcp::Island& SolvedBasis::largest() const {
  const auto& islands = analysis.symbolic.islands;
  return *std::max_element(islands.begin(), islands.end(), [](const auto& a, const auto& b) { return a.last - a.first < b.last - b.first; });
}

double SolvedBasis::drift(const mlcp::Island& island) {
  std::vector<double> toggled(basis.values.b.begin(), basis.values.b.end()), fresh = toggled;
  basis.factor.solve(island, toggled.data(), counts.work);
  basis.refactorize(island, mlcp::lost_pivot, counts);
  basis.factor.solve(island, fresh.data(), counts.work);
  double difference = 0, size = 0;
  for (std::int32_t q = island.first; q < island.last; ++q) {
    difference = std::max(difference, std::abs(toggled[q] - fresh[q]));
    size = std::max(size, std::abs(fresh[q]));
  }
  return size > 0 ? difference / size : difference;
}

}  // namespace bench
