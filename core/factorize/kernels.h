#pragma once
#include <cstdint>

namespace mlcp::kernels {

/// y[rows[i]] −= c[i] · t
inline void scatter_subtract(std::int64_t count, const std::int32_t* rows, const double* c, double t, double* y) {
  for (std::int64_t i = 0; i < count; ++i) y[rows[i]] -= c[i] * t;
}

/// Σ c[i] · x[rows[i]], in four interleaved sums: the same order on every machine.
inline double gather_dot(std::int64_t count, const std::int32_t* rows, const double* c, const double* x) {
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  std::int64_t i = 0;
  for (; i + 4 <= count; i += 4) {
    s0 += c[i] * x[rows[i]];
    s1 += c[i + 1] * x[rows[i + 1]];
    s2 += c[i + 2] * x[rows[i + 2]];
    s3 += c[i + 3] * x[rows[i + 3]];
  }
  for (; i < count; ++i) s0 += c[i] * x[rows[i]];
  return (s0 + s1) + (s2 + s3);
}

/// One column of a rank-1 update: c[i] += δ w_i, w_i −= β c_i(old).
inline void rank_one_column(std::int64_t count, const std::int32_t* rows, double* c, double* w, double beta, double delta) {
  for (std::int64_t i = 0; i < count; ++i) {
    const double wi = w[rows[i]], ci = c[i];
    c[i] = ci + delta * wi;
    w[rows[i]] = wi - beta * ci;
  }
}

}  // namespace mlcp::kernels
