#include "threads/pool.h"

#include <chrono>
#include <new>
#include <system_error>

namespace mlcp {
namespace {

/// Looks before a thread goes to sleep: a solve of many small islands lasts no longer than waking a thread.
constexpr int patience = 4000;
constexpr std::chrono::milliseconds nap(10);

inline void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

void Pool::resize(std::int32_t threads) {
  if (threads == this->threads()) return;
  stop();
  if (threads <= 1) return;
  thread_ = static_cast<std::thread*>(memory_.reallocate(nullptr, 0, (threads - 1) * sizeof(std::thread)));
  capacity_ = threads - 1;
  round_ = 0;
  try {
    for (; helpers_ < capacity_; ++helpers_) new (thread_ + helpers_) std::thread(&Pool::work, this, helpers_ + 1);
  } catch (const std::system_error&) {  // those that there are will do
  }
}

void Pool::stop() {
  {
    const std::lock_guard lock(mutex_);
    round_ = -1;
  }
  wake_.notify_all();
  for (std::int32_t t = 0; t < helpers_; ++t) {
    thread_[t].join();
    thread_[t].~thread();
  }
  memory_.release(thread_, capacity_ * sizeof(std::thread));
  thread_ = nullptr;
  helpers_ = capacity_ = 0;
}

void Pool::take(std::int32_t worker) {
  for (std::int32_t index; (index = next_.fetch_add(1)) < count_;) task_(data_, index, worker);
}

void Pool::work(std::int32_t worker) {
  for (std::int64_t seen = 0;;) {
    for (int look = 0; look < patience && round_ == seen; ++look) pause();
    if (round_ == seen) {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return round_ != seen; });
    }
    seen = round_;
    if (seen < 0) return;
    take(worker);
    if (busy_.fetch_sub(1) == 1) {
      const std::lock_guard lock(mutex_);
      done_.notify_one();
    }
  }
}

void Pool::run(std::int32_t count, mlcp_task task, void* data, Poll::Ask waiting, void* context) {
  {
    const std::lock_guard lock(mutex_);
    task_ = task;
    data_ = data;
    count_ = count;
    next_ = 0;
    busy_ = helpers_;
    ++round_;
  }
  wake_.notify_all();
  take(0);
  for (int look = 0; look < patience && busy_ > 0; ++look) pause();
  std::unique_lock lock(mutex_);
  while (!done_.wait_for(lock, nap, [&] { return busy_ == 0; })) {
    if (!waiting) continue;
    lock.unlock();
    waiting(context);
    lock.lock();
  }
}

}  // namespace mlcp
