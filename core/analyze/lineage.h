#pragma once
#include <span>

#include "memory/array.h"

namespace mlcp {

/// Common ancestors in an elimination forest in postorder.
class Lineage {
 public:
  explicit Lineage(const Memory& m) : chain_end_(m) {}

  /// parent: of every position, −1 at a root; used until the next build.
  void build(std::span<const std::int32_t> parent);
  /// The lowest position that both descend from; where there is none, the later of their roots.
  /// cost: the chains between them, a few in a forest that does little but branch.
  std::int32_t meet(std::int32_t p, std::int32_t q) const;

 private:
  std::span<const std::int32_t> parent_;
  Array<std::int32_t> chain_end_;  // p, p + 1 … chain_end_[p] are each other's parents
};

}  // namespace mlcp
