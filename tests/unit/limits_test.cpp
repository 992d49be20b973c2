#include "solve/limits.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace support {
namespace {

struct Heard {
  std::vector<mlcp_progress> calls;
  int stop_at = -1;
};

std::int32_t hear(void* context, const mlcp_progress* progress) {
  auto* heard = static_cast<Heard*>(context);
  heard->calls.push_back(*progress);
  return static_cast<int>(heard->calls.size()) == heard->stop_at;
}

mlcp::Settings with_iterations(std::int64_t most) {
  mlcp::Settings settings = mlcp::default_settings();
  settings.max_iterations = most;
  return settings;
}

TEST(Limits, NothingSetStopsAfterTheMethodsOwnNumber) {
  const mlcp::Settings settings = mlcp::default_settings();
  mlcp::Watch watch(settings);
  mlcp::Limits limits(watch, 0, 1, 700);
  mlcp::Counts counts;
  EXPECT_EQ(limits.check(counts, 1), MLCP_SOLVED);
  counts.pivots = 699;
  EXPECT_EQ(limits.check(counts, 1), MLCP_SOLVED);
  ++counts.pivots;
  EXPECT_EQ(limits.check(counts, 1), MLCP_ITERATION_LIMIT);
}

TEST(Limits, IterationsAreCountedFromTheRestart) {
  const mlcp::Settings settings = with_iterations(5);
  mlcp::Watch watch(settings);
  mlcp::Limits limits(watch, 0, 2, 700);
  mlcp::Counts counts;
  counts.pivots = 5;
  EXPECT_EQ(limits.check(counts, 1), MLCP_ITERATION_LIMIT);
  limits.restart(counts);
  EXPECT_EQ(limits.check(counts, 1), MLCP_SOLVED);
  counts.pivots = 10;
  EXPECT_EQ(limits.check(counts, 1), MLCP_ITERATION_LIMIT);
  EXPECT_EQ(mlcp::Limits(watch, 1, 2, 700).check({}, 1), MLCP_SOLVED) << "one bad island spoils no other";
}

TEST(Limits, WorkIsCountedByIsland) {
  mlcp::Settings settings = mlcp::default_settings();
  settings.max_work = 100;
  mlcp::Watch watch(settings);
  mlcp::Limits limits(watch, 0, 2, 700);
  mlcp::Counts counts;
  counts.work = 99;
  EXPECT_EQ(limits.check(counts, 1), MLCP_SOLVED);
  counts.work = 100;
  EXPECT_EQ(limits.check(counts, 1), MLCP_WORK_LIMIT);
  EXPECT_EQ(mlcp::Limits(watch, 1, 2, 700).check({}, 1), MLCP_SOLVED) << "or the answer would depend on the threads";
}

TEST(Limits, TimeThatHasPassedStopsEveryIsland) {
  mlcp::Settings settings = mlcp::default_settings();
  settings.max_seconds = 1e-12;
  mlcp::Watch watch(settings);
  EXPECT_EQ(mlcp::Limits(watch, 0, 2, 700).check({}, 1), MLCP_TIME_LIMIT);
  EXPECT_EQ(mlcp::Limits(watch, 1, 2, 700).check({}, 1), MLCP_TIME_LIMIT);
}

TEST(Limits, ProgressHearsWhatIsAndMayStop) {
  Heard heard;
  heard.stop_at = 2;
  mlcp::Settings settings = mlcp::default_settings();
  settings.progress = hear;
  settings.progress_context = &heard;
  mlcp::Watch watch(settings);
  mlcp::Limits limits(watch, 3, 7, 700);
  mlcp::Counts counts;
  counts.pivots = 11;
  counts.work = 22;
  EXPECT_EQ(limits.check(counts, 0.5), MLCP_SOLVED);
  ASSERT_EQ(heard.calls.size(), 1u);
  EXPECT_EQ(heard.calls[0].struct_size, sizeof(mlcp_progress));
  EXPECT_EQ(heard.calls[0].pivots, 11);
  EXPECT_EQ(heard.calls[0].work, 22);
  EXPECT_EQ(heard.calls[0].island, 3);
  EXPECT_EQ(heard.calls[0].islands, 7);
  EXPECT_EQ(heard.calls[0].violation, 0.5);
  mlcp_outcome outcome = MLCP_SOLVED;
  for (int s = 0; s < 1000 && outcome == MLCP_SOLVED; ++s) outcome = limits.check(counts, 0.5);
  EXPECT_EQ(outcome, MLCP_INTERRUPTED);
  EXPECT_EQ(heard.calls.size(), 2u);
  EXPECT_EQ(mlcp::Limits(watch, 4, 7, 700).check(counts, 0.5), MLCP_INTERRUPTED);
  EXPECT_EQ(heard.calls.size(), 2u) << "not asked again";
}

TEST(Limits, ProgressIsHeardOnTheThreadThatStartedTheSolve) {
  Heard heard;
  mlcp::Settings settings = mlcp::default_settings();
  settings.progress = hear;
  settings.progress_context = &heard;
  mlcp::Watch watch(settings);
  std::thread([&] { EXPECT_EQ(mlcp::Limits(watch, 0, 1, 700).check({}, 1), MLCP_SOLVED); }).join();
  EXPECT_TRUE(heard.calls.empty());
}

}  // namespace
}  // namespace support
