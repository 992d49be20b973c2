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

  /// x := L⁻¹ x
  void forward(std::int32_t blocks, double* x) const {
    for (std::int32_t b = 0; b < blocks; ++b) {
      const double* l = block(b) + 16 * std::int64_t{first[b]};
      double* const own = x + 4 * std::int64_t{b};
      double s[4] = {own[0], own[1], own[2], own[3]};
      for (std::int32_t q = 4 * first[b]; q < 4 * b; ++q, l += 4)
        for (int r = 0; r < 4; ++r) s[r] -= l[r] * x[q];
      for (int q = 0; q < 4; ++q, l += 4) {
        own[q] = s[q];
        for (int r = q + 1; r < 4; ++r) s[r] -= l[r] * s[q];
      }
    }
  }

  /// x := L⁻ᵀ x
  void backward(std::int32_t blocks, double* x) const {
    for (std::int32_t b = blocks; b-- > 0;) {
      const double* own = x + 4 * std::int64_t{b};
      const auto above = [&](const double* l) { return (l[0] * own[0] + l[1] * own[1]) + (l[2] * own[2] + l[3] * own[3]); };
      for (std::int32_t q = 4 * b + 3; q-- > 4 * first[b];) x[q] -= above(block(b) + 4 * std::int64_t{q});
    }
  }
};

}  // namespace mlcp
