#pragma once
#include "analyze/kkt_pattern.h"

namespace mlcp {

/// Connected parts of M (bodies, robots) in elimination order, and the pattern of M⁻¹Jᵀ: what Gauss-Seidel works on. Parts of more than `largest`
/// velocities are not kept, nor are rows that touch them.
struct MassParts {
  static constexpr std::int32_t largest = 64;

  Array<std::int32_t> part_of;                ///< position → part, −1 for rows and velocities of large parts
  Array<std::int32_t> pointers, members;      ///< part → positions, ascending
  Array<std::int64_t> block;                  ///< part → where its d × d block begins; one more than there are parts
  Array<std::int64_t> response_pointers;      ///< ordinal → entries of its column of M⁻¹Jᵀ
  Array<std::int32_t> response_parts;         ///< ordinal → parts, response_part_pointers
  Array<std::int32_t> response_part_pointers;
  Array<std::int32_t> response_columns;       ///< positions of the entries that response_pointers count
  Array<std::uint8_t> reachable;              ///< ordinal → 1: no large part in it
  explicit MassParts(const Memory& m)
      : part_of(m), pointers(m), members(m), block(m), response_pointers(m), response_parts(m), response_part_pointers(m), response_columns(m),
        reachable(m), parent_(m), seen_(m) {}

  std::int32_t count() const { return static_cast<std::int32_t>(pointers.size()) - 1; }
  std::int32_t size(std::int32_t part) const { return pointers[part + 1] - pointers[part]; }

  /// cost: nearly O(entries of M and J).
  void build(const KktPattern& pattern);

 private:
  Array<std::int32_t> parent_, seen_;
};

}  // namespace mlcp
