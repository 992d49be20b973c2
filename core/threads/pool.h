#pragma once
#include <atomic>
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
class Pool {
 public:
  explicit Pool(const Memory& m) : memory_(m) {}
  ~Pool() { stop(); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// threads: in all, the caller among them. Starts or stops what is needed; fewer if the system has no more to give.
  void resize(std::int32_t threads);
  std::int32_t threads() const { return helpers_ + 1; }

  /// task(data, index, worker) for index 0 .. count − 1, in any order on any thread. before: task does not throw.
  /// waiting(context): called by the caller every so often while others still work; what it returns is for them to see.
  void run(std::int32_t count, mlcp_task task, void* data, Poll::Ask waiting = nullptr, void* context = nullptr);

 private:
  void stop();
  void work(std::int32_t worker);
  void take(std::int32_t worker);

  Memory memory_;
  std::thread* thread_ = nullptr;
  std::int32_t helpers_ = 0, capacity_ = 0;
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::atomic<std::int64_t> round_ = 0;  // a fork; −1: the end
  std::atomic<std::int32_t> next_ = 0, busy_ = 0;
  std::int32_t count_ = 0;
  mlcp_task task_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace mlcp
