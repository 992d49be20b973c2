#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <limits>

/// What a fuzzer found on its way through a target: choices read from its bytes, and the end of the run when something does not hold.
namespace fuzz {

/// Zeros behind the end, so that every input is a whole one and a shorter one is a simpler one.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  bool empty() const { return at_ == end_; }
  const std::uint8_t* rest() const { return at_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  int byte() { return empty() ? 0 : *at_++; }
  /// low .. high, which are less than 256 apart
  int integer(int low, int high) { return low + byte() % (high - low + 1); }
  bool flag() { return byte() & 1; }
  bool one_in(int n) { return byte() % n == n - 1; }

  /// Mostly small exact numbers, which make ties; some that are as long as doubles go; any bits at all on demand.
  double number() {
    const int choice = byte();
    if (choice == 255) return bits();
    if (choice >= 240) return extreme[choice - 240];
    if (choice >= 160) return (choice - 200) / 7.0;
    return (choice % 17 - 8) / 4.0;
  }

 private:
  static constexpr double extreme[] = {1e-300, 1e300, -1e300, 5e-324, 1e-12, -1e-12, 1e-8, 1e8, -1e8, 1e12, -1e12, 1e4, 1e-4,
                                       std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()};
  double bits() {
    unsigned char raw[sizeof(double)];
    for (unsigned char& b : raw) b = static_cast<unsigned char>(byte());
    double value;
    std::memcpy(&value, raw, sizeof value);
    return value;
  }

  const std::uint8_t *at_, *end_;
};

/// What must hold whatever the input; a fuzzer takes an abort for a finding.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
