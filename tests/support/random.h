#pragma once
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace support {

/// The same numbers from the same seed on every machine and standard library. splitmix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 0x1234567u) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  double uniform(double low = -1, double high = 1) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
  int integer(int low, int high) { return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1)); }
  bool chance(double p) { return uniform(0, 1) < p; }
  /// 10^x, x uniform
  double magnitude(double low, double high) { return std::pow(10.0, uniform(low, high)); }

 private:
  std::uint64_t state_;
};

/// How many random cases: ten times as many in the long runs.
inline int rounds(int count) { return std::getenv("MLCP_TEST_LONG") ? 10 * count : count; }

}  // namespace support
