#include "analyze/elimination_tree.h"

namespace mlcp {

void EliminationTree::start(std::int32_t size) {
  parent.assign(size, -1);
  ancestor_.assign(size, -1);
}

/// K has an entry in row p, column q < p: p is above q, and above all that is above q so far.
inline void EliminationTree::climb(std::int32_t q, std::int32_t p) {
  while (q >= 0 && q < p) {
    const std::int32_t above = ancestor_[q];
    ancestor_[q] = p;
    if (above < 0) parent[q] = p;
    q = above;
  }
}

void EliminationTree::build(const KktPattern& pattern) {
  const std::int32_t size = pattern.size();
  start(size);
  for (std::int32_t p = 0; p < size; ++p)
    for (std::int32_t t = pattern.upper_pointers[p]; t < pattern.upper_pointers[p + 1]; ++t) climb(pattern.upper_rows[t], p);
}

void EliminationTree::build(const Problem& problem, std::span<const std::int32_t> order) {
  const std::int32_t n = problem.n(), size = static_cast<std::int32_t>(order.size());
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  start(size);
  position_.assign(n + problem.m(), -1);
  for (std::int32_t p = 0; p < size; ++p) position_[order[p]] = p;
  const auto climb_from = [&](const SparseView& a, std::int32_t column, std::int32_t first, std::int32_t p) {
    for (std::int32_t t = a.pointers[column]; t < a.pointers[column + 1]; ++t) climb(position_[first + a.indices[t]], p);
  };
  for (std::int32_t p = 0; p < size; ++p) {
    if (order[p] < n) {
      climb_from(mass, order[p], 0, p);
    } else {
      climb_from(jacobian, order[p] - n, 0, p);
      climb_from(sigma, order[p] - n, n, p);
    }
  }
}

void EliminationTree::relabel(std::span<const std::int32_t> sequence) {
  const auto size = static_cast<std::int32_t>(sequence.size());
  position_.resize(size);
  for (std::int32_t p = 0; p < size; ++p) position_[sequence[p]] = p;
  ancestor_.assign(parent.span());
  for (std::int32_t p = 0; p < size; ++p) {
    const std::int32_t above = ancestor_[sequence[p]];
    parent[p] = above < 0 ? -1 : position_[above];
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
