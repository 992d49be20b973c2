#include "solve/limits.h"

namespace mlcp {

void Limits::enter_island(std::int32_t island, std::int32_t rows) {
  island_ = island;
  first_pivot_ = -1;
  most_pivots_ = settings_.max_iterations > 0 ? settings_.max_iterations : 50 * (static_cast<std::int64_t>(rows) + 10);
}

double Limits::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

mlcp_outcome Limits::check(const Counts& counts, double violation) {
  if (stopped_ != MLCP_SOLVED) return stopped_;  // the whole solve, not just one island
  if (first_pivot_ < 0) first_pivot_ = counts.pivots;
  if (counts.pivots - first_pivot_ >= most_pivots_) return MLCP_ITERATION_LIMIT;
  if (settings_.max_work > 0 && counts.work >= settings_.max_work) return stopped_ = MLCP_WORK_LIMIT;
  if (settings_.max_seconds > 0 && seconds() >= settings_.max_seconds) return stopped_ = MLCP_TIME_LIMIT;
  if (settings_.progress && calls_++ % 16 == 0) {
    const mlcp_progress now{sizeof(mlcp_progress), seconds(), counts.pivots, counts.work, island_, islands_, violation};
    if (settings_.progress(settings_.progress_context, &now)) return stopped_ = MLCP_INTERRUPTED;
  }
  return MLCP_SOLVED;
}

}  // namespace mlcp
