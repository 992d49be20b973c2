#pragma once
#include <atomic>
#include <exception>

#include "solve/limits.h"
#include "threads/pool.h"

namespace mlcp {

/// Who works on the islands: the caller's parallel_for, our pool, or this thread.
class Crew {
 public:
  Crew(Watch& watch, Pool& pool) : watch_(watch), pool_(pool) {}

  /// task(s) for island s = 0 .. count − 1, neighbouring ones in turn on one thread until cost(s) adds up to what is worth its attention. One task may
  /// throw bad_alloc or Error, which is thrown again when all have ended.  firsts: scratch.  alone: all in turn on this thread.
  template <class Cost, class Task>
  void run(std::int32_t count, Array<std::int32_t>& firsts, bool alone, Cost cost, Task task);

 private:
  static constexpr std::int64_t least_cost = 500;
  /// Below, about 150 µs, nearly all is done by the time that a sleeping thread has come.
  static constexpr std::int64_t worth_waking = 60'000;
  template <class Task>
  void fork(std::int32_t count, bool wakes, Task task);

  Watch& watch_;
  Pool& pool_;
};

template <class Cost, class Task>
void Crew::run(std::int32_t count, Array<std::int32_t>& firsts, bool alone, Cost cost, Task task) {
  if (alone || (!watch_.settings().parallel_for && pool_.threads() <= 1)) {
    for (std::int32_t s = 0; s < count; ++s) task(s);
    return;
  }
  firsts.clear();
  std::int64_t filled = least_cost, total = 0;
  for (std::int32_t s = 0; s < count; ++s) {
    if (filled >= least_cost) {
      firsts.push_back(s);
      filled = 0;
    }
    const std::int64_t more = cost(s);
    filled += more;
    total += more;
  }
  const auto tasks = static_cast<std::int32_t>(firsts.size());
  firsts.push_back(count);
  fork(tasks, total >= worth_waking, [&](std::int32_t t) {
    for (std::int32_t s = firsts[t]; s < firsts[t + 1]; ++s) task(s);
  });
}

template <class Task>
void Crew::fork(std::int32_t count, bool wakes, Task task) {
  if (count <= 1) {
    if (count == 1) task(0);
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
  const Settings& settings = watch_.settings();
  if (settings.parallel_for)
    settings.parallel_for(settings.parallel_context, count, run_one, &call);
  else
    pool_.run(count, wakes, run_one, &call, &Watch::ask, &watch_);
  if (call.error) std::rethrow_exception(call.error);
}

}  // namespace mlcp
