#pragma once
#include "analyze/elimination_tree.h"

namespace mlcp {

/// How many rows each column of L has below the diagonal, without L (Gilbert, Ng & Peyton 1994): row i's entries are the union of tree paths from the
/// leaves of its subtree up to i; a leaf adds the part of its path that those before it have not, down from where the two paths meet.
class ColumnCounts {
 public:
  explicit ColumnCounts(const Memory& m) : count(m), first_(m), latest_(m), reached_(m), ancestor_(m) {}
  Array<std::int32_t> count;

  /// before: the order is a postorder of the tree.     cost: nearly O(entries of K).
  void find(const KktPattern& pattern, const EliminationTree& tree);

 private:
  std::int32_t meet(std::int32_t p);
  Array<std::int32_t> first_;     // position → the first position of its subtree
  Array<std::int32_t> latest_;    // row → the last leaf of its subtree so far, −1
  Array<std::int32_t> reached_;   // row → the largest first_ of its columns so far: a column with a larger one is a leaf
  Array<std::int32_t> ancestor_;  // union-find: the root of what has been passed of the tree
};

}  // namespace mlcp
