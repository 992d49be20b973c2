#pragma once
/// The loops of Kernels, compiled once by each kernels_*.cpp with its own instruction set. Everything is local to the file that includes it, and
/// nothing inline from elsewhere is used: a linker must not keep an AVX2 copy for all.
#include <cstdint>
#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include "factorize/kernels.h"

namespace mlcp {
namespace {

/// Four doubles, one AVX register or two of SSE2: the same sums in the same order.
typedef double Four __attribute__((vector_size(32), aligned(8)));

/// p[0] .. p[rest − 1], at most four, and zeros, without a branch to mispredict where the CPU has masked loads.
inline void load_part(const double* p, std::int64_t rest, Four& to) {
#if defined(__AVX2__)
  const __m256i lane = _mm256_set_epi64x(3, 2, 1, 0);
  to = reinterpret_cast<Four>(_mm256_maskload_pd(p, _mm256_cmpgt_epi64(_mm256_set1_epi64x(rest), lane)));
#else
  to = Four{rest > 0 ? p[0] : 0, rest > 1 ? p[1] : 0, rest > 2 ? p[2] : 0, rest > 3 ? p[3] : 0};
#endif
}

/// dense[i] = y[rows[i]]; the last four may be read twice, which is cheaper than a short loop.
void gather(std::int64_t count, const std::int32_t* rows, const double* y, double* dense) {
  std::int64_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (int k = 0; k < 4; ++k) dense[i + k] = y[rows[i + k]];
  if (count >= 4) i = count - 4;
  for (; i < count; ++i) dense[i] = y[rows[i]];
}

void scatter(std::int64_t count, const std::int32_t* rows, const double* dense, double* y) {
  for (std::int64_t i = 0; i < count; ++i) y[rows[i]] = dense[i];
}

/// y[i] −= c[i] · t
void subtract(std::int64_t count, const double* __restrict c, double t, double* __restrict y) {
  for (std::int64_t i = 0; i < count; ++i) y[i] -= c[i] * t;
}

/// c[i] += δ w[i], w[i] −= β c[i](old)
void rank_one_column(std::int64_t count, double* __restrict c, double* __restrict w, double beta, double delta) {
  for (std::int64_t i = 0; i < count; ++i) {
    const double wi = w[i], ci = c[i];
    c[i] = ci + delta * wi;
    w[i] = wi - beta * ci;
  }
}

/// combine() on `count` entries, more than 4 (V − 1) and at most 4 V: sums stay in registers from the first column to the last.
template <int V>
inline void add_columns(std::int64_t count, std::int64_t first, std::int32_t columns, const double* const* c, const double* f, double* sum) {
  constexpr int whole = V - 1;
  Four s[V] = {};
  for (std::int32_t k = 0; k < columns; ++k) {
    const double* const column = c[k] + first;
    const double factor = f[k];
#pragma GCC unroll 4
    for (int v = 0; v < whole; ++v) s[v] += reinterpret_cast<const Four*>(column)[v] * factor;
    Four last;
    load_part(column + 4 * whole, count - 4 * whole, last);
    s[whole] += last * factor;
  }
#pragma GCC unroll 4
  for (int v = 0; v < whole; ++v) reinterpret_cast<Four*>(sum + first)[v] = s[v];
  for (std::int64_t i = 4 * whole; i < count; ++i) sum[first + i] = s[whole][i - 4 * whole];
}

void combine(std::int64_t count, std::int32_t columns, const double* const* c, const double* f, double* sum) {
  std::int64_t i = 0;
  for (; i + 16 < count; i += 16) add_columns<4>(16, i, columns, c, f, sum);
  switch ((count - i + 3) / 4) {
    case 4: add_columns<4>(count - i, i, columns, c, f, sum); break;
    case 3: add_columns<3>(count - i, i, columns, c, f, sum); break;
    case 2: add_columns<2>(count - i, i, columns, c, f, sum); break;
    case 1: add_columns<1>(count - i, i, columns, c, f, sum); break;
  }
}

/// Two rows of products(), V vectors each: the sums over columns of f c, f by row and column.
template <int V>
inline void add_to_rows(std::int32_t columns, const Four* panel, const double* f, double* first, double* second) {
  Four a[V], b[V];
#pragma GCC unroll 4
  for (int v = 0; v < V; ++v) {
    a[v] = reinterpret_cast<const Four*>(first)[v];
    b[v] = reinterpret_cast<const Four*>(second)[v];
  }
  for (std::int32_t j = 0; j < columns; ++j, panel += 4, f += 16)
#pragma GCC unroll 4
    for (int v = 0; v < V; ++v) {
      a[v] += panel[v] * f[0];
      b[v] += panel[v] * f[1];
    }
#pragma GCC unroll 4
  for (int v = 0; v < V; ++v) {
    reinterpret_cast<Four*>(first)[v] = a[v];
    reinterpret_cast<Four*>(second)[v] = b[v];
  }
}

void products(std::int64_t count, std::int32_t columns, const double* const* c, const double* inverse, double* block) {
  constexpr std::int32_t most = 16;  // columns at a time
  Four panel[4 * most], scaled[4 * most];
  const std::int64_t vectors = (count + 3) / 4, stride = 4 * vectors;
  for (std::int32_t k = 0; k < columns; k += most) {
    const std::int32_t some = columns - k < most ? columns - k : most;
    for (std::int32_t j = 0; j < some; ++j)
      for (std::int64_t v = 0; v < vectors; ++v) {
        Four entries;
        load_part(c[k + j] + 4 * v, count - 4 * v, entries);
        panel[4 * j + v] = entries;
        scaled[4 * j + v] = entries * inverse[k + j];
      }
    for (std::int64_t a = 0; a < stride; a += 2) {
      const double* f = reinterpret_cast<const double*>(scaled) + a;
      const std::int64_t v = a / 4;
      double *first = block + stride * a + 4 * v, *second = first + stride;
      switch (vectors - v) {
        case 4: add_to_rows<4>(some, panel + v, f, first, second); break;
        case 3: add_to_rows<3>(some, panel + v, f, first, second); break;
        case 2: add_to_rows<2>(some, panel + v, f, first, second); break;
        default: add_to_rows<1>(some, panel + v, f, first, second);
      }
    }
  }
}

std::int64_t forward(const FactorArrays& f, const Stretch& s, double* y) {
  if (s.last - s.first == 1) {
    const std::int32_t j = s.first;
    if (!f.in[j] || y[j] == 0) return 0;
    const double t = y[j] * f.inverse[j];
    const double* c = f.values + f.pointers[j];
    for (std::int64_t i = 0; i < s.count; ++i) y[s.rows[i]] -= c[i] * t;
    return s.count;
  }
  std::int64_t touched = 0;
  double* dense = f.gathered + s.first;
  gather(s.count, s.rows, y, dense);
  for (std::int32_t j = s.first; j < s.last; ++j) {
    const std::int64_t k = s.equal ? 0 : j - s.first;
    const double yj = k ? dense[k - 1] : y[j];
    if (!f.in[j] || yj == 0) continue;
    subtract(s.count - k, f.values + f.pointers[j], yj * f.inverse[j], dense + k);
    touched += s.count - k;
  }
  scatter(s.count, s.rows, dense, y);
  return touched;
}

/// The last step of a block of nested columns j, j − 1, … j − B + 1, whose sums over what lies behind them are done: their triangle.
/// c[b] belongs to column j − b; entry t of it, from the block's first row on, to column j − b + 1 + t.
template <int B>
inline void backward_triangle(const FactorArrays& f, std::int32_t j, const double* const* c, const double* sum, double* x) {
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b) {
    double total = sum[b];
#pragma GCC unroll 4
    for (int t = 0; t < b; ++t) total += c[b][t] * x[j - b + 1 + t];
    x[j - b] = f.inverse[j - b] * (x[j - b] - total);
  }
}

inline double in_order(const Four& s) { return (s[0] + s[2]) + (s[1] + s[3]); }

/// B ≤ 4 columns, the last is j: x is gathered into registers. Columns that are out are zero and have 1/d = 0: they cost less than the
/// branches around them.
template <int B, bool equal>
void backward_short(const FactorArrays& f, const Stretch& s, std::int32_t j, double* x) {
  constexpr int behind_first = equal ? 0 : B - 1;
  const std::int64_t tail = s.count - behind_first;
  const std::int32_t* rows = s.rows + behind_first;
  const double *c[B], *behind[B];
  Four sums[B];
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b) {
    c[b] = f.values + f.pointers[j - b];
    behind[b] = c[b] + (equal ? 0 : b);
    sums[b] = Four{0, 0, 0, 0};
  }
  std::int64_t i = 0;
  for (; i + 4 <= tail; i += 4) {
    const Four xs{x[rows[i]], x[rows[i + 1]], x[rows[i + 2]], x[rows[i + 3]]};
#pragma GCC unroll 4
    for (int b = 0; b < B; ++b) sums[b] += *reinterpret_cast<const Four*>(behind[b] + i) * xs;
  }
  if (i < tail) {
    const std::int64_t end = tail - 1;
    const Four xs{x[rows[i]], x[rows[i + 1 < end ? i + 1 : end]], x[rows[end]], 0};
#pragma GCC unroll 4
    for (int b = 0; b < B; ++b) {
      Four cs;
      load_part(behind[b] + i, tail - i, cs);
      sums[b] += cs * xs;
    }
  }
  double sum[B];
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b) sum[b] = in_order(sums[b]);
  if constexpr (equal)
    for (int b = 0; b < B; ++b) x[j - b] = f.inverse[j - b] * (x[j - b] - sum[b]);
  else
    backward_triangle<B>(f, j, c, sum, x);
}

template <bool equal>
void backward_few(const FactorArrays& f, const Stretch& s, std::int32_t j, std::int32_t columns, double* x) {
  switch (columns) {
    case 1: backward_short<1, equal>(f, s, j, x); break;
    case 2: backward_short<2, equal>(f, s, j, x); break;
    case 3: backward_short<3, equal>(f, s, j, x); break;
    case 4: backward_short<4, equal>(f, s, j, x); break;
  }
}

/// Columns j, j − 1, … j − B + 1 of a longer stretch. dense[i] is x of row i of the stretch. The four that the block before has just written
/// are read one by one: a vector load would wait for the stores.
template <int B>
void backward_block(const FactorArrays& f, const Stretch& s, std::int32_t j, double* x, double* dense) {
  const std::int64_t common = j - s.first;
  const double *c[B], *at[B];  // at[b][i] belongs to dense[i]
  Four sums[B];
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b) {
    c[b] = f.values + f.pointers[j - b];
    at[b] = c[b] - (common - b);
    sums[b] = Four{0, 0, 0, 0};
  }
  std::int64_t i = s.count;
  for (; i - 4 >= common + 4; i -= 4) {
    const Four xs = *reinterpret_cast<const Four*>(dense + i - 4);
#pragma GCC unroll 4
    for (int b = 0; b < B; ++b) sums[b] += *reinterpret_cast<const Four*>(at[b] + i - 4) * xs;
  }
  double sum[B];
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b) sum[b] = in_order(sums[b]);
  while (i-- > common)
#pragma GCC unroll 4
    for (int b = 0; b < B; ++b) sum[b] += at[b][i] * dense[i];
  backward_triangle<B>(f, j, c, sum, x);
  for (int b = 0; b < B && common - b > 0; ++b) dense[common - b - 1] = x[j - b];
}

std::int64_t backward(const FactorArrays& f, const Stretch& s, double* x) {
  bool any = false;
  for (std::int32_t j = s.first; j < s.last; ++j) any |= f.in[j] != 0;
  if (!any) return 0;
  const std::int32_t columns = s.last - s.first;
  if (s.equal) {
    for (std::int32_t left = columns; left > 0; left -= 4) backward_few<true>(f, s, s.first + left - 1, left < 4 ? left : 4, x);
    return columns * s.count;
  }
  const std::int64_t touched = columns * s.count - std::int64_t{columns} * (columns - 1) / 2;
  if (columns <= 4) {
    backward_few<false>(f, s, s.last - 1, columns, x);
    return touched;
  }
  double* dense = f.gathered + s.first;
  gather(s.count, s.rows, x, dense);
  std::int32_t j = s.last - 1;
  for (; j - s.first >= 3; j -= 4)
    if (f.in[j] | f.in[j - 1] | f.in[j - 2] | f.in[j - 3]) backward_block<4>(f, s, j, x, dense);
  switch (j - s.first) {
    case 2: backward_block<3>(f, s, j, x, dense); break;
    case 1: backward_block<2>(f, s, j, x, dense); break;
    case 0: backward_block<1>(f, s, j, x, dense); break;
  }
  return touched;
}

double size_of(double d) { return d < 0 ? -d : d; }

std::int64_t rank_one(const FactorArrays& f, const Stretch& s, double* w, double& sigma) {
  std::int64_t touched = 0;
  bool stale = false;
  double* dense = f.gathered + s.first;
  gather(s.count, s.rows, w, dense);
  for (std::int32_t j = s.first; j < s.last; ++j) {
    const std::int64_t k = j - s.first;
    const double wj = k ? dense[k - 1] : w[j];
    if (wj == 0 || stale) continue;
    const double d = f.pivot[j], updated = d + sigma * wj * wj;
    if (!(size_of(updated) > 1e-12 * size_of(d)) || (updated > 0) != (d > 0)) {
      stale = true;
      continue;
    }
    rank_one_column(s.count - k, f.values + f.pointers[j], dense + k, wj / d, sigma * wj);
    f.pivot[j] = updated;
    f.inverse[j] = 1 / updated;
    sigma *= d / updated;
    touched += s.count - k;
  }
  scatter(s.count, s.rows, dense, w);
  for (std::int32_t j = s.first; j < s.last; ++j) w[j] = 0;
  return stale ? -1 : touched;
}

}  // namespace
}  // namespace mlcp
