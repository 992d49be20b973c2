#pragma once
#include <cstdint>

namespace mlcp {

/// L D Lᵀ of a small symmetric matrix by blocks of four rows, each within its envelope. Entry (4b + r, q) of L stands at block(b)[4q + r], so that
/// four rows are updated by one multiplication of the kernels (panel_loops.h); the unit diagonal and what is above it are stored as 0. Rows that
/// fill the last block are those of the unit matrix. No roots, so that units of powers of two change no bit.
struct BlockLdl {
  double* lower;        ///< reals(blocks)
  double* inverse;      ///< 4 · blocks: 1 / d
  std::int32_t* first;  ///< blocks: block of columns where each block of rows begins

  static std::int32_t blocks_of(std::int32_t rows) { return (rows + 3) / 4; }
  static std::int64_t reals(std::int64_t blocks) { return 8 * blocks * (blocks + 1); }
  double* block(std::int32_t b) const { return lower + reals(b); }
};

}  // namespace mlcp
