#pragma once
#include <bit>
#include <cstdint>
#include <span>

#include "memory/array.h"
#include "memory/error.h"

/// Numbers as little-endian bytes, whatever the machine.
namespace mlcp {

class ByteWriter {
 public:
  explicit ByteWriter(Array<std::uint8_t>& out) : out_(out) {}

  void u8(std::uint8_t x) { out_.push_back(x); }
  void u32(std::uint32_t x) { put(x, 4); }
  void u64(std::uint64_t x) { put(x, 8); }
  void i32(std::int32_t x) { put(static_cast<std::uint32_t>(x), 4); }
  void i64(std::int64_t x) { put(static_cast<std::uint64_t>(x), 8); }
  void f64(double x) { put(std::bit_cast<std::uint64_t>(x), 8); }
  void bytes(std::span<const std::uint8_t> x) {
    for (std::uint8_t b : x) u8(b);
  }
  void i32s(std::span<const std::int32_t> x) {
    out_.reserve(out_.size() + 4 * x.size());
    for (std::int32_t i : x) i32(i);
  }
  void u64s(std::span<const std::uint64_t> x) {
    out_.reserve(out_.size() + 8 * x.size());
    for (std::uint64_t i : x) u64(i);
  }
  void f64s(std::span<const double> x) {
    out_.reserve(out_.size() + 8 * x.size());
    for (double i : x) f64(i);
  }

 private:
  void put(std::uint64_t x, int size) {
    for (int i = 0; i < size; ++i) out_.push_back(static_cast<std::uint8_t>(x >> (8 * i)));
  }

  Array<std::uint8_t>& out_;
};

/// fails: Error (FORMAT) at the end of the bytes, before anything is allocated for what is not there.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : size_(bytes.size()), rest_(bytes) {}

  std::size_t left() const { return rest_.size(); }
  std::size_t offset() const { return size_ - rest_.size(); }
  std::uint8_t u8() { return static_cast<std::uint8_t>(get(1)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(get(4)); }
  std::uint64_t u64() { return get(8); }
  std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
  std::int64_t i64() { return static_cast<std::int64_t>(get(8)); }
  double f64() { return std::bit_cast<double>(get(8)); }
  /// A number of things of which each takes at least `size` bytes of what is left.
  std::int32_t count(std::size_t size) {
    const std::uint32_t n = u32();
    if (n > 0x7fffffffu || n * std::uint64_t(size) > rest_.size()) fail();
    return static_cast<std::int32_t>(n);
  }
  std::span<const std::uint8_t> bytes(std::size_t n) {
    if (n > rest_.size()) fail();
    const auto taken = rest_.first(n);
    rest_ = rest_.subspan(n);
    return taken;
  }
  void i32s(std::size_t n, Array<std::int32_t>& out) {
    expect(n, 4);
    out.resize(n);
    for (std::int32_t& x : out) x = i32();
  }
  void u64s(std::size_t n, Array<std::uint64_t>& out) {
    expect(n, 8);
    out.resize(n);
    for (std::uint64_t& x : out) x = u64();
  }
  void f64s(std::size_t n, Array<double>& out) {
    expect(n, 8);
    out.resize(n);
    for (double& x : out) x = f64();
  }

 private:
  [[noreturn]] static void fail() { throw Error(MLCP_ERROR_FORMAT, "the snapshot ends too early"); }
  void expect(std::size_t n, std::size_t size) const {
    if (n > rest_.size() / size) fail();
  }
  std::uint64_t get(std::size_t size) {
    const auto taken = bytes(size);
    std::uint64_t x = 0;
    for (std::size_t i = 0; i < size; ++i) x |= std::uint64_t(taken[i]) << (8 * i);
    return x;
  }

  std::size_t size_;
  std::span<const std::uint8_t> rest_;
};

}  // namespace mlcp
