#pragma once
#include "memory/array.h"
#include "memory/error.h"

namespace mlcp {

struct Problem;

/// One state a row and, if known, its key: `key` is empty or as long as `state`.
struct Mask {
  Memory memory;
  Array<mlcp_row_state> state;
  Array<std::uint64_t> key;

  explicit Mask(const Memory& m) : memory(m), state(m), key(m) {}
};

}  // namespace mlcp
