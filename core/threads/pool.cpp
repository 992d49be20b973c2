#include "threads/pool.h"

#include <new>
#include <system_error>

namespace mlcp {
namespace {

/// Of looks before a thread goes to sleep: about what waking it takes, so that this at most doubles what a wait costs.
constexpr std::chrono::microseconds patience(50);
constexpr int looks_a_time = 64;
constexpr std::chrono::milliseconds nap(10);

inline void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Whether something has come true while it had patience.
template <class Condition>
bool look_for(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + patience;
  do {
    for (int look = 0; look < looks_a_time; ++look) {
      if (condition()) return true;
      pause();
    }
    std::this_thread::yield();  // whoever it waits for may stand in line for this CPU
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

}  // namespace

void Pool::resize(std::int32_t threads) {
  if (threads == this->threads()) return;
  stop();
  if (threads <= 1) return;
  worker_ = static_cast<Worker*>(memory_.reallocate(nullptr, 0, threads * sizeof(Worker)));
  capacity_ = threads;
  for (std::int32_t w = 0; w < threads; ++w) new (worker_ + w) Worker;
  gate_ = 0;
  try {
    for (; helpers_ + 1 < threads; ++helpers_) worker_[helpers_ + 1].thread = std::thread(&Pool::work, this, helpers_ + 1);
  } catch (const std::system_error&) {  // those that there are will do
  }
}

void Pool::stop() {
  if (!worker_) return;
  gate_ = the_end;
  wake();
  for (std::int32_t w = 0; w < capacity_; ++w) {
    if (worker_[w].thread.joinable()) worker_[w].thread.join();
    worker_[w].~Worker();
  }
  memory_.release(worker_, capacity_ * sizeof(Worker));
  worker_ = nullptr;
  helpers_ = capacity_ = 0;
}

void Pool::wake() {
  if (sleepers_ == 0) return;
  { const std::lock_guard lock(mutex_); }  // whoever counts as a sleeper waits by now
  wake_.notify_all();
}

/// Its own tasks, then what the others have left of theirs.
void Pool::take(std::int32_t worker) {
  const std::int32_t workers = threads();
  for (std::int32_t k = 0; k < workers; ++k) {
    Worker& owner = worker_[(worker + k) % workers];
    for (std::int32_t index; (index = owner.next.fetch_add(1, std::memory_order_relaxed)) < owner.end;) task_(data_, index, worker);
  }
}

void Pool::work(std::int32_t worker) {
  for (std::uint64_t seen = 0; seen != the_end;) {
    if (!look_for([&] { return called(seen); })) {
      std::unique_lock lock(mutex_);
      ++sleepers_;
      wake_.wait(lock, [&] { return called(seen); });
      --sleepers_;
    }
    if (!enter(seen)) continue;
    take(worker);
    leave();
  }
}

bool Pool::called(std::uint64_t seen) const {
  const std::uint64_t gate = gate_;
  return gate == the_end || (gate & open && gate / one_fork != seen / one_fork);
}

bool Pool::enter(std::uint64_t& seen) {
  std::uint64_t gate = gate_;
  do {
    if (gate == the_end) seen = the_end;
    if (gate == the_end || !(gate & open)) return false;
  } while (!gate_.compare_exchange_weak(gate, gate + 1));
  seen = gate;
  return true;
}

void Pool::leave() {
  if ((gate_.fetch_sub(1) - 1) & (open | inside) || !caller_sleeps_) return;
  { const std::lock_guard lock(mutex_); }
  done_.notify_one();
}

void Pool::run(std::int32_t count, bool wakes, mlcp_task task, void* data, Poll::Ask waiting, void* context) {
  if (helpers_ == 0) {
    for (std::int32_t index = 0; index < count; ++index) task(data, index, 0);
    return;
  }
  task_ = task;
  data_ = data;
  const std::int64_t workers = threads();
  for (std::int64_t w = 0; w < workers; ++w) {
    worker_[w].next = static_cast<std::int32_t>(count * w / workers);
    worker_[w].end = static_cast<std::int32_t>(count * (w + 1) / workers);
  }
  gate_ += one_fork + open;
  if (wakes || std::chrono::steady_clock::now() - joined_ < patience) wake();
  take(0);
  gate_ -= open;
  join(waiting, context);
  joined_ = std::chrono::steady_clock::now();
}

void Pool::join(Poll::Ask waiting, void* context) {
  const auto alone = [&] { return (gate_ & inside) == 0; };
  if (look_for(alone)) return;
  caller_sleeps_ = true;
  std::unique_lock lock(mutex_);
  while (!done_.wait_for(lock, nap, alone)) {
    if (!waiting) continue;
    lock.unlock();
    waiting(context);
    lock.lock();
  }
  caller_sleeps_ = false;
}

}  // namespace mlcp
