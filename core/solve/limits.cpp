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

mlcp_outcome Watch::look() {
  const bool reports = settings_.progress && std::this_thread::get_id() == caller_;
  if (stopped_ != MLCP_SOLVED || !(reports || settings_.max_seconds > 0)) return stopped_;
  const double now = seconds();
  if (settings_.max_seconds > 0 && now >= settings_.max_seconds) return stopped_ = MLCP_TIME_LIMIT;
  if (!reports) return stopped_;
  now_.seconds = now;
  if (settings_.progress(settings_.progress_context, &now_)) stopped_ = MLCP_INTERRUPTED;
  return stopped_;
}

mlcp_outcome Watch::check(const mlcp_progress& now) {
  if (!settings_.progress || std::this_thread::get_id() != caller_) return settings_.max_seconds > 0 ? look() : stopped_.load();
  now_ = now;
  return checks_++ % 16 == 0 || settings_.max_seconds > 0 ? look() : stopped_.load();
}

mlcp_outcome Limits::check(const Counts& counts, double violation) {
  const Settings& s = watch_.settings();
  if (counts.pivots - first_pivot_ >= most_iterations_) return MLCP_ITERATION_LIMIT;
  if (s.max_work > 0 && counts.work - first_work_ >= s.max_work) return MLCP_WORK_LIMIT;
  return watch_.check({sizeof(mlcp_progress), 0, counts.pivots, counts.work, island_, islands_, violation});
}

}  // namespace mlcp
