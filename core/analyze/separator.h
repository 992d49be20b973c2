#pragma once
#include <span>

#include "analyze/quotient_graph.h"

namespace mlcp {

/// Vertex separators of bulky parts of a graph by multilevel bisection (Karypis & Kumar 1998), where the library is built with METIS
/// (MLCP_WITH_METIS); else it finds none. METIS has memory of its own, and seeds the C library's rand() for its bits to be the same every time.
class Separator {
 public:
  explicit Separator(const Memory& m) : part(m), local_(m), seen_(m), pointers_(m), neighbours_(m) {}

  /// Whether the library is built with METIS.
  static bool available();

  /// part of each member: 0 and 1, which no edge joins, or 2.  false: there is none to be had.
  /// cost: O(entries of the expanded cliques).
  bool find(const QuotientGraph& graph, std::span<const std::int32_t> members);

  Array<std::int32_t> part;

 private:
  void expand(const QuotientGraph& graph, std::span<const std::int32_t> members);

  Array<std::int32_t> local_;  // variable → member, −1
  Array<std::int32_t> seen_, pointers_, neighbours_;
};

}  // namespace mlcp
