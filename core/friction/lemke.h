#pragma once
#include <cstdint>
#include <span>

#include "memory/array.h"

namespace mlcp {

/// Dense LCP w = q + M z, 0 ≤ z ⊥ w ≥ 0 by complementary pivoting (Lemke 1965; Cottle, Pang & Stone 1992, 4.4). M need not be symmetric; for
/// copositive-plus M, as of the Stewart-Trinkle form, it ends with a solution or shows that there is none.
class Lemke {
 public:
  explicit Lemke(const Memory& m) : dictionary_(m), basic_(m), nonbasic_(m) {}

  /// matrix: size × size by rows. z: size numbers.
  /// false: a secondary ray, or more pivots than a solution can need short of cycling.      cost: size² a pivot.
  bool solve(std::int32_t size, std::span<const double> matrix, std::span<const double> q, std::span<double> z);

 private:
  void pivot(std::int32_t row, std::int32_t column);
  std::int32_t leaving(std::int32_t column) const;

  std::int32_t size_ = 0;
  /// basic = D · (nonbasic, 1), size + 2 columns. Variables: w is 0 … size − 1, z is size … 2 size − 1, z₀ is 2 size.
  Array<double> dictionary_;
  Array<std::int32_t> basic_, nonbasic_;
};

}  // namespace mlcp
