#pragma once
#include "assemble/mask.h"
#include "assemble/problem.h"

namespace mlcp {

/// The start that rows find by themselves: where rows with the same key were left.
class WarmStart {
 public:
  explicit WarmStart(const Memory& m) : mask_(m), carry_(m) {}

  /// previous: the mask of the last solve. NULL if either side has no keys. New rows start at rest.
  /// cost: expected O(m).
  const Mask* find(const Problem& problem, const Mask& previous);
  void forget() { mask_.state.clear(); }
  /// What was found last, if it is a mask for this problem; else NULL.
  const Mask* found(const Problem& problem) const {
    return !mask_.state.empty() && static_cast<std::int32_t>(mask_.state.size()) == problem.m() ? &mask_ : nullptr;
  }

 private:
  Mask mask_;
  CarryWorkspace carry_;
};

}  // namespace mlcp
