#pragma once
#include <cstdint>

namespace mlcp {

/// Σ aᵢbᵢ in an order that neither compiler nor alignment changes. For vectors too short to be worth a call to the kernels.
inline double dot(const double* a, const double* b, std::int32_t count) {
  using Pair [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;  // two lanes: what every x86-64 has
  const auto at = [](const double* x) { return *reinterpret_cast<const Pair*>(x); };
  Pair even{0, 0}, odd{0, 0};
  std::int32_t i = 0;
  for (; i + 4 <= count; i += 4) {
    even += at(a + i) * at(b + i);
    odd += at(a + i + 2) * at(b + i + 2);
  }
  if (i + 2 <= count) {
    even += at(a + i) * at(b + i);
    i += 2;
  }
  even += odd;
  const double sum = even[0] + even[1];
  return i < count ? sum + a[i] * b[i] : sum;
}

}  // namespace mlcp
