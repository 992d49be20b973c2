#pragma once
#include <cstdint>

namespace mlcp {

/// Thrown out of a long loop that was told to stop.
struct Stopped {};

/// Asks now and then, from inside a long loop, whether to go on. Each loop has a copy of its own.
class Poll {
 public:
  /// true: stop
  using Ask = bool (*)(void* context);

  Poll() = default;
  Poll(Ask ask, void* context) : ask_(ask), context_(context) {}

  /// Counts entries touched, and asks every few milliseconds of them.  throws: Stopped.
  void spend(std::int64_t entries) {
    left_ -= entries;
    if (left_ < 0) look();
  }
  void look() {
    left_ = interval;
    if (ask_ && ask_(context_)) throw Stopped();
  }

 private:
  static constexpr std::int64_t interval = 1'000'000;
  Ask ask_ = nullptr;
  void* context_ = nullptr;
  std::int64_t left_ = interval;
};

}  // namespace mlcp
