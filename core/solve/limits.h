#pragma once
#include <chrono>
#include <cstdint>

#include "solve/settings.h"

namespace mlcp {

/// What a solve did.
struct Counts {
  std::int64_t pivots = 0, toggles = 0, factorizations = 0, refinements = 0, work = 0;
  std::int32_t drifts = 0;        ///< refactorizations because the factor had drifted
  double seconds_factorize = 0;
};

/// When to stop before the end. The clock is read for the time limit and the progress report alone.
class Limits {
 public:
  explicit Limits(const Settings& settings) : settings_(settings) {}
  void set_islands(std::int32_t islands) { islands_ = islands; }
  void enter_island(std::int32_t island, std::int32_t rows);

  /// MLCP_SOLVED: go on. cost: a clock reading every few calls, none without a limit or a callback.
  mlcp_outcome check(const Counts& counts, double violation);
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  const Settings& settings_;
  Clock::time_point start_ = Clock::now();
  std::int32_t island_ = 0, islands_ = 0, calls_ = 0;
  std::int64_t first_pivot_ = -1, most_pivots_ = 0;
  mlcp_outcome stopped_ = MLCP_SOLVED;
};

}  // namespace mlcp
