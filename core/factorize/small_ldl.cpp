#include "factorize/small_ldl.h"

#include <type_traits>

namespace mlcp {
namespace {

/// Loops unrolled for the two sizes that nearly all bodies have.      run: takes the size as a constant or as a number
auto with_size(std::int32_t d, auto run) {
  switch (d) {
    case 3: return run(std::integral_constant<std::int32_t, 3>{});
    case 6: return run(std::integral_constant<std::int32_t, 6>{});
    default: return run(d);
  }
}

}  // namespace

bool small_factor(std::int32_t size, double* block) {
  return with_size(size, [block](auto d) {
    for (std::int32_t c = 0; c < d; ++c) {
      double* column = block + static_cast<std::int64_t>(c) * d;
      for (std::int32_t k = 0; k < c; ++k) {
        const double* before = block + static_cast<std::int64_t>(k) * d;
        const double f = before[c] * before[k];  // l_ck · d_k
        for (std::int32_t r = c; r < d; ++r) column[r] -= f * before[r];
      }
      if (!(column[c] > 0)) return false;
      for (std::int32_t r = c + 1; r < d; ++r) column[r] /= column[c];
    }
    return true;
  });
}

void small_solve(std::int32_t size, const double* block, double* x) {
  with_size(size, [block, x](auto d) {
    for (std::int32_t c = 0; c < d; ++c)
      for (std::int32_t r = c + 1; r < d; ++r) x[r] -= block[static_cast<std::int64_t>(c) * d + r] * x[c];
    for (std::int32_t c = d; c-- > 0;) {
      double sum = x[c] / block[static_cast<std::int64_t>(c) * d + c];
      for (std::int32_t r = c + 1; r < d; ++r) sum -= block[static_cast<std::int64_t>(c) * d + r] * x[r];
      x[c] = sum;
    }
  });
}

}  // namespace mlcp
