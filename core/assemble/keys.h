#pragma once
#include <cstdint>
#include <span>

#include "memory/array.h"

namespace mlcp {

/// Finds rows of an earlier step by their 64-bit keys. Equal keys match in order of adding, key 0 never.
class KeyTable {
 public:
  explicit KeyTable(const Memory& memory) : slots_(memory), next_(memory) {}

  /// The rows that take() finds. At most half of the slots are used.
  /// cost: expected O(keys).      fails: bad_alloc.
  void build(std::span<const std::uint64_t> keys);
  /// The first row with this key that has not been taken yet, −1 if there is none.
  std::int32_t take(std::uint64_t key);
  void trim();

 private:
  struct Slot {
    std::uint64_t key;   ///< 0: the slot is empty
    std::int32_t first;  ///< row, −1 when all are taken
  };
  Slot& slot_of(std::uint64_t key);

  Array<Slot> slots_;         ///< a power of two, or none
  Array<std::int32_t> next_;  ///< the next row with the same key, −1: none
};

}  // namespace mlcp
