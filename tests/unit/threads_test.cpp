// Islands on several threads: every task once, the same bits, errors that come back.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>
#include <vector>

#include "support/random_problem.h"
#include "support/solution.h"
#include "threads/pool.h"

namespace support {
namespace {

struct Calls {
  std::vector<std::atomic<int>> of;
  std::atomic<int> workers = 0;
  explicit Calls(int count) : of(count) {}
};

void count_call(void* data, std::int32_t index, std::int32_t worker) {
  auto& calls = *static_cast<Calls*>(data);
  ++calls.of[index];
  calls.workers |= 1 << worker;
}

TEST(Pool, EveryTaskOnce) {
  mlcp::Pool pool{mlcp::Memory()};
  for (const int threads : {1, 2, 4, 3}) {
    pool.resize(threads);
    ASSERT_EQ(pool.threads(), threads);
    for (int round = 0; round < 200; ++round) {
      Calls calls(round);
      pool.run(round, round % 2 == 0, count_call, &calls);
      for (const auto& called : calls.of) ASSERT_EQ(called, 1) << round;
      ASSERT_LT(calls.workers, 1 << threads);
    }
  }
}

TEST(Pool, TheCallerIsAskedWhileItWaitsForOthers) {
  mlcp::Pool pool{mlcp::Memory()};
  pool.resize(2);
  ASSERT_EQ(pool.threads(), 2);
  struct Two {
    std::atomic<bool> helping = false, asked = false;
  } two;
  const auto task = [](void* data, std::int32_t, std::int32_t worker) {
    Two& t = *static_cast<Two*>(data);
    if (worker > 0) t.helping = true;
    while (!(worker > 0 ? t.asked : t.helping)) std::this_thread::yield();
  };
  const auto ask = [](void* context) { return static_cast<Two*>(context)->asked = true; };
  pool.run(2, true, task, &two, ask, &two);
  EXPECT_TRUE(two.asked);
}

TEST(Pool, WhoSleepsCostsNothingAndIsNotWaitedFor) {
  mlcp::Pool pool{mlcp::Memory()};
  pool.resize(3);
  Calls first(30), second(30), third(30);
  pool.run(30, true, count_call, &first);
  const std::clock_t before = std::clock();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_LT(std::clock() - before, CLOCKS_PER_SEC / 50) << "of all threads";
  pool.run(30, false, count_call, &second);
  EXPECT_EQ(second.workers, 1) << "the caller alone";
  pool.run(30, true, count_call, &third);
  for (int t = 0; t < 30; ++t) EXPECT_EQ(first.of[t] + second.of[t] + third.of[t], 3) << t;
}

/// Chains that nothing couples.
mlcp::Problem islands(int count) {
  mlcp::Problem p = empty_problem();
  Random random(11);
  Eigen::VectorXd k(3 * 8 * count);
  for (int i = 0; i < count; ++i)
    for (int b = 0; b < 8; ++b) {
      add_body(p, random_mass(random, 3, false));
      const int first = 3 * (8 * i + b);
      for (int j = 0; j < 3; ++j) k[first + j] = random.uniform() - 0.7;
    }
  set_k(p, k);
  for (int i = 0; i < count; ++i)
    for (int b = 0; b < 8; ++b) {
      const int first = 3 * (8 * i + b);
      add_row(p, {{first, 1}, {first + 1, 0.3}});
      if (b > 0) add_row(p, {{first, 1}, {first + 2, 0.5}, {first - 3, -1}, {first - 1, 0.2}}, 0, b % 3 ? bilateral : unilateral);
    }
  return p;
}

TEST(Threads, NumberDoesNotChangeTheBits) {
  const mlcp::Problem p = islands(60);
  for (const mlcp_method method : {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_PGS, MLCP_METHOD_AUTO}) {
    mlcp::Settings how = mlcp::default_settings();
    how.method = method;
    const Solution one = solve(p, how);
    EXPECT_EQ(one.report.islands, 60);
    for (const int threads : {2, 4, 0}) {
      how.num_threads = threads;
      const Solution s = solve(p, how);
      EXPECT_EQ(s.v, one.v) << method << ", " << threads << " threads";
      EXPECT_EQ(s.gamma, one.gamma) << method << ", " << threads << " threads";
      EXPECT_EQ(s.report.work, one.report.work) << method << ", " << threads << " threads";
      EXPECT_EQ(s.report.pivots, one.report.pivots) << method << ", " << threads << " threads";
    }
  }
}

struct Backwards {
  int forks = 0, tasks = 0;
};

void run_backwards(void* context, std::int32_t count, mlcp_task task, void* data) {
  auto& seen = *static_cast<Backwards*>(context);
  ++seen.forks;
  seen.tasks += count;
  while (count-- > 0) task(data, count, 0);
}

TEST(Threads, CallersParallelForRunsTheTasksInItsOwnOrder) {
  const mlcp::Problem p = islands(60);
  Backwards seen;
  mlcp::Settings how = mlcp::default_settings();
  how.parallel_for = run_backwards;
  how.parallel_context = &seen;
  const Solution s = solve(p, how), one = solve(p);
  EXPECT_EQ(s.v, one.v);
  EXPECT_EQ(s.gamma, one.gamma);
  EXPECT_EQ(seen.forks, 1);
  EXPECT_GT(seen.tasks, 1);
}

/// Three threads that take tasks as they come.
void run_on_threads(void*, std::int32_t count, mlcp_task task, void* data) {
  std::atomic<std::int32_t> next = 0;
  std::vector<std::thread> threads;
  for (std::int32_t worker = 0; worker < 3; ++worker)
    threads.emplace_back([&, worker] {
      for (std::int32_t index; (index = next++) < count;) task(data, index, worker);
    });
  for (std::thread& thread : threads) thread.join();
}

/// For the thread sanitizer.
TEST(Threads, CallersParallelForMayHaveThreads) {
  const mlcp::Problem p = islands(60);
  for (const mlcp_method method : {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO}) {
    mlcp::Settings how = mlcp::default_settings();
    how.method = method;
    const Solution one = solve(p, how);
    how.parallel_for = run_on_threads;
    const Solution s = solve(p, how);
    EXPECT_EQ(s.v, one.v) << method;
    EXPECT_EQ(s.gamma, one.gamma) << method;
  }
}

TEST(Threads, CertificatesOfSeveralIslands) {
  mlcp::Problem p = islands(20);
  for (const int island : {3, 12, 17}) {
    add_row(p, {{24 * island, 1}}, 1);
    add_row(p, {{24 * island, -1}}, 1);
  }
  mlcp::Settings how = mlcp::default_settings();
  const Solution one = solve(p, how);
  how.num_threads = 4;
  const Solution s = solve(p, how);
  EXPECT_EQ(s.report.outcome, MLCP_INFEASIBLE);
  EXPECT_EQ(s.report.islands_failed, 3);
  EXPECT_EQ(s.island_outcome, one.island_outcome);
  EXPECT_EQ(s.certificate_row, one.certificate_row);
  EXPECT_EQ(s.certificate_y, one.certificate_y);
  EXPECT_EQ(s.v, one.v);
}

}  // namespace
}  // namespace support
