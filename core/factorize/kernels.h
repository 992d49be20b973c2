#pragma once
#include <cstdint>

/// The loops over entries of L. Columns of one run share their rows, so that what they act on is gathered once a run and then lies
/// dense. Sums have one fixed order, whatever the machine.
namespace mlcp::kernels {

/// y[rows[i]] −= c[i] · t
inline void scatter_subtract(std::int64_t count, const std::int32_t* rows, const double* c, double t, double* y) {
  for (std::int64_t i = 0; i < count; ++i) y[rows[i]] -= c[i] * t;
}

/// y[i] −= c[i] · t
inline void subtract(std::int64_t count, const double* __restrict c, double t, double* __restrict y) {
  for (std::int64_t i = 0; i < count; ++i) y[i] -= c[i] * t;
}

/// Σ c[i] · x[i] in four interleaved sums, which two vectors of two hold.
inline double dot(std::int64_t count, const double* __restrict c, const double* __restrict x) {
  double s[4] = {0, 0, 0, 0};
  std::int64_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (int k = 0; k < 4; ++k) s[k] += c[i + k] * x[i + k];
  for (; i < count; ++i) s[0] += c[i] * x[i];
  return (s[0] + s[2]) + (s[1] + s[3]);
}

/// Σ c[i] · x[rows[i]]
inline double gather_dot(std::int64_t count, const std::int32_t* rows, const double* c, const double* x) {
  double s[2] = {0, 0};
  std::int64_t i = 0;
  for (; i + 2 <= count; i += 2) {
    s[0] += c[i] * x[rows[i]];
    s[1] += c[i + 1] * x[rows[i + 1]];
  }
  return i < count ? s[0] + s[1] + c[i] * x[rows[i]] : s[0] + s[1];
}

/// One column of a rank-1 update: c[i] += δ w[i], w[i] −= β c[i](old).
inline void rank_one_column(std::int64_t count, double* __restrict c, double* __restrict w, double beta, double delta) {
  for (std::int64_t i = 0; i < count; ++i) {
    const double wi = w[i], ci = c[i];
    c[i] = ci + delta * wi;
    w[i] = wi - beta * ci;
  }
}

inline void gather(std::int64_t count, const std::int32_t* rows, const double* y, double* dense) {
  for (std::int64_t i = 0; i < count; ++i) dense[i] = y[rows[i]];
}

inline void scatter(std::int64_t count, const std::int32_t* rows, const double* dense, double* y) {
  for (std::int64_t i = 0; i < count; ++i) y[rows[i]] = dense[i];
}

}  // namespace mlcp::kernels
