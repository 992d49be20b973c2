#pragma once
#include <algorithm>

#include "assemble/problem.h"

namespace mlcp {

/// The patterns of M, J and Σ as they once were: whether work that depends on them alone still stands.
class PatternCopy {
 public:
  explicit PatternCopy(const Memory& m) : mass_(m), jacobian_(m), compliance_(m) {}

  void take(const Problem& p) {
    mass_.take(p.mass);
    jacobian_.take(p.jacobian);
    compliance_.take(p.compliance);
  }
  /// cost: a comparison of the indices.
  bool fits_mass(const Problem& p) const { return mass_.fits(p.mass); }
  bool fits(const Problem& p) const { return fits_mass(p) && jacobian_.fits(p.jacobian) && compliance_.fits(p.compliance); }

 private:
  struct One {
    Array<std::int32_t> pointers, indices;
    explicit One(const Memory& m) : pointers(m), indices(m) {}
    void take(const SparseArrays& a) {
      pointers.assign(a.pointers.span());
      indices.assign(a.indices.span());
    }
    bool fits(const SparseArrays& a) const { return std::ranges::equal(pointers, a.pointers) && std::ranges::equal(indices, a.indices); }
  };
  One mass_, jacobian_, compliance_;
};

}  // namespace mlcp
