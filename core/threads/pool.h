#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "memory/array.h"
#include "mlcp.h"
#include "threads/poll.h"

namespace mlcp {

/// Threads that wait for one fork and join at a time; the caller works too. A library of task pools would bring its own threads into the
/// engine's process for this one loop: whoever has such a pool passes it as parallel_for.
///
/// Who waits looks for some tens of microseconds, about a fork's length, and then sleeps. Nobody waits for a thread that has not come: what it
/// would have done is done by the others.
class Pool {
 public:
  explicit Pool(const Memory& m) : memory_(m) {}
  ~Pool() { stop(); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// threads: in all, the caller among them. Starts or stops what is needed; fewer if the system has no more to give.
  void resize(std::int32_t threads);
  std::int32_t threads() const { return helpers_ + 1; }

  /// task(data, index, worker) for index 0 .. count − 1, in any order on any thread; equal counts mostly find the same threads, with what the last tasks have
  /// left in their caches. before: task does not throw.
  /// wakes: threads that sleep are called too, which costs the caller 5 to 10 µs, and them 50 to 100 until they come. Otherwise only if the last fork ended
  /// so recently that they would still look if they had taken part in it.
  /// waiting(context): called by the caller every so often while others still work; what it returns is for them to see.
  void run(std::int32_t count, bool wakes, mlcp_task task, void* data, Poll::Ask waiting = nullptr, void* context = nullptr);

 private:
  /// The caller or a helper, and what is left of the tasks that are its own: next .. end − 1.
  struct Worker {
    std::atomic<std::int32_t> next = 0;
    std::int32_t end = 0;
    std::thread thread;   // the caller's is none
    std::byte apart[48];  // from what others count
  };
  static constexpr std::uint64_t inside = 0xffffffff, open = inside + 1, one_fork = 2 * open, the_end = ~std::uint64_t{0};

  void stop();
  void wake();
  void work(std::int32_t worker);
  /// Whether there is a fork since `seen`, or the end.
  bool called(std::uint64_t seen) const;
  /// Becomes one of those inside, unless it is too late.
  bool enter(std::uint64_t& seen);
  void leave();
  void take(std::int32_t worker);
  void join(Poll::Ask waiting, void* context);

  Memory memory_;
  Worker* worker_ = nullptr;  // the caller first
  std::int32_t helpers_ = 0, capacity_ = 0;
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  /// Forks so far · one_fork + open while there may be tasks left + helpers inside; the_end.
  std::atomic<std::uint64_t> gate_ = 0;
  std::atomic<std::int32_t> sleepers_ = 0;
  std::atomic<bool> caller_sleeps_ = false;
  std::chrono::steady_clock::time_point joined_{};  // the last fork
  mlcp_task task_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace mlcp
