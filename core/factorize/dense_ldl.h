#pragma once
#include <cmath>
#include <cstdint>

namespace mlcp {

/// Σ aᵢbᵢ in an order that neither compiler nor alignment changes. For vectors too short to be worth a call to the kernels.
inline double dot(const double* a, const double* b, std::int32_t count) {
  using Pair [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;  // two lanes: what every x86-64 has
  const auto at = [](const double* x) { return *reinterpret_cast<const Pair*>(x); };
  Pair even{0, 0}, odd{0, 0};
  std::int32_t i = 0;
  for (; i + 4 <= count; i += 4) {
    even += at(a + i) * at(b + i);
    odd += at(a + i + 2) * at(b + i + 2);
  }
  if (i + 2 <= count) {
    even += at(a + i) * at(b + i);
    i += 2;
  }
  even += odd;
  const double sum = even[0] + even[1];
  return i < count ? sum + a[i] * b[i] : sum;
}

/// L D Lᵀ of a small symmetric matrix, by rows within its envelope: row p holds columns first[p] .. p − 1, and so does row p of L. No roots, so that
/// units of powers of two change no bit. Rows are packed: row p begins at p (p − 1) / 2.
struct DenseLdl {
  double* lower;        ///< packed rows without the diagonal
  double* inverse;      ///< 1 / d
  std::int32_t* first;  ///< column where each row begins

  double* row(std::int32_t p) const { return lower + static_cast<std::int64_t>(p) * (p - 1) / 2; }

  /// Replaces row p of the matrix, with `diagonal` beside it, by that of L. before: the rows above are done.  returns the pivot d.
  /// cost: the entries of the rows that it meets.
  double eliminate(std::int32_t p, double diagonal) const {
    double* r = row(p);
    const std::int32_t begin = first[p];
    for (std::int32_t q = begin; q < p; ++q) {
      const std::int32_t from = first[q] > begin ? first[q] : begin;
      if (from < q) r[q] -= dot(r + from, row(q) + from, q - from);
    }
    double d = diagonal;
    for (std::int32_t q = begin; q < p; ++q) {
      const double l = r[q] * inverse[q];
      d -= l * r[q];
      r[q] = l;
    }
    inverse[p] = 1 / d;
    return d;
  }

  /// x := L⁻¹ x on entries begin .. size − 1, those before begin being 0.
  void forward(std::int32_t begin, std::int32_t size, double* x) const {
    for (std::int32_t p = begin + 1; p < size; ++p) {
      const std::int32_t from = first[p] > begin ? first[p] : begin;
      if (from < p) x[p] -= dot(row(p) + from, x + from, p - from);
    }
  }
  /// x := L⁻ᵀ x
  void backward(std::int32_t size, double* x) const {
    for (std::int32_t p = size; p-- > 1;) {
      const double* r = row(p);
      const double t = x[p];
      for (std::int32_t q = first[p]; q < p; ++q) x[q] -= r[q] * t;
    }
  }
};

}  // namespace mlcp
