#pragma once
#include <cstdint>

#include "factorize/block_ldl.h"

namespace mlcp {

/// Columns first .. last − 1 that nest: column j has the rows of column first from the (j − first)-th on, so that what all of them act on
/// is gathered once, behind which each column is one dense loop. Or, for solves, columns with equal rows that do not act on each other.
struct Stretch {
  std::int32_t first, last;
  std::int64_t count;            ///< rows of column first
  const std::int32_t* rows;
  bool equal = false;
};

/// What the loops over entries of L work on; by position, column j's entries from values + pointers[j] on.
struct FactorArrays {
  double* values;                ///< C = L D
  const std::int64_t* pointers;
  const std::uint8_t* in;
  double* pivot;
  double* inverse;               ///< 1/d, 0 for what is out
  double* gathered;              ///< room for a stretch from its first column on
};

/// Not std::span: nothing inline from elsewhere may be compiled with AVX.
struct List {
  std::int32_t count;
  const std::int32_t* entries;
};

/// A dense symmetric A on some rows with its impulses, for a sweep of projected Gauss-Seidel. stride: of A's rows, `size` rounded up to four; what fills them is 0.
struct DenseSweep {
  enum State : std::uint8_t { at_lower, between, at_upper };
  std::int32_t size;
  std::int64_t stride;
  const double *a, *inverse;     ///< inverse: 1/aᵢᵢ, 0 for rows to be left out
  const double *lo, *hi;
  double *gamma, *w;             ///< w: stride entries, A γ + b
  std::uint8_t* state;
};

/// The hot loops of sparse factors, of small dense ones and of diagonal masses, once for every x86-64 CPU, once for those with AVX2 and once for those with AVX-512. Sums go into the
/// same parts in all, products are not fused: all give the same bits. What returns a count has touched so many entries.
struct Kernels {
  /// y := y − C(:,j) y_j/d_j for the columns of a stretch that are in, in order.
  std::int64_t (*forward)(const FactorArrays&, const Stretch&, double* y);
  /// sum := Σ_k f_k c_k over `columns` runs of `count` entries, in order of k.
  void (*combine)(std::int64_t count, std::int32_t columns, const double* const* c, const double* f, double* sum);
  /// block[stride · a + b] += Σ_j c_j[a] c_j[b] / d_j over columns of `count` ≤ 16 entries, in order of j, for b ≥ a; stride: count rounded up to four.
  /// block: room for stride² entries, those with b < a are not to be read.
  void (*products)(std::int64_t count, std::int32_t columns, const double* const* c, const double* inverse, double* block);
  /// x_j := (x_j − C(:,j)ᵀ x) / d_j for the columns of a stretch that are in, in reverse.
  std::int64_t (*backward)(const FactorArrays&, const Stretch&, double* x);
  /// One stretch of the rank-1 update "trailing matrix += σ w wᵀ". Gill, Golub, Murray & Saunders (1974), method C1, on C = L D:
  ///     d' = d + σ w_j²,  c' = c + σ w_j w,  w := w − (w_j/d) c,  σ := σ d/d'.
  /// after: w is 0 on the stretch's columns; negative: a pivot cancels or changes sign, the factor is stale.
  std::int64_t (*rank_one)(const FactorArrays&, const Stretch&, double* w, double& sigma);

  /// Y := L⁻¹ Y for a panel of four vectors, y[4q + lane], that are 0 before block `begin`.  returns the block behind the last one that is not 0.
  std::int32_t (*panel_forward)(const BlockLdl&, std::int32_t begin, std::int32_t blocks, double* y);
  /// Replaces block b of the matrix (entries on and below the diagonal) by that of L. before: the blocks above are done.  returns how many of its rows
  /// have finite pivots with finite inverses above least[0..3], or below −least where that is not 0, before the first that has not: 4, or the
  /// block is spoilt.
  std::int32_t (*block_eliminate)(const BlockLdl&, std::int32_t b, const double* least);
  /// x := L⁻¹ x; x := L⁻ᵀ x.
  void (*block_forward)(const BlockLdl&, std::int32_t blocks, double* x);
  void (*block_backward)(const BlockLdl&, std::int32_t blocks, double* x);
  /// x[q] += Σ_r y[4q + r] g[r] over `count` entries q, a multiple of four.
  void (*panel_add)(std::int64_t count, const double* y, const double* g, double* x);
  /// scaled := d⁻¹ y, sum[lane] := Σ_q scaled[4q + lane] k[q], over `count` entries q.
  void (*panel_scale)(std::int64_t count, const double* y, const double* inverse, const double* k, double* scaled, double* sum);
  /// tile[stride · r + lane] := Σ_q x[4q + r] y[4q + lane] over `count` entries q; mirror[stride · lane + r] the same, before that.
  void (*panel_product)(std::int64_t count, const double* x, const double* y, std::int64_t stride, double* tile, double* mirror);
  /// For a panel of four rows of J, `count` tiles of four velocities each, with row q at tile[4q], by ascending block:
  /// f += JᵀWJ, entries on and below the diagonal (what is above it in a block is of no effect);   y[0..3] += J x;   x += Jᵀy.
  void (*tiles_square)(const BlockLdl&, std::int32_t count, const std::int32_t* block, const double* tiles, const double* weight);
  void (*tiles_times)(std::int32_t count, const std::int32_t* block, const double* tiles, const double* x, double* y);
  void (*tiles_transposed)(std::int32_t count, const std::int32_t* block, const double* tiles, const double* y, double* x);
  /// One sweep by fours of rows, whose impulses all slacks follow at once. after: w goes with γ.  returns whether a row changes its state.
  bool (*impulse_sweep)(const DenseSweep&);
  /// sum := Σ_j a(:,j) x_j, size := Σ_j |a(:,j) x_j| on fours of entries, over columns j of `stride` entries in the order of their list.
  void (*column_products)(const List& fours, const List& columns, std::int64_t stride, const double* a, const double* x, double* sum, double* size);

  /// x := D⁻¹ k of a diagonal D.  returns whether all of it is positive; x is 0 where it is not.
  bool (*diagonal_solve)(std::int64_t count, const double* d, const double* k, double* x);
  /// Whether |dx − k| ≤ bound (|dx| + |k|) < ∞ for all entries; largest := max(largest, |dx − k|).
  bool (*diagonal_within)(std::int64_t count, const double* d, const double* x, const double* k, double bound, double* largest);
};

/// The table for the CPU this runs on.
const Kernels& kernels_for_this_cpu();
extern const Kernels portable_kernels;
#if defined(__x86_64__)
extern const Kernels avx2_kernels;
extern const Kernels avx512_kernels;  ///< where the compiler has AVX-512
#endif

}  // namespace mlcp
