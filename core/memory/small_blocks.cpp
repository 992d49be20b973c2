#include "memory/small_blocks.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

namespace mlcp {

#if defined(__SANITIZE_ADDRESS__)
const bool SmallBlocks::is_transparent = true;
#elif defined(__has_feature)
const bool SmallBlocks::is_transparent = __has_feature(address_sanitizer);
#else
const bool SmallBlocks::is_transparent = false;
#endif

namespace {

/// In front of the blocks of a slab, so that these are aligned as by malloc.
constexpr std::size_t header = 32;

}  // namespace

SmallBlocks::~SmallBlocks() {
  while (slabs_) {
    Block* const next = slabs_->next;
    source_.release(slabs_, slab_size);
    slabs_ = next;
  }
}

Memory SmallBlocks::memory() {
  const mlcp_allocator hooks{this, &reallocate, &release};
  return Memory(&hooks);
}

bool SmallBlocks::is_small(std::size_t bytes) { return !is_transparent && bytes <= largest; }

int SmallBlocks::size_class(std::size_t bytes) { return bytes <= smallest ? 0 : std::bit_width((bytes - 1) / smallest); }

/// fails: bad_alloc
void* SmallBlocks::take(int size_class) {
  if (Block* const block = free_[size_class]) {
    free_[size_class] = block->next;
    return block;
  }
  const std::size_t size = smallest << size_class;
  if (static_cast<std::size_t>(end_ - next_) < size) {
    void* const slab = source_.reallocate(nullptr, 0, slab_size);
    slabs_ = new (slab) Block{slabs_};
    next_ = static_cast<char*>(slab) + header;
    end_ = static_cast<char*>(slab) + slab_size;
  }
  void* const block = next_;
  next_ += size;
  return block;
}

bool SmallBlocks::is_in_room(const void* block) const {
  const auto begin = reinterpret_cast<std::uintptr_t>(room_.data()), at = reinterpret_cast<std::uintptr_t>(block);
  return at - begin < room_.size();
}

/// A block that is not small, as long as the room is what blocks are taken from.  NULL: it is not, or too full.
void* SmallBlocks::take_from_room(std::size_t bytes) {
  const std::size_t size = (bytes + smallest - 1) / smallest * smallest;
  if (is_transparent || slabs_ || bytes > largest_in_room || static_cast<std::size_t>(end_ - next_) < size) return nullptr;
  void* const block = next_;
  next_ += size;
  return block;
}

/// What nearly every call comes for, a first small block, without the registers that the rest needs.
void* SmallBlocks::reallocate(void* self, void* block, std::size_t old_size, std::size_t new_size) {
  SmallBlocks& blocks = *static_cast<SmallBlocks*>(self);
  if (block || !is_small(new_size)) return blocks.move(block, old_size, new_size);
  const int c = size_class(new_size);
  if (Block* const kept = blocks.free_[c]) {
    blocks.free_[c] = kept->next;
    return kept;
  }
  if (static_cast<std::size_t>(blocks.end_ - blocks.next_) < smallest << c) return blocks.move(block, old_size, new_size);
  return std::exchange(blocks.next_, blocks.next_ + (smallest << c));
}

void* SmallBlocks::move(void* block, std::size_t old_size, std::size_t new_size) {
  const bool was_small = block && is_small(old_size), small = is_small(new_size);
  if (was_small && small && size_class(old_size) == size_class(new_size)) return block;
  try {
    if (block && !was_small && !small && !is_in_room(block)) return source_.reallocate(block, old_size, new_size);
    void* fresh = small ? take(size_class(new_size)) : block ? nullptr : take_from_room(new_size);
    if (!fresh) fresh = source_.reallocate(nullptr, 0, new_size);
    if (!block) return fresh;
    std::memcpy(fresh, block, std::min(old_size, new_size));
    release(this, block, old_size);
    return fresh;
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void SmallBlocks::release(void* self, void* block, std::size_t size) {
  SmallBlocks& blocks = *static_cast<SmallBlocks*>(self);
  if (is_small(size)) {
    Block*& first = blocks.free_[size_class(size)];
    first = new (block) Block{first};
  } else if (!blocks.is_in_room(block)) {  // else it goes with the room
    blocks.source_.release(block, size);
  }
}

}  // namespace mlcp
