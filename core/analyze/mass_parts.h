#pragma once
#include "analyze/kkt_pattern.h"

namespace mlcp {

/// Connected parts of M (bodies, robots) in elimination order, and the pattern of M⁻¹Jᵀ: what Gauss-Seidel works on. Parts of more than `largest`
/// velocities are not kept, nor are rows that touch them. Velocities of a part stand by fours, the last one filled up with zeros: what a row does is a
/// few vector operations then, without an index an entry.
struct MassParts {
  static constexpr std::int32_t largest = 64;

  Array<std::int32_t> part_of;                ///< position → part, −1 for rows and velocities of large parts
  Array<std::int32_t> before;                 ///< position → parts that begin before it; one more than there are positions: islands have ranges of parts
  Array<std::int32_t> pointers, members;      ///< part → positions, ascending
  Array<std::int64_t> block;                  ///< part → where its d × d block begins; one more than there are parts
  Array<std::int32_t> first_four;             ///< part → the first of its fours of velocities; one more than there are parts
  Array<std::int64_t> response_pointers;      ///< ordinal → how many entries its column of M⁻¹Jᵀ has, summed up
  Array<std::int32_t> response_parts;         ///< ordinal → parts, response_part_pointers
  Array<std::int32_t> response_part_pointers;
  Array<std::int64_t> four_pointers;          ///< ordinal → entries of `fours`
  Array<std::int32_t> fours;                  ///< of all parts that a row touches, part by part
  Array<std::int32_t> beside;                 ///< ordinal → where its entries in Σ begin in KktPattern::row_columns
  Array<std::uint8_t> reachable;              ///< ordinal → 1: no large part in it
  explicit MassParts(const Memory& m)
      : part_of(m), before(m), pointers(m), members(m), block(m), first_four(m), response_pointers(m), response_parts(m), response_part_pointers(m), four_pointers(m), fours(m), beside(m),
        reachable(m), parent_(m), seen_(m) {}

  std::int32_t count() const { return static_cast<std::int32_t>(pointers.size()) - 1; }
  std::int32_t size(std::int32_t part) const { return pointers[part + 1] - pointers[part]; }

  /// cost: nearly O(entries of M and J).
  void build(const KktPattern& pattern);

 private:
  Array<std::int32_t> parent_, seen_;
};

}  // namespace mlcp
