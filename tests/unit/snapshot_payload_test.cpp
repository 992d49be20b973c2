#include "report/snapshot_payload.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "assemble/bodies.h"
#include "assemble/compliance.h"
#include "assemble/rows.h"
#include "report/compress.h"

/// Behind a valid checksum anything may stand: the payload alone must not lead astray.
namespace mlcp {

namespace {

/// true: accepted. Any refusal will do, a crash or a runaway allocation will not.
bool accepted(std::span<const std::uint8_t> payload) {
  Snapshot snapshot{Memory()};
  try {
    read_payload(Memory(), payload, 2, snapshot);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// The text of the refusal, "" if there is none.
std::string refusal(std::span<const std::uint8_t> payload) {
  Snapshot snapshot{Memory()};
  try {
    read_payload(Memory(), payload, 2, snapshot);
  } catch (const Error& e) {
    EXPECT_EQ(e.status, MLCP_ERROR_FORMAT);
    return e.text;
  }
  return "";
}

struct SnapshotPayload : testing::Test {
  Memory memory;
  Problem problem{memory};
  Mask mask{memory};
  Array<std::uint8_t> payload{memory};

  void SetUp() override {
    fill();
    mask_resize(mask, problem.m(), MLCP_ROW_ACTIVE);
    mask_take_keys(mask, problem);
    const Settings settings = default_settings();
    std::vector<std::int32_t> ordering;
    for (std::int32_t i = problem.n() + problem.m(); i-- > 0;) ordering.push_back(i);
    write_payload({problem, settings, ordering, &mask, &mask}, payload);
  }
  void fill() {
    const std::int32_t columns[] = {0, 1};
    const double values[] = {1, 2};
    const double mass[] = {2, 0.5, 0.5, 3};
    for (int i = 0; i < 3; ++i) bodies_add(problem, 1, 2, mass, 0, nullptr);
    const std::int32_t pointers[] = {0, 2, 3}, rows[] = {0, 1, 1};
    const double sparse[] = {2, 1, 2};
    body_add_sparse(problem, 2, pointers, rows, sparse, MLCP_LOWER);
    body_remove(problem, 1);
    body_set_prescribed(problem, 0, mass, 2);
    for (std::uint64_t i = 0; i < 3; ++i) row_add(problem, 2, columns, values, 1, 0, infinity, 0.5, 7 + i);
    const std::int32_t from[] = {0, 2, 3, 4}, to[] = {0, 2, 1, 2};
    const double sigma[] = {1, 0.5, 1, 1};
    set_compliance_matrix(problem, {3, from, to, sigma, MLCP_LOWER});
  }
};

}  // namespace

TEST_F(SnapshotPayload, RoundTrip) {
  Snapshot snapshot(memory);
  read_payload(memory, payload.span(), 2, snapshot);
  Array<std::uint8_t> again(memory);
  write_payload({snapshot.problem, snapshot.settings, snapshot.ordering.span(), &snapshot.enabled, &snapshot.start}, again);
  ASSERT_EQ(again.size(), payload.size());
  EXPECT_TRUE(std::equal(again.begin(), again.end(), payload.begin()));
}

TEST_F(SnapshotPayload, RefusalsNameSectionAndOffset) {
  EXPECT_EQ(refusal(payload.span()), "");
  const std::string last = std::to_string(payload.size() - 4 * (std::size_t(problem.n()) + problem.m()));
  EXPECT_EQ(refusal(payload.span().first(payload.size() - 1)),
            "the snapshot is not legal: ordering, at byte " + last + " unpacked: the snapshot ends too early");
  const std::size_t settings = 6 * 4 + 4 * 8 + 4 * 4, kind = settings + 4 + 4;
  payload[kind] = 9;
  EXPECT_EQ(refusal(payload.span()), "the snapshot is not legal: body 0, at byte " + std::to_string(kind + 2) +
                                         " unpacked: a mass is stored in way 9");
  payload[0] = 99;
  EXPECT_NE(refusal(payload.span()).find("settings, at byte " + std::to_string(settings) + " unpacked: settings.method = 99"),
            std::string::npos)
      << refusal(payload.span());
}

TEST_F(SnapshotPayload, TruncatedAtEveryByte) {
  for (std::size_t size = 0; size < payload.size(); ++size) EXPECT_FALSE(accepted(payload.span().first(size))) << size;
}

TEST_F(SnapshotPayload, EveryByteReplaced) {
  for (std::size_t i = 0; i < payload.size(); ++i) {
    const std::uint8_t old = payload[i];
    for (int value : {0, 1, 0x7f, 0x80, 0xfe, 0xff}) {
      payload[i] = static_cast<std::uint8_t>(value);
      accepted(payload.span());
    }
    payload[i] = old;
  }
}

TEST_F(SnapshotPayload, ManyBytesReplaced) {
  std::mt19937 random(1);
  const std::vector<std::uint8_t> good(payload.begin(), payload.end());
  for (int trial = 0; trial < 3000; ++trial) {
    std::copy(good.begin(), good.end(), payload.begin());
    for (int i = 0; i < 4; ++i) payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
    accepted(payload.span());
  }
}

TEST_F(SnapshotPayload, CountsOfBillions) {
  for (std::size_t i = 0; i + 4 <= payload.size(); ++i) {
    std::uint8_t old[4];
    std::copy_n(payload.data() + i, 4, old);
    for (std::uint32_t count : {0x7fffffffu, 0x10000000u, 0x00100000u}) {
      for (int b = 0; b < 4; ++b) payload[i + b] = static_cast<std::uint8_t>(count >> (8 * b));
      accepted(payload.span());
    }
    std::copy_n(old, 4, payload.data() + i);
  }
}

TEST(Compress, RoundTripOverSeveralChunks) {
  const Memory memory;
  Array<std::uint8_t> from(memory), packed(memory), back(memory);
  std::mt19937 random(2);
  from.resize(3'000'000);
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<std::uint8_t>(i % 7 ? 0 : random());
  for (std::size_t size : {std::size_t(0), std::size_t(1), std::size_t(1) << 18, from.size()}) {
    packed.clear();
    deflate_bytes(memory, from.span().first(size), packed);
    inflate_bytes(memory, packed.span(), size, back);
    ASSERT_EQ(back.size(), size);
    EXPECT_TRUE(std::equal(back.begin(), back.end(), from.begin()));
    EXPECT_THROW(inflate_bytes(memory, packed.span(), size + 1, back), Error);
    if (size > 0) {
      EXPECT_THROW(inflate_bytes(memory, packed.span(), size - 1, back), Error);
    }
    EXPECT_THROW(inflate_bytes(memory, packed.span().first(packed.size() - 1), size, back), Error);
  }
}

TEST(Compress, ALieAboutTheSizeCostsNothing) {
  const Memory memory;
  Array<std::uint8_t> from(memory), packed(memory), back(memory);
  from.assign(1000, 1);
  deflate_bytes(memory, from.span(), packed);
  EXPECT_THROW(inflate_bytes(memory, packed.span(), std::uint64_t(1) << 60, back), Error);
  EXPECT_THROW(inflate_bytes(memory, packed.span(), 1032 * packed.size(), back), Error);
  EXPECT_LE(back.capacity(), 1032 * packed.size());
}

}  // namespace mlcp
