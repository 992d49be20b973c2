#pragma once
#include <cstddef>
#include <cstdlib>
#include <new>

#include "mlcp.h"

namespace mlcp {

/// The caller's memory hooks; malloc and free where there are none.
/// fails: std::bad_alloc, which the C boundary turns into MLCP_ERROR_OUT_OF_MEMORY.
class Memory {
 public:
  Memory() = default;
  explicit Memory(const mlcp_allocator* hooks) {
    if (hooks) hooks_ = *hooks;
  }

  void* reallocate(void* block, std::size_t old_size, std::size_t new_size) const {
    void* p = hooks_.reallocate ? hooks_.reallocate(hooks_.context, block, old_size, new_size) : std::realloc(block, new_size);
    if (!p) throw std::bad_alloc();
    return p;
  }
  void release(void* block, std::size_t size) const {
    if (!block) return;
    if (hooks_.release)
      hooks_.release(hooks_.context, block, size);
    else
      std::free(block);
  }
  const mlcp_allocator& hooks() const { return hooks_; }

 private:
  mlcp_allocator hooks_{};
};

}  // namespace mlcp
