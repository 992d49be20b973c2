#include "solve/limits.h"

namespace mlcp {

Counts& Counts::operator+=(const Counts& other) {
  pivots += other.pivots;
  toggles += other.toggles;
  factorizations += other.factorizations;
  refinements += other.refinements;
  work += other.work;
  drifts += other.drifts;
  seconds_factorize += other.seconds_factorize;
  return *this;
}

mlcp_outcome Limits::check(const Counts& counts, double violation) {
  if (const mlcp_outcome stopped = watch_.stopped_; stopped != MLCP_SOLVED) return stopped;
  const Settings& s = watch_.settings_;
  if (counts.pivots - first_pivot_ >= most_iterations_) return MLCP_ITERATION_LIMIT;
  if (s.max_work > 0 && counts.work - first_work_ >= s.max_work) return MLCP_WORK_LIMIT;
  if (s.max_seconds > 0 && watch_.seconds() >= s.max_seconds) return watch_.stopped_ = MLCP_TIME_LIMIT;
  if (s.progress && calls_++ % 16 == 0 && std::this_thread::get_id() == watch_.caller_) {
    const mlcp_progress now{sizeof(mlcp_progress), watch_.seconds(), counts.pivots, counts.work, island_, islands_, violation};
    if (s.progress(s.progress_context, &now)) return watch_.stopped_ = MLCP_INTERRUPTED;
  }
  return MLCP_SOLVED;
}

}  // namespace mlcp
