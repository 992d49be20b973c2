#pragma once
#include "factorize/dense_response.h"

namespace mlcp {

/// A of a small island with any rows S *in*, as Tableau but in double and in the island's own room:
///
///     Q_SS = −A_SS⁻¹,   Q_NS = A_NS A_SS⁻¹,   Q_NN = A_NN − A_NS A_SS⁻¹ A_SN
class DenseTableau {
 public:
  explicit DenseTableau(const DenseIsland& island) : s_(island), stride_(4 * static_cast<std::int64_t>(island.panels)) {}

  /// after: Q = A.
  void load();
  double operator()(std::int32_t i, std::int32_t j) const { return i >= j ? s_.tableau[i * stride_ + j] : s_.tableau[j * stride_ + i]; }
  /// before: i is not in, and Q_ii is not 0.  cost: m² / 2, less where Q is sparse.
  void take_in(std::int32_t i) { s_.kernels->sweep(s_.m, stride_, s_.tableau, i, 1, s_.x_rows()); }
  /// before: i is in.
  void take_out(std::int32_t i) { s_.kernels->sweep(s_.m, stride_, s_.tableau, i, -1, s_.x_rows()); }

 private:
  const DenseIsland& s_;
  const std::int64_t stride_;
};

}  // namespace mlcp
