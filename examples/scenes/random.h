#pragma once
#include <cstdint>
#include <random>

namespace scenes {

/// Uniform numbers with the same bits everywhere: std::mt19937 is specified exactly, the standard distributions are not.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  /// in [0, 1), a multiple of 2⁻³²
  double uniform() { return static_cast<double>(static_cast<std::uint32_t>(engine_())) * 0x1p-32; }
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

 private:
  std::mt19937 engine_;
};

}  // namespace scenes
