#include "stage.h"

#include <algorithm>
#include <atomic>
#include <exception>

namespace mlcp {
namespace {

mlcp_row_state row_state(std::uint8_t state) {
  switch (state) {
    case ActiveSet::at_lower: return MLCP_ROW_AT_LOWER;
    case ActiveSet::at_upper: return MLCP_ROW_AT_UPPER;
    case ActiveSet::disabled: return MLCP_ROW_DISABLED;
    default: return MLCP_ROW_ACTIVE;
  }
}

/// Islands of one task have at least so many entries of L between them: less is not worth a thread's attention.
constexpr std::int64_t least_task = 500;

}  // namespace

template <class Task>
void Crew::run(std::int32_t count, Task task) {
  const Settings& settings = watch_.settings();
  if (count <= 1 || (!settings.parallel_for && pool_.threads() <= 1)) {
    for (std::int32_t index = 0; index < count; ++index) task(index);
    return;
  }
  struct Call {
    Task& task;
    std::atomic_flag failed = {};
    std::exception_ptr error = nullptr;
  } call{task};
  const mlcp_task run_one = [](void* data, std::int32_t index, std::int32_t) {
    Call& c = *static_cast<Call*>(data);
    try {
      c.task(index);
    } catch (...) {
      if (!c.failed.test_and_set()) c.error = std::current_exception();
    }
  };
  if (settings.parallel_for)
    settings.parallel_for(settings.parallel_context, count, run_one, &call);
  else
    pool_.run(count, run_one, &call, &Watch::ask, &watch_);
  if (call.error) std::rethrow_exception(call.error);
}

void Stage::load(const SolveInput& input, const Mask* start) {
  basis.prepare(input.problem, analysis, input.settings);
  basis.set.start(input.problem, analysis.pattern, basis.values, input.enabled, start);
}

void Stage::solve(const SolveInput& input, Watch& watch, Crew& crew, bool warm, Result& result) {
  const auto& islands = analysis.symbolic.islands;
  const auto count = static_cast<std::int32_t>(islands.size());
  check_.prepare(input.problem);
  basis.factor.ask(watch.poll());
  ends.resize(count);
  Array<mlcp_pivot>* trace = input.settings.trace ? &result.trace : nullptr;
  // neighbouring islands in one task, by the size of their factors; a trace is written in order, on one thread
  tasks_.clear();
  std::int64_t filled = least_task;
  for (std::int32_t s = 0; s < count; ++s) {
    if (filled >= least_task && (tasks_.empty() || !trace)) {
      tasks_.push_back(s);
      filled = 0;
    }
    filled += 10 + analysis.symbolic.pointers[islands[s].last] - analysis.symbolic.pointers[islands[s].first];
  }
  const auto tasks = static_cast<std::int32_t>(tasks_.size());
  tasks_.push_back(count);
  crew.run(tasks, [&](std::int32_t t) {
    for (std::int32_t s = tasks_[t]; s < tasks_[t + 1]; ++s) {
      ends[s] = solve_island(input, basis, check_, watch, s, warm, trace);
      finish_island(input, basis, watch, s, result.redundant.data(), ends[s]);
    }
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
  crew.run(static_cast<std::int32_t>(tasks_.size()) - 1, [&](std::int32_t t) {
    for (std::int32_t s = tasks_[t]; s < tasks_[t + 1]; ++s) {
      ends[s].counts = {};
      if (!changed_[s]) continue;
      for (std::int32_t o = islands[s].first_row; o < islands[s].last_row; ++o) result.redundant[analysis.pattern.node[basis.position(o)] - n] = 0;
      ends[s].kept = epsilon_[s] >= 0;
      solve_island_again(input, basis, check_, watch, s, start, trace, ends[s]);
      finish_island(input, basis, watch, s, result.redundant.data(), ends[s]);
    }
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
  const std::int32_t n = problem.n();
  const KktPattern& pattern = analysis.pattern;
  for (const Island& island : analysis.symbolic.islands) {
    if (only_rows && island.first_row == island.last_row) continue;
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
}

}  // namespace mlcp
