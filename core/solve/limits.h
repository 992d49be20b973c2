#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "solve/settings.h"
#include "threads/poll.h"

namespace mlcp {

/// What a solve did.
struct Counts {
  std::int64_t pivots = 0, toggles = 0, factorizations = 0, refinements = 0, work = 0;
  std::int32_t drifts = 0;        ///< refactorizations because the factor had drifted
  double seconds_factorize = 0;

  Counts& operator+=(const Counts& other);
};

/// The clock, the progress report and the stop of one solve, shared by the threads that work on its islands.
class Watch {
 public:
  explicit Watch(const Settings& settings) : settings_(settings) {}
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  const Settings& settings() const { return settings_; }

  /// What has stopped the solve, SOLVED: nothing.
  mlcp_outcome stopped() const { return stopped_; }
  /// Reads the clock if there is a limit; reports the last state told, on the caller's thread.  returns as stopped().
  mlcp_outcome look();
  /// Tells the state of an island and looks, at the clock always and at the caller every so often.  cost: nothing without a limit or a report.
  mlcp_outcome check(const mlcp_progress& now);
  /// For loops without a state of their own: look() every few milliseconds.
  Poll poll() { return {&ask, this}; }
  static bool ask(void* watch) { return static_cast<Watch*>(watch)->look() != MLCP_SOLVED; }

 private:
  using Clock = std::chrono::steady_clock;
  const Settings& settings_;
  const Clock::time_point start_ = Clock::now();
  const std::thread::id caller_ = std::this_thread::get_id();  // progress is reported on this thread alone
  std::atomic<mlcp_outcome> stopped_ = MLCP_SOLVED;            // ends every island
  mlcp_progress now_{sizeof(mlcp_progress), 0, 0, 0, 0, 0, 0};  // the caller's thread's
  std::int64_t checks_ = 0;                                     // likewise
};

/// When to stop one island before its end. Iterations and work are counted by island, so that the answer does not depend on the threads; the clock
/// is read for the time limit and the progress report alone.
class Limits {
 public:
  Limits(Watch& watch, std::int32_t island, std::int32_t islands, std::int64_t default_iterations)
      : watch_(watch), island_(island), islands_(islands),
        most_iterations_(watch.settings().max_iterations > 0 ? watch.settings().max_iterations : default_iterations) {}

  /// The iterations and the work counted so far do not count.
  void restart(const Counts& counts) {
    first_pivot_ = counts.pivots;
    first_work_ = counts.work;
  }
  /// MLCP_SOLVED: go on.
  mlcp_outcome check(const Counts& counts, double violation);

 private:
  Watch& watch_;
  std::int32_t island_, islands_;
  std::int64_t first_pivot_ = 0, first_work_ = 0, most_iterations_;
};

}  // namespace mlcp
