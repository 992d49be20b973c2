#pragma once
#include <algorithm>
#include <cstdint>

#include "memory/array.h"

namespace mlcp {

/// Disjoint sets whose root is their smallest member; `parent` holds them.
inline void start_sets(Array<std::int32_t>& parent, std::int32_t count) {
  parent.resize(count);
  for (std::int32_t i = 0; i < count; ++i) parent[i] = i;
}

inline std::int32_t root_of(Array<std::int32_t>& parent, std::int32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

inline void join(Array<std::int32_t>& parent, std::int32_t i, std::int32_t j) {
  if (parent[i] == parent[j]) return;
  const std::int32_t a = root_of(parent, i), b = root_of(parent, j);
  parent[std::max(a, b)] = std::min(a, b);
}

}  // namespace mlcp
