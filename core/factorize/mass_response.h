#pragma once
#include "analyze/mass_parts.h"
#include "analyze/symbolic.h"
#include "factorize/kkt_values.h"

namespace mlcp {

/// M⁻¹Jᵀ and the diagonal of A = J M⁻¹Jᵀ + Σ, from dense L D Lᵀ factors of the connected parts of M. A is never formed.
class MassResponse {
 public:
  explicit MassResponse(const Memory& m) : entries(m), diagonal(m), lower_(m), dense_(m) {}

  Array<double> entries;   ///< as MassParts::response_pointers; the parts of a row one behind the other, members in order
  Array<double> diagonal;  ///< ordinals: A_ii

  /// allocates; forgets all numbers.
  void prepare(const MassParts& parts, const KktPattern& pattern);
  /// false: a row touches a large part, or a part is not positive definite.
  /// cost: Σ d³ over the parts, Σ d² over the rows.
  bool compute(const Island& island, const KktValues& values, std::int64_t& work);
  const MassParts& parts() const { return *parts_; }
  /// x := M⁻¹ x on the velocities of an island.
  void solve(const Island& island, double* x) const;

  /// x += M⁻¹Jᵀ e_o · t
  void add(std::int32_t o, double t, double* x) const {
    const double* e = entries.data();
    const std::int32_t* column = parts_->response_columns.data();
    for (std::int64_t s = parts_->response_pointers[o], last = parts_->response_pointers[o + 1]; s < last; ++s) x[column[s]] += e[s] * t;
  }

 private:
  void solve_part(std::int32_t part, double* x) const;
  const MassParts* parts_ = nullptr;
  const KktPattern* pattern_ = nullptr;
  Array<double> lower_;          // MassParts::block
  mutable Array<double> dense_;  // by position
};

}  // namespace mlcp
