#include "assemble/keys.h"

#include <bit>

namespace mlcp {

namespace {

constexpr std::int32_t none = -1;

/// The finaliser of SplitMix64 (Steele, Lea & Flood 2014): engines number their contacts in sequence or by address.
std::uint64_t scatter(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

KeyTable::Slot& KeyTable::slot_of(std::uint64_t key) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = scatter(key) & mask;
  while (slots_[i].key != 0 && slots_[i].key != key) i = (i + 1) & mask;
  return slots_[i];
}

void KeyTable::build(std::span<const std::uint64_t> keys) {
  slots_.assign(keys.empty() ? 0 : std::bit_ceil(2 * keys.size()), {0, none});
  next_.resize(keys.size());
  // backwards, so that every chain starts with the row that was added first
  for (std::size_t row = keys.size(); row-- > 0;) {
    if (keys[row] == 0) continue;
    Slot& slot = slot_of(keys[row]);
    next_[row] = slot.first;
    slot = {keys[row], static_cast<std::int32_t>(row)};
  }
}

std::int32_t KeyTable::take(std::uint64_t key) {
  if (key == 0 || slots_.empty()) return none;
  Slot& slot = slot_of(key);
  const std::int32_t row = slot.first;
  if (row != none) slot.first = next_[row];
  return row;
}

void KeyTable::trim() {
  slots_.clear();
  slots_.trim();
  next_.clear();
  next_.trim();
}

}  // namespace mlcp
