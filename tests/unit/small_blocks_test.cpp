#include "memory/small_blocks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "memory/array.h"
#include "support/random.h"

namespace support {
namespace {

/// malloc that counts, and fails when told to.
struct Source {
  std::int64_t blocks = 0, calls = 0;
  bool fails = false;

  mlcp::Memory memory() {
    const mlcp_allocator hooks{this,
                               [](void* self, void* block, std::size_t, std::size_t size) -> void* {
                                 Source& s = *static_cast<Source*>(self);
                                 ++s.calls;
                                 if (s.fails) return nullptr;
                                 s.blocks += !block;
                                 return std::realloc(block, size);
                               },
                               [](void* self, void* block, std::size_t) {
                                 --static_cast<Source*>(self)->blocks;
                                 std::free(block);
                               }};
    return mlcp::Memory(&hooks);
  }
};

TEST(SmallBlocks, ArraysOfAnySizeKeepWhatIsInThem) {
  Source source;
  {
    mlcp::SmallBlocks blocks(source.memory());
    Random random(1);
    std::vector<mlcp::Array<double>> arrays(40, mlcp::Array<double>(blocks.memory()));
    std::vector<std::vector<double>> expected(arrays.size());
    for (int step = 0; step < 20000; ++step) {
      const int i = random.integer(0, 39);
      if (random.chance(0.02)) {
        arrays[i].clear();
        arrays[i].trim();
        expected[i].clear();
      } else if (random.chance(0.05)) {
        arrays[i].trim();
      } else {
        arrays[i].push_back(step);
        expected[i].push_back(step);
      }
      if (!arrays[i].empty()) {
        ASSERT_EQ(reinterpret_cast<std::uintptr_t>(arrays[i].data()) % 16, 0u);
      }
    }
    for (std::size_t i = 0; i < arrays.size(); ++i) EXPECT_EQ(std::vector<double>(arrays[i].begin(), arrays[i].end()), expected[i]);
  }
  EXPECT_EQ(source.blocks, 0);
}

TEST(SmallBlocks, WhatFailsLeavesTheOldBlock) {
  Source source;
  mlcp::SmallBlocks blocks(source.memory());
  mlcp::Array<int> array(blocks.memory());
  for (int i = 0; i < 256; ++i) array.push_back(i);
  source.fails = true;
  EXPECT_THROW(array.reserve(1000), std::bad_alloc);
  EXPECT_THROW(array.reserve(100000), std::bad_alloc);
  for (int i = 0; i < 256; ++i) EXPECT_EQ(array[i], i);
}

TEST(SmallBlocks, AreTakenFromFewLargerOnes) {
  if (mlcp::SmallBlocks::is_transparent) GTEST_SKIP() << "every block is one of its own for the sanitizer";
  Source source;
  mlcp::SmallBlocks blocks(source.memory());
  for (int round = 0; round < 10; ++round) {
    std::vector<mlcp::Array<double>> arrays(60, mlcp::Array<double>(blocks.memory()));
    for (auto& array : arrays) array.resize(10);
  }
  EXPECT_LE(source.calls, 2);
}

TEST(SmallBlocks, TheRoomIsTakenFirst) {
  if (mlcp::SmallBlocks::is_transparent) GTEST_SKIP() << "every block is one of its own for the sanitizer";
  Source source;
  alignas(16) char room[8192];
  const auto inside = [&](const void* block) { return block >= room && block < room + sizeof room; };
  {
    mlcp::SmallBlocks blocks(source.memory(), room);
    mlcp::Array<double> small(blocks.memory()), medium(blocks.memory()), large(blocks.memory());
    small.resize(4);
    medium.resize(300);
    large.resize(800);
    EXPECT_TRUE(inside(small.data()) && inside(medium.data()) && !inside(large.data()));
    EXPECT_EQ(source.calls, 1);
    for (int i = 0; i < 300; ++i) medium[i] = i;
    medium.resize(1000);  // leaves the room
    EXPECT_FALSE(inside(medium.data()));
    for (int i = 0; i < 300; ++i) EXPECT_EQ(medium[i], i);
    medium.clear();
    medium.trim();
    std::vector<mlcp::Array<double>> arrays(60, mlcp::Array<double>(blocks.memory()));
    for (auto& array : arrays) array.resize(100);  // more than the room
    EXPECT_GT(source.calls, 2);
  }
  EXPECT_EQ(source.blocks, 0);
}

}  // namespace
}  // namespace support
