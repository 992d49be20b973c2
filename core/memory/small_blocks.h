#pragma once
#include "memory/memory.h"

namespace mlcp {

/// Small blocks out of slabs, for the many small arrays of one object: with an allocation each, these were a fifth of a robot's first solve.
/// Blocks that are given back are kept for the next one of their size; slabs go back with the object. Whatever is larger goes to the source, and
/// everything does under an address sanitizer, which is to see every block by itself. Not for several threads.
class SmallBlocks {
 public:
  explicit SmallBlocks(const Memory& source) : source_(source) {}
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
  static constexpr std::size_t smallest = 32, largest = smallest << (sizes - 1), slab_size = 8192;
  struct Block {
    Block* next;
  };

  static int size_class(std::size_t bytes);
  static bool is_small(std::size_t bytes);
  static void* reallocate(void* self, void* block, std::size_t old_size, std::size_t new_size);
  static void release(void* self, void* block, std::size_t size);
  void* take(int size_class);

  const Memory source_;
  Block* free_[sizes] = {};
  Block* slabs_ = nullptr;
  char *next_ = nullptr, *end_ = nullptr;  // of the last slab, what no block was taken from
};

}  // namespace mlcp
