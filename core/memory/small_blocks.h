#pragma once
#include <span>

#include "memory/memory.h"

namespace mlcp {

/// Small blocks out of slabs, for the many small arrays of one object: with an allocation each, these were a fifth of a robot's first solve.
/// Blocks that are given back are kept for the next one of their size; slabs go back with the object. Whatever is larger goes to the source, and
/// everything does under an address sanitizer, which is to see every block by itself. Not for several threads.
class SmallBlocks {
 public:
  /// room: what the first blocks are taken from, also a few that are not small; the caller's, aligned as by malloc, and there as long as this.
  explicit SmallBlocks(const Memory& source, std::span<char> room = {}) : source_(source), room_(room), next_(room.data()), end_(room.data() + room.size()) {}
  SmallBlocks(const SmallBlocks&) = delete;
  SmallBlocks& operator=(const SmallBlocks&) = delete;
  ~SmallBlocks();

  /// Under an address sanitizer.
  static const bool is_transparent;

  const Memory& source() const { return source_; }
  /// For what lives no longer than this.
  Memory memory();

 private:
  static constexpr int sizes = 6;  // 32, 64 … 1024 bytes
  static constexpr std::size_t smallest = 32, largest = smallest << (sizes - 1), slab_size = 8192, largest_in_room = 6144;
  struct Block {
    Block* next;
  };

  static int size_class(std::size_t bytes);
  static bool is_small(std::size_t bytes);
  static void* reallocate(void* self, void* block, std::size_t old_size, std::size_t new_size);
  static void release(void* self, void* block, std::size_t size);
  void* move(void* block, std::size_t old_size, std::size_t new_size);
  void* take(int size_class);
  void* take_from_room(std::size_t bytes);
  bool is_in_room(const void* block) const;

  const Memory source_;
  const std::span<char> room_;
  Block* free_[sizes] = {};
  Block* slabs_ = nullptr;
  char *next_, *end_;  // of the room or the last slab, what no block was taken from
};

}  // namespace mlcp
