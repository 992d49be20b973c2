#include "analyze/lineage.h"

namespace mlcp {

void Lineage::build(std::span<const std::int32_t> parent) {
  parent_ = parent;
  const auto size = static_cast<std::int32_t>(parent.size());
  chain_end_.resize(size);
  for (std::int32_t p = size - 1; p >= 0; --p) chain_end_[p] = parent[p] == p + 1 ? chain_end_[p + 1] : p;
}

std::int32_t Lineage::meet(std::int32_t p, std::int32_t q) const {
  while (true) {
    if (p > q) std::swap(p, q);
    const std::int32_t end = chain_end_[p];
    if (q <= end) return q;
    if (parent_[end] >= 0) {
      p = parent_[end];
      continue;
    }
    // p's root is before q: another tree
    while (parent_[chain_end_[q]] >= 0) q = parent_[chain_end_[q]];
    return chain_end_[q];
  }
}

}  // namespace mlcp
