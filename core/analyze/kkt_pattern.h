#pragma once
#include "analyze/selection.h"

namespace mlcp {

/// Pattern of K = [M Jᵀ; J −Σ] in elimination order, and where each value comes from. `source` indexes the values of M
/// (both nodes velocities), of J (one) or of Σ (none).
struct KktPattern {
  std::int32_t n = 0;                               ///< velocities of the problem: node < n is a velocity
  Array<std::int32_t> node, position;               ///< position → node, node → position or −1
  Array<std::int32_t> lower_pointers, lower_rows, lower_source;  ///< columns, strictly below the diagonal, rows ascending
  Array<std::int32_t> upper_pointers, upper_rows;   ///< columns, strictly above the diagonal
  Array<std::int32_t> diagonal_source;              ///< −1: structurally zero
  Array<std::int32_t> row_position;                 ///< ordinal of a constraint row → its position, ascending
  Array<std::int32_t> row_ordinal;                  ///< position → ordinal, −1 for velocities
  Array<std::int32_t> row_pointers, row_columns, row_source;     ///< constraint rows of K without the diagonal, all positions

  explicit KktPattern(const Memory& m)
      : node(m), position(m), lower_pointers(m), lower_rows(m), lower_source(m), upper_pointers(m), upper_rows(m),
        diagonal_source(m), row_position(m), row_ordinal(m), row_pointers(m), row_columns(m), row_source(m), scratch_(m) {}

  std::int32_t size() const { return static_cast<std::int32_t>(node.size()); }
  std::int32_t rows() const { return static_cast<std::int32_t>(row_position.size()); }
  bool is_row(std::int32_t p) const { return node[p] >= n; }

  /// cost: O(entries of M, J and Σ), and (entries)² of rows that come before their velocities.
  void build(const Problem& problem, std::span<const std::int32_t> order);

 private:
  Array<std::int32_t> scratch_;
};

}  // namespace mlcp
