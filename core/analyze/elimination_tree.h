#pragma once
#include <span>

#include "analyze/kkt_pattern.h"

namespace mlcp {

/// Elimination forest (Liu 1990): parent[p] = first row below the diagonal of column p of L, −1 at a root. A connected island
/// has one root.
struct EliminationTree {
  Array<std::int32_t> parent;
  explicit EliminationTree(const Memory& m) : parent(m), ancestor_(m), head_(m), next_(m), stack_(m), position_(m) {}

  /// cost: nearly O(entries of K).
  void build(const KktPattern& pattern);
  /// The same without the pattern. before: every row stands behind the velocities that it touches.
  void build(const Problem& problem, std::span<const std::int32_t> order);
  /// Positions so that every subtree, hence every island, is contiguous; children keep their order. An order that is
  /// one already comes back unchanged.
  void postorder(Array<std::int32_t>& sequence);
  /// The tree of the order that takes positions in this sequence, a postorder.
  void relabel(std::span<const std::int32_t> sequence);

 private:
  void start(std::int32_t size);
  void climb(std::int32_t q, std::int32_t p);
  Array<std::int32_t> ancestor_, head_, next_, stack_, position_;
};

}  // namespace mlcp
