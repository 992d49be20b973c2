/// The panel loops of Kernels, compiled once by each kernels*.cpp with its own instruction set, like kernel_loops.h.
#include <cstdint>
#if defined(__AVX__)
#include <immintrin.h>
#endif

#include "factorize/kernels.h"

namespace mlcp {
namespace {

/// Four doubles, one AVX register or two of SSE2.
typedef double Lanes __attribute__((vector_size(32), aligned(8), may_alias));
typedef long long Bits __attribute__((vector_size(32), aligned(8)));

inline void load_block(const double* from, Lanes (&s)[4]) {
  for (int r = 0; r < 4; ++r) s[r] = *reinterpret_cast<const Lanes*>(from + 4 * r);
}
#if defined(__AVX512F__)
typedef double Eight __attribute__((vector_size(64), aligned(8), may_alias));

inline Eight joined(const Lanes& a, const Lanes& b) { return Eight{a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]}; }
/// Entry r of each half, four times.
template <int r>
inline Eight spread(const Eight& f) {
#if defined(__clang__) || __GNUC__ >= 12
  return __builtin_shufflevector(f, f, r, r, r, r, r + 4, r + 4, r + 4, r + 4);
#else
  typedef long long Places __attribute__((vector_size(64)));
  return __builtin_shuffle(f, Places{r, r, r, r, r + 4, r + 4, r + 4, r + 4});
#endif
}
#endif

/// By eights where product() reads them so: a load waits for two stores that each have a half of it.
inline void store_block(const Lanes (&s)[4], double* to) {
#if defined(__AVX512F__)
  *reinterpret_cast<Eight*>(to) = joined(s[0], s[1]);
  *reinterpret_cast<Eight*>(to + 8) = joined(s[2], s[3]);
#else
  for (int r = 0; r < 4; ++r) *reinterpret_cast<Lanes*>(to + 4 * r) = s[r];
#endif
}

/// sum(r, :) := Σ_q left(q, r) right(q, :). count: a multiple of two. Even and odd q are summed apart, or each sum would wait for the one before; with AVX-512
/// in the two halves of one register, by the same operations.
inline void product(std::int64_t count, const double* left, const double* right, Lanes (&sum)[4]) {
  const double* const end = left + 4 * count;
#if defined(__AVX512F__)
  Eight s0{}, s1{}, s2{}, s3{};
  for (; left != end; left += 8, right += 8) {
    const Eight f = *reinterpret_cast<const Eight*>(left), x = *reinterpret_cast<const Eight*>(right);
    s0 += spread<0>(f) * x;
    s1 += spread<1>(f) * x;
    s2 += spread<2>(f) * x;
    s3 += spread<3>(f) * x;
  }
  const auto both = [](const Eight& a) { return Lanes{a[0], a[1], a[2], a[3]} + Lanes{a[4], a[5], a[6], a[7]}; };
  sum[0] = both(s0), sum[1] = both(s1), sum[2] = both(s2), sum[3] = both(s3);
#else
  Lanes s0{}, s1{}, s2{}, s3{}, t0{}, t1{}, t2{}, t3{};
  for (; left != end; left += 8, right += 8) {
    const Lanes x = *reinterpret_cast<const Lanes*>(right), y = *reinterpret_cast<const Lanes*>(right + 4);
    s0 += left[0] * x;
    s1 += left[1] * x;
    s2 += left[2] * x;
    s3 += left[3] * x;
    t0 += left[4] * y;
    t1 += left[5] * y;
    t2 += left[6] * y;
    t3 += left[7] * y;
  }
  sum[0] = s0 + t0, sum[1] = s1 + t1, sum[2] = s2 + t2, sum[3] = s3 + t3;
#endif
}

inline bool any_bit(const Bits& a) {
#if defined(__AVX__)
  return !_mm256_testz_si256(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(a));
#else
  return (a[0] | a[1] | a[2] | a[3]) != 0;
#endif
}

/// BlockLdl::block and std::max, local to this file.
inline double* block_of(const BlockLdl& f, std::int64_t b) { return f.lower + 8 * b * (b + 1); }
inline std::int32_t larger(std::int32_t a, std::int32_t b) { return a > b ? a : b; }

std::int32_t panel_forward(const BlockLdl& f, std::int32_t begin, std::int32_t blocks, double* y) {
  std::int32_t end = begin;  // behind what is not 0 so far: in a robot, the joints of other limbs end before their own begin
  for (std::int32_t b = begin; b < blocks; ++b) {
    const std::int32_t from = larger(f.first[b], begin);
    const double *l = block_of(f, b), *own = l + 16 * std::int64_t{b};
    Lanes s[4];
    load_block(y + 16 * std::int64_t{b}, s);
    if (from < end) {
      Lanes sum[4];
      product(4 * (end - from), l + 16 * std::int64_t{from}, y + 16 * std::int64_t{from}, sum);
      for (int r = 0; r < 4; ++r) s[r] -= sum[r];
    }
    s[1] -= own[1] * s[0];
    s[2] -= own[2] * s[0];
    s[3] -= own[3] * s[0];
    s[2] -= own[6] * s[1];
    s[3] -= own[7] * s[1];
    s[3] -= own[11] * s[2];
    store_block(s, y + 16 * std::int64_t{b});
    if (any_bit(reinterpret_cast<Bits>(s[0]) | reinterpret_cast<Bits>(s[1]) | reinterpret_cast<Bits>(s[2]) | reinterpret_cast<Bits>(s[3]))) end = b + 1;
  }
  return end;
}

inline bool is_pivot(double d, double inverse, double least) {
  const bool finite = 0 * (d + inverse) == 0;  // or 0 · ∞ would spoil the rows that fill the block
  return finite && (d > least || (least > 0 && -d > least));
}
/// to := a, but for rows 0 .. c, which are 0.
inline void keep_below(int c, const Lanes& a, Lanes& to) {
  const Bits kept{0, c < 1 ? -1 : 0, c < 2 ? -1 : 0, c < 3 ? -1 : 0};
  to = reinterpret_cast<Lanes>(reinterpret_cast<Bits>(a) & kept);
}

std::int32_t block_eliminate(const BlockLdl& f, std::int32_t b, const double* least) {
  double *const l = block_of(f, b), *const own = l + 16 * std::int64_t{b};
  const std::int32_t begin = f.first[b], end = panel_forward(f, begin, b, l);
  Lanes s[4];
  load_block(own, s);
  for (std::int32_t q = 4 * begin; q < 4 * end; ++q) {
    double* const z = l + 4 * std::int64_t{q};
    const Lanes scaled = *reinterpret_cast<Lanes*>(z) * f.inverse[q];
    for (int c = 0; c < 4; ++c) s[c] -= z[c] * scaled;
    *reinterpret_cast<Lanes*>(z) = scaled;
  }
  // s[c][r]: entry (r, c); what is above the diagonal is of no effect. Two pivots at a time: their divisions
  // do not wait for each other, which is the longest wait of a small factor.
  for (int c = 0; c < 4; c += 2) {
    const double first = s[c][c], beside = s[c][c + 1], inverse = 1 / first;
    const double product = first * s[c + 1][c + 1], determinant = product - beside * beside;
    double pivot = determinant * inverse, next = first / determinant;
    if (!(__builtin_fabs(product) < 1e250 && __builtin_fabs(determinant) > 1e-250)) {
      pivot = s[c + 1][c + 1] - beside * (beside * inverse);
      next = 1 / pivot;
    }
    if (!is_pivot(first, inverse, least[c])) return c;
    if (!is_pivot(pivot, next, least[c + 1])) return c + 1;
    f.inverse[4 * b + c] = inverse;
    f.inverse[4 * b + c + 1] = next;
    const Lanes unit = s[c] * inverse;
    for (int j = c + 1; j < 4; ++j) s[j] -= s[c][j] * unit;
    const Lanes second = s[c + 1] * next;
    for (int j = c + 2; j < 4; ++j) s[j] -= s[c + 1][j] * second;
    keep_below(c, unit, s[c]);
    keep_below(c + 1, second, s[c + 1]);
  }
  store_block(s, own);
  return 4;
}

/// x += yᵀ g for columns y of four entries each.
inline void add_dots(std::int64_t count, const double* y, const Lanes& g, double* x) {
  for (const double* const end = x + count; x != end; x += 4, y += 16) {
    Lanes s[4];
    load_block(y, s);
    for (int r = 0; r < 4; ++r) s[r] *= g;
    const Lanes even{s[0][0], s[1][0], s[2][0], s[3][0]}, odd{s[0][1], s[1][1], s[2][1], s[3][1]};
    const Lanes next{s[0][2], s[1][2], s[2][2], s[3][2]}, last{s[0][3], s[1][3], s[2][3], s[3][3]};
    *reinterpret_cast<Lanes*>(x) += (even + odd) + (next + last);
  }
}

void panel_add(std::int64_t count, const double* y, const double* g, double* x) { add_dots(count, y, *reinterpret_cast<const Lanes*>(g), x); }

void block_forward(const BlockLdl& f, std::int32_t blocks, double* x) {
  for (std::int32_t b = 0; b < blocks; ++b) {
    const std::int64_t begin = 4 * std::int64_t{f.first[b]}, end = 4 * std::int64_t{b};
    const double* l = block_of(f, b) + 4 * begin;
    Lanes s = *reinterpret_cast<const Lanes*>(x + end), t{};
    for (std::int64_t q = begin; q < end; q += 2, l += 8) {
      s -= *reinterpret_cast<const Lanes*>(l) * x[q];
      t += *reinterpret_cast<const Lanes*>(l + 4) * x[q + 1];
    }
    s -= t;
    for (int q = 0; q < 3; ++q) s -= *reinterpret_cast<const Lanes*>(l + 4 * q) * s[q];  // l is 0 on and above the diagonal
    *reinterpret_cast<Lanes*>(x + end) = s;
  }
}

void block_backward(const BlockLdl& f, std::int32_t blocks, double* x) {
  for (std::int32_t b = blocks; b-- > 0;) {
    const std::int64_t begin = 4 * std::int64_t{f.first[b]}, end = 4 * std::int64_t{b};
    const double *l = block_of(f, b), *own = l + 4 * end;
    const double* const y = x + end;
    const double y3 = y[3], y2 = y[2] - own[11] * y3, y1 = y[1] - (own[6] * y2 + own[7] * y3), y0 = y[0] - (own[1] * y1 + (own[2] * y2 + own[3] * y3));
    const Lanes four{y0, y1, y2, y3};  // not read back: a vector waits for what was written one by one
    *reinterpret_cast<Lanes*>(x + end) = four;
    add_dots(end - begin, l + 4 * begin, -four, x + begin);
  }
}

void panel_scale(std::int64_t count, const double* y, const double* inverse, const double* k, double* scaled, double* sum) {
  Lanes s{};
  for (std::int64_t q = 0; q < count; ++q) {
    const Lanes x = *reinterpret_cast<const Lanes*>(y + 4 * q) * inverse[q];
    *reinterpret_cast<Lanes*>(scaled + 4 * q) = x;
    s += x * k[q];
  }
  *reinterpret_cast<Lanes*>(sum) = s;
}

void panel_product(std::int64_t count, const double* x, const double* y, std::int64_t stride, double* tile, double* mirror) {
  Lanes s[4];
  product(count, x, y, s);
  for (int r = 0; r < 4; ++r) *reinterpret_cast<Lanes*>(mirror + r * stride) = Lanes{s[0][r], s[1][r], s[2][r], s[3][r]};
  for (int r = 0; r < 4; ++r) *reinterpret_cast<Lanes*>(tile + r * stride) = s[r];
}

void tiles_square(const BlockLdl& f, std::int32_t count, const std::int32_t* block, const double* tiles, const double* weight) {
  for (std::int32_t a = 0; a < count; ++a) {
    Lanes weighed[4];
    load_block(tiles + 16 * std::int64_t{a}, weighed);
    for (int q = 0; q < 4; ++q) weighed[q] *= weight[q];
    for (std::int32_t b = 0; b <= a; ++b) {
      double* const to = block_of(f, block[a]) + 16 * std::int64_t{block[b]};
      const double* const tile = tiles + 16 * std::int64_t{b};
      Lanes s[4];
      load_block(to, s);
      for (int q = 0; q < 4; ++q)
        for (int c = 0; c < 4; ++c) s[c] += tile[4 * q + c] * weighed[q];
      store_block(s, to);
    }
  }
}

void tiles_times(std::int32_t count, const std::int32_t* block, const double* tiles, const double* x, double* y) {
  Lanes s[4] = {};
  for (std::int32_t t = 0; t < count; ++t, tiles += 16) {
    const Lanes four = *reinterpret_cast<const Lanes*>(x + 4 * std::int64_t{block[t]});
    for (int q = 0; q < 4; ++q) s[q] += *reinterpret_cast<const Lanes*>(tiles + 4 * q) * four;
  }
  const Lanes even{s[0][0], s[1][0], s[2][0], s[3][0]}, odd{s[0][1], s[1][1], s[2][1], s[3][1]};
  const Lanes next{s[0][2], s[1][2], s[2][2], s[3][2]}, last{s[0][3], s[1][3], s[2][3], s[3][3]};
  *reinterpret_cast<Lanes*>(y) += (even + odd) + (next + last);
}

void tiles_transposed(std::int32_t count, const std::int32_t* block, const double* tiles, const double* y, double* x) {
  for (std::int32_t t = 0; t < count; ++t, tiles += 16) {
    Lanes s[4];
    load_block(tiles, s);
    *reinterpret_cast<Lanes*>(x + 4 * std::int64_t{block[t]}) += (s[0] * y[0] + s[1] * y[1]) + (s[2] * y[2] + s[3] * y[3]);
  }
}

bool impulse_sweep(const DenseSweep& s) {
  bool changed = false;
  for (std::int32_t first = 0; first < s.size; first += 4) {
    const double* const a = s.a + s.stride * first;  // row q: a + stride q
    const std::int32_t count = s.size - first < 4 ? s.size - first : 4;
    double by[4] = {};
    for (std::int32_t q = 0; q < count; ++q) {
      const std::int32_t i = first + q;
      double w = s.w[i];
      for (std::int32_t p = 0; p < q; ++p) w += a[s.stride * p + i] * by[p];
      const double before = s.gamma[i], free = before - w * s.inverse[i], lo = s.lo[i], hi = s.hi[i];
      const bool low = free <= lo, high = free >= hi, stays = s.inverse[i] == 0;
      const double gamma = stays ? before : low ? lo : high ? hi : free;
      const int moved = low ? DenseSweep::at_lower : high ? DenseSweep::at_upper : DenseSweep::between;
      const auto state = static_cast<std::uint8_t>(stays ? s.state[i] : moved);
      changed |= state != s.state[i];
      s.state[i] = state;
      s.gamma[i] = gamma;
      by[q] = gamma - before;
    }
    if (by[0] == 0 && by[1] == 0 && by[2] == 0 && by[3] == 0) continue;
    std::int64_t j = 0;
#if defined(__AVX512F__)
    for (; j + 8 <= s.stride; j += 8) {
      Eight w = *reinterpret_cast<const Eight*>(s.w + j);
      for (int q = 0; q < 4; ++q) w += *reinterpret_cast<const Eight*>(a + s.stride * q + j) * by[q];
      *reinterpret_cast<Eight*>(s.w + j) = w;
    }
#endif
    for (; j < s.stride; j += 4) {
      Lanes w = *reinterpret_cast<const Lanes*>(s.w + j);
      for (int q = 0; q < 4; ++q) w += *reinterpret_cast<const Lanes*>(a + s.stride * q + j) * by[q];
      *reinterpret_cast<Lanes*>(s.w + j) = w;
    }
  }
  return changed;
}

/// column_products() on V fours, whose sums do not wait for each other.
template <int V>
inline void add_products(const std::int32_t* fours, std::int32_t count, const std::int32_t* columns, std::int64_t stride, const double* a, const double* x,
                         double* sum, double* size) {
  constexpr long long magnitude = 0x7fffffffffffffff;
  const Bits no_sign{magnitude, magnitude, magnitude, magnitude};
  Lanes s[V] = {}, sizes[V] = {};
  for (std::int32_t k = 0; k < count; ++k) {
    const double* const column = a + stride * columns[k];
    const double f = x[columns[k]];
#pragma GCC unroll 4
    for (int v = 0; v < V; ++v) {
      const Lanes term = *reinterpret_cast<const Lanes*>(column + 4 * fours[v]) * f;
      s[v] += term;
      sizes[v] += reinterpret_cast<Lanes>(reinterpret_cast<Bits>(term) & no_sign);
    }
  }
#pragma GCC unroll 4
  for (int v = 0; v < V; ++v) {
    *reinterpret_cast<Lanes*>(sum + 4 * fours[v]) = s[v];
    *reinterpret_cast<Lanes*>(size + 4 * fours[v]) = sizes[v];
  }
}

void column_products(const List& fours, const List& columns, std::int64_t stride, const double* a, const double* x, double* sum, double* size) {
  std::int32_t b = 0;
  for (; b + 4 <= fours.count; b += 4) add_products<4>(fours.entries + b, columns.count, columns.entries, stride, a, x, sum, size);
  switch (fours.count - b) {
    case 3: add_products<3>(fours.entries + b, columns.count, columns.entries, stride, a, x, sum, size); break;
    case 2: add_products<2>(fours.entries + b, columns.count, columns.entries, stride, a, x, sum, size); break;
    case 1: add_products<1>(fours.entries + b, columns.count, columns.entries, stride, a, x, sum, size); break;
  }
}

}  // namespace
}  // namespace mlcp
