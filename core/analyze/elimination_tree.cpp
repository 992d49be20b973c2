#include "analyze/elimination_tree.h"

namespace mlcp {

void EliminationTree::build(const KktPattern& pattern) {
  const std::int32_t size = pattern.size();
  parent.assign(size, -1);
  ancestor_.assign(size, -1);
  for (std::int32_t p = 0; p < size; ++p) {
    for (std::int32_t t = pattern.upper_pointers[p]; t < pattern.upper_pointers[p + 1]; ++t) {
      for (std::int32_t q = pattern.upper_rows[t]; q >= 0 && q < p;) {
        const std::int32_t above = ancestor_[q];
        ancestor_[q] = p;
        if (above < 0) parent[q] = p;
        q = above;
      }
    }
  }
}

void EliminationTree::postorder(Array<std::int32_t>& sequence) {
  const auto size = static_cast<std::int32_t>(parent.size());
  head_.assign(size + 1, -1);  // head_[size]: the roots
  next_.resize(size);
  for (std::int32_t p = size - 1; p >= 0; --p) {
    const std::int32_t above = parent[p] < 0 ? size : parent[p];
    next_[p] = head_[above];
    head_[above] = p;
  }
  sequence.clear();
  for (std::int32_t root = head_[size]; root >= 0; root = next_[root]) {
    stack_.clear();
    stack_.push_back(root);
    while (!stack_.empty()) {
      const std::int32_t p = stack_.back();
      if (const std::int32_t child = head_[p]; child >= 0) {
        head_[p] = next_[child];
        stack_.push_back(child);
      } else {
        stack_.pop_back();
        sequence.push_back(p);
      }
    }
  }
}

}  // namespace mlcp
