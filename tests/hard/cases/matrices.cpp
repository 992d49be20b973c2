// Reduced problems known from the literature on complementarity.
#include <algorithm>

#include "hard/cases/sketch.h"

namespace hard {
namespace {

Case reduced(int m, const std::vector<double>& A, const std::vector<double>& r) {
  Sketch s;
  for (int i = 0; i < m; ++i) s.row({}, r[static_cast<std::size_t>(i)]);
  s.compliance(m, A);
  return {s.take()};
}

/// Fathi (1979): L Lᵀ with 1 on the diagonal of L and 2 below; Lemke's and Murty's methods take 2^m pivots. z = (1, 0, …).
Case fathi(double size) {
  const int m = static_cast<int>(size);
  std::vector<double> A(static_cast<std::size_t>(m) * m);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) A[static_cast<std::size_t>(i) * m + j] = 4 * std::min(i, j) + (i == j ? 1 : 2);
  return reduced(m, A, std::vector<double>(static_cast<std::size_t>(m), 1.0));
}

/// I + 11ᵀ: all rows alike at every step.
Case all_alike(double size) {
  const int m = static_cast<int>(size);
  std::vector<double> A(static_cast<std::size_t>(m) * m, 1.0);
  for (int i = 0; i < m; ++i) A[static_cast<std::size_t>(i) * m + i] = 2;
  return reduced(m, A, std::vector<double>(static_cast<std::size_t>(m), 1.0));
}

/// Hilbert's matrix, of condition 1e17 at 13 rows.
Case hilbert(double size) {
  const int m = static_cast<int>(size);
  std::vector<double> A(static_cast<std::size_t>(m) * m), r(static_cast<std::size_t>(m));
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      A[static_cast<std::size_t>(i) * m + j] = 1.0 / (i + j + 1);
      r[static_cast<std::size_t>(i)] += A[static_cast<std::size_t>(i) * m + j];
    }
  return reduced(m, A, r);
}

}  // namespace

std::vector<Family> matrix_families() {
  return {{"Fathi", "rows", {2, 5, 10, 20, 50, 200}, fathi},
          {"all rows alike", "rows", {1, 10, 100, 300}, all_alike},
          {"Hilbert", "rows", {2, 4, 6, 8, 10, 12}, hilbert}};
}

}  // namespace hard
