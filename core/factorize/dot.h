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

/// dot := Σ aᵢbᵢ, size := Σ |aᵢbᵢ|, likewise.
inline void dot_and_size(const double* a, const double* b, std::int32_t count, double& dot, double& size) {
  using Pair [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;
  using Bits [[gnu::vector_size(16), gnu::aligned(8)]] = long long;
  constexpr long long magnitude = 0x7fffffffffffffff;
  const auto at = [](const double* x) { return *reinterpret_cast<const Pair*>(x); };
  Pair sum{0, 0}, sizes{0, 0};
  std::int32_t i = 0;
  for (; i + 2 <= count; i += 2) {
    const Pair term = at(a + i) * at(b + i);
    sum += term;
    sizes += reinterpret_cast<Pair>(reinterpret_cast<Bits>(term) & Bits{magnitude, magnitude});
  }
  dot = sum[0] + sum[1];
  size = sizes[0] + sizes[1];
  if (i == count) return;
  const double term = a[i] * b[i];
  dot += term;
  size += term < 0 ? -term : term;
}

}  // namespace mlcp
