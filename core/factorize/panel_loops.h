/// The panel loops of Kernels, compiled once by each kernels*.cpp with its own instruction set, like kernel_loops.h.
#include <cstdint>

#include "factorize/kernels.h"

namespace mlcp {
namespace {

/// Four doubles, one AVX register or two of SSE2.
typedef double Lanes __attribute__((vector_size(32), aligned(8), may_alias));
typedef long long Bits __attribute__((vector_size(32), aligned(8)));

inline void load_block(const double* from, Lanes (&s)[4]) {
  for (int r = 0; r < 4; ++r) s[r] = *reinterpret_cast<const Lanes*>(from + 4 * r);
}
inline void store_block(const Lanes (&s)[4], double* to) {
  for (int r = 0; r < 4; ++r) *reinterpret_cast<Lanes*>(to + 4 * r) = s[r];
}

/// s(r, :) −= Σ_q left(q, r) right(q, :), in order of q.
inline void subtract_product(std::int64_t count, const double* left, const double* right, Lanes (&s)[4]) {
  Lanes s0 = s[0], s1 = s[1], s2 = s[2], s3 = s[3];
  for (const double* const end = left + 4 * count; left != end; left += 4, right += 4) {
    const Lanes x = *reinterpret_cast<const Lanes*>(right);
    s0 -= left[0] * x;
    s1 -= left[1] * x;
    s2 -= left[2] * x;
    s3 -= left[3] * x;
  }
  s[0] = s0, s[1] = s1, s[2] = s2, s[3] = s3;
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
    if (from < end) subtract_product(4 * (end - from), l + 16 * std::int64_t{from}, y + 16 * std::int64_t{from}, s);
    s[1] -= own[1] * s[0];
    s[2] -= own[2] * s[0];
    s[3] -= own[3] * s[0];
    s[2] -= own[6] * s[1];
    s[3] -= own[7] * s[1];
    s[3] -= own[11] * s[2];
    store_block(s, y + 16 * std::int64_t{b});
    const Bits any = reinterpret_cast<Bits>(s[0]) | reinterpret_cast<Bits>(s[1]) | reinterpret_cast<Bits>(s[2]) | reinterpret_cast<Bits>(s[3]);
    if ((any[0] | any[1] | any[2] | any[3]) != 0) end = b + 1;
  }
  return end;
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
  // s[c][r]: entry (r, c); what is above the diagonal is of no effect
  for (int c = 0; c < 4; ++c) {
    const double d = s[c][c], inverse = 1 / d;
    if (!(d > least[c])) return c;
    f.inverse[4 * b + c] = inverse;
    const Lanes unit = s[c] * inverse;
    for (int j = c + 1; j < 4; ++j) s[j] -= s[c][j] * unit;
    s[c] = unit;
    for (int r = 0; r <= c; ++r) s[c][r] = 0;
  }
  store_block(s, own);
  return 4;
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

void panel_product(std::int64_t count, const double* x, const double* y, double* tile) {
  Lanes s[4] = {};
  subtract_product(count, x, y, s);
  for (int r = 0; r < 4; ++r) s[r] = -s[r];
  store_block(s, tile);
}

void sweep(std::int64_t size, std::int64_t stride, double* t, std::int64_t p, double sign, double* column) {
  for (std::int64_t i = 0; i < p; ++i) column[i] = t[p * stride + i];
  for (std::int64_t i = p; i < size; ++i) column[i] = t[i * stride + p];
  for (std::int64_t i = size; i < stride; ++i) column[i] = 0;
  const double inverse = 1 / column[p];
  column[p] = 0;
  for (std::int64_t i = 0; i < size; ++i) {
    if (column[i] == 0) continue;
    double* const row = t + i * stride;
    const double factor = column[i] * inverse;
    for (std::int64_t j = 0; j <= i; j += 4) *reinterpret_cast<Lanes*>(row + j) -= factor * *reinterpret_cast<const Lanes*>(column + j);
    (p < i ? row[p] : t[p * stride + i]) = sign * factor;
  }
  t[p * stride + p] = -inverse;
}

}  // namespace
}  // namespace mlcp
