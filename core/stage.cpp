#include "stage.h"

namespace mlcp {

void Stage::load(const SolveInput& input, const Mask* start) {
  basis.prepare(input.problem, analysis, input.settings);
  basis.contradiction = input.contradiction;
  basis.values.measure_together(analysis.pattern, analysis.symbolic.islands.span(), input.contact_of_row);
  basis.set.start(input.problem, analysis.pattern, basis.values, input.enabled, start);
}

void Stage::solve(const SolveInput& input, Watch& watch, Crew& crew, bool warm, Result& result) {
  const auto& islands = analysis.symbolic.islands;
  const auto count = static_cast<std::int32_t>(islands.size());
  check_.prepare(input.problem);
  basis.factor.ask(watch.poll());
  ends.resize(count);
  Array<mlcp_pivot>* trace = input.settings.trace ? &result.trace : nullptr;
  const auto cost = [&](std::int32_t s) { return 10 + analysis.symbolic.pointers[islands[s].last] - analysis.symbolic.pointers[islands[s].first]; };
  // a trace is written in order
  crew.run(count, tasks_, trace != nullptr, cost, [&](std::int32_t s) {
    ends[s] = solve_island(input, basis, check_, watch, s, warm, trace);
    finish_island(input, basis, watch, s, result.redundant.data(), ends[s]);
  });
}

void Stage::solve_again(const SolveInput& input, Watch& watch, Crew& crew, const Mask& start, Result& result) {
  const auto& islands = analysis.symbolic.islands;
  const std::int32_t n = input.problem.n();
  check_.prepare(input.problem);
  basis.factor.ask(watch.poll());
  changed_.resize(islands.size());
  epsilon_.resize(islands.size());
  for (std::size_t s = 0; s < islands.size(); ++s) epsilon_[s] = ends[s].kept ? ends[s].epsilon : -1;
  Counts toggled;
  basis.reload(input.problem, changed_.span(), epsilon_.span(), toggled);
  Array<mlcp_pivot>* trace = input.settings.trace ? &result.trace : nullptr;
  const auto cost = [&](std::int32_t s) {
    return changed_[s] ? 10 + analysis.symbolic.pointers[islands[s].last] - analysis.symbolic.pointers[islands[s].first] : std::int64_t(1);
  };
  crew.run(static_cast<std::int32_t>(islands.size()), tasks_, trace != nullptr, cost, [&](std::int32_t s) {
    ends[s].counts = {};
    if (!changed_[s]) return;
    for (std::int32_t o = islands[s].first_row; o < islands[s].last_row; ++o) result.redundant[analysis.pattern.node[basis.position(o)] - n] = 0;
    ends[s].kept = epsilon_[s] >= 0;
    solve_island_again(input, basis, check_, watch, s, start, trace, ends[s]);
    finish_island(input, basis, watch, s, result.redundant.data(), ends[s]);
  });
  if (!ends.empty()) ends[0].counts += toggled;
}

bool Stage::settle(Watch& watch) {
  basis.factor.ask(watch.poll());
  bool good = true;
  Counts counts;
  for (const Island& island : analysis.symbolic.islands) {
    good &= basis.refactorize(island, lost_pivot, counts);
    if (good) basis.solve_point(island, counts);
  }
  return good;
}

void Stage::collect(const Problem& problem, bool only_rows, Result& result) const {
  for (const Island& island : analysis.symbolic.islands)
    if (!only_rows || island.first_row < island.last_row) collect(problem, island, result);
}

void Stage::collect(const Problem& problem, const Island& island, Result& result) const {
  const std::int32_t n = problem.n();
  const KktPattern& pattern = analysis.pattern;
  for (std::int32_t p = island.first; p < island.last; ++p) {
    const std::int32_t node = pattern.node[p];
    if (node < n) {
      result.v[node] = basis.set.x[p];
      continue;
    }
    const std::uint8_t state = basis.set.state[pattern.row_ordinal[p]];
    if (state == ActiveSet::disabled) continue;
    result.mask.state[node - n] = row_state(state);
    result.gamma[node - n] = basis.set.x[p] == 0 ? 0.0 : -basis.set.x[p];
  }
}

}  // namespace mlcp
