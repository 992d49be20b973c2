#include "solve/limits.h"

#include <gtest/gtest.h>

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

TEST(Limits, NothingSetStopsAfterFiftyPivotsARow) {
  const mlcp::Settings settings = mlcp::default_settings();
  mlcp::Limits limits(settings);
  limits.enter_island(0, 4);
  mlcp::Counts counts;
  EXPECT_EQ(limits.check(counts, 1), MLCP_SOLVED);
  counts.pivots = 50 * (4 + 10) - 1;
  EXPECT_EQ(limits.check(counts, 1), MLCP_SOLVED);
  ++counts.pivots;
  EXPECT_EQ(limits.check(counts, 1), MLCP_ITERATION_LIMIT);
}

TEST(Limits, PivotsAreCountedByIsland) {
  mlcp::Settings settings = mlcp::default_settings();
  settings.max_iterations = 5;
  mlcp::Limits limits(settings);
  mlcp::Counts counts;
  limits.enter_island(0, 1);
  EXPECT_EQ(limits.check(counts, 1), MLCP_SOLVED);
  counts.pivots = 5;
  EXPECT_EQ(limits.check(counts, 1), MLCP_ITERATION_LIMIT);
  limits.enter_island(1, 1);
  EXPECT_EQ(limits.check(counts, 1), MLCP_SOLVED) << "one bad island spoils no other";
  counts.pivots = 10;
  EXPECT_EQ(limits.check(counts, 1), MLCP_ITERATION_LIMIT);
}

TEST(Limits, WorkStopsTheWholeSolve) {
  mlcp::Settings settings = mlcp::default_settings();
  settings.max_work = 100;
  mlcp::Limits limits(settings);
  mlcp::Counts counts;
  limits.enter_island(0, 1);
  counts.work = 99;
  EXPECT_EQ(limits.check(counts, 1), MLCP_SOLVED);
  counts.work = 100;
  EXPECT_EQ(limits.check(counts, 1), MLCP_WORK_LIMIT);
  limits.enter_island(1, 1);
  counts.work = 0;
  EXPECT_EQ(limits.check(counts, 1), MLCP_WORK_LIMIT);
}

TEST(Limits, TimeThatHasPassed) {
  mlcp::Settings settings = mlcp::default_settings();
  settings.max_seconds = 1e-12;
  mlcp::Limits limits(settings);
  limits.enter_island(0, 1);
  EXPECT_EQ(limits.check({}, 1), MLCP_TIME_LIMIT);
}

TEST(Limits, ProgressHearsWhatIsAndMayStop) {
  Heard heard;
  heard.stop_at = 2;
  mlcp::Settings settings = mlcp::default_settings();
  settings.progress = hear;
  settings.progress_context = &heard;
  mlcp::Limits limits(settings);
  limits.set_islands(7);
  limits.enter_island(3, 1000);
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
  limits.enter_island(4, 1);
  EXPECT_EQ(limits.check(counts, 0.5), MLCP_INTERRUPTED);
  EXPECT_EQ(heard.calls.size(), 2u) << "not asked again";
}

}  // namespace
}  // namespace support
