#pragma once
#include <new>

#include "memory/memory.h"

namespace mlcp {

/// A part that is made when it is first asked for: of many objects most problems need few, and a tiny problem is solved in the time that it takes to make
/// and destroy the others. fails: bad_alloc; then it is not made.
template <class T>
class Lazy {
 public:
  explicit Lazy(const Memory& memory) : memory_(memory) {}
  Lazy(const Lazy&) = delete;
  Lazy& operator=(const Lazy&) = delete;
  ~Lazy() { reset(); }

  /// NULL: not made.
  const T* made() const { return object_; }
  T& operator*() {
    if (!object_) make();
    return *object_;
  }
  T* operator->() { return &**this; }
  /// Gives its memory back.
  void reset() {
    if (!object_) return;
    object_->~T();
    memory_.release(object_, sizeof(T));
    object_ = nullptr;
  }

 private:
  void make() {
    void* const block = memory_.reallocate(nullptr, 0, sizeof(T));
    try {
      object_ = new (block) T(memory_);
    } catch (...) {
      memory_.release(block, sizeof(T));
      throw;
    }
  }

  const Memory memory_;
  T* object_ = nullptr;
};

}  // namespace mlcp
