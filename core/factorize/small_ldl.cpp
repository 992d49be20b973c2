#include "factorize/small_ldl.h"

namespace mlcp {

bool small_factor(std::int32_t d, double* block) {
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
}

void small_solve(std::int32_t d, const double* block, double* x) {
  for (std::int32_t c = 0; c < d; ++c)
    for (std::int32_t r = c + 1; r < d; ++r) x[r] -= block[static_cast<std::int64_t>(c) * d + r] * x[c];
  for (std::int32_t c = d; c-- > 0;) {
    double sum = x[c] / block[static_cast<std::int64_t>(c) * d + c];
    for (std::int32_t r = c + 1; r < d; ++r) sum -= block[static_cast<std::int64_t>(c) * d + r] * x[r];
    x[c] = sum;
  }
}

}  // namespace mlcp
