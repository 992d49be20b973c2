#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "solve/settings.h"

namespace mlcp {

/// What a solve did.
struct Counts {
  std::int64_t pivots = 0, toggles = 0, factorizations = 0, refinements = 0, work = 0;
  std::int32_t drifts = 0;        ///< refactorizations because the factor had drifted
  double seconds_factorize = 0;

  Counts& operator+=(const Counts& other);
};

/// The clock and the stop of one solve, shared by the threads that work on its islands.
class Watch {
 public:
  explicit Watch(const Settings& settings) : settings_(settings) {}
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  friend class Limits;
  using Clock = std::chrono::steady_clock;
  const Settings& settings_;
  const Clock::time_point start_ = Clock::now();
  const std::thread::id caller_ = std::this_thread::get_id();  // progress is reported on this thread alone
  std::atomic<mlcp_outcome> stopped_ = MLCP_SOLVED;            // ends every island
};

/// When to stop one island before its end. Iterations and work are counted by island, so that the answer does not depend on the threads; the clock
/// is read for the time limit and the progress report alone.
class Limits {
 public:
  Limits(Watch& watch, std::int32_t island, std::int32_t islands, std::int64_t default_iterations)
      : watch_(watch), island_(island), islands_(islands),
        most_iterations_(watch.settings_.max_iterations > 0 ? watch.settings_.max_iterations : default_iterations) {}

  /// The iterations and the work counted so far do not count.
  void restart(const Counts& counts) {
    first_pivot_ = counts.pivots;
    first_work_ = counts.work;
  }
  /// MLCP_SOLVED: go on. cost: a clock reading every few calls, none without a limit or a callback.
  mlcp_outcome check(const Counts& counts, double violation);

 private:
  Watch& watch_;
  std::int32_t island_, islands_, calls_ = 0;
  std::int64_t first_pivot_ = 0, first_work_ = 0, most_iterations_;
};

}  // namespace mlcp
