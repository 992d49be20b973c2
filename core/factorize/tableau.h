#pragma once
#include "analyze/symbolic.h"
#include "factorize/extended.h"
#include "factorize/kkt_values.h"

namespace mlcp {

/// K of one small island in extended precision, with any nodes *in*, by sweeps (Beaton 1964; Goodnight 1979): the principal pivots of the paper's
/// tableau on a symmetric matrix. With S the nodes that are in and N the others, it holds
///
///     Q_SS = −K_SS⁻¹,   Q_NS = K_NS K_SS⁻¹,   Q_NN = K_NN − K_NS K_SS⁻¹ K_SN
///
/// Indices are positions relative to the island's first.
class Tableau {
 public:
  explicit Tableau(const Memory& m) : entry_(m), column_(m), in_(m) {}

  /// after: Q = K, nothing is in.
  void load(const Island& island, const KktPattern& pattern, const KktValues& values);

  std::int32_t size() const { return size_; }
  bool in(std::int32_t p) const { return in_[p]; }
  Extended operator()(std::int32_t p, std::int32_t q) const { return p >= q ? row(p)[q] : row(q)[p]; }

  /// Takes p in, or out if it is in. before: Q_pp is not 0.  cost: size² / 2, less where Q is sparse.  returns the entries touched.
  std::int64_t sweep(std::int32_t p);


  /// y := Q x.
  void multiply(const Extended* x, Extended* y) const;

 private:
  Extended* row(std::int32_t p) { return entry_.data() + static_cast<std::int64_t>(p) * (p + 1) / 2; }
  const Extended* row(std::int32_t p) const { return entry_.data() + static_cast<std::int64_t>(p) * (p + 1) / 2; }

  std::int32_t size_ = 0;
  Array<Extended> entry_;  // lower triangle by rows
  Array<Extended> column_;
  Array<std::uint8_t> in_;
};

}  // namespace mlcp
