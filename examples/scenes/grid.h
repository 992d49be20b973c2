#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vector.h"

namespace scenes {

/// Broad phase: all pairs (a, b), a < b, whose centres lie in the same or in neighbouring cells of edge `cell`, so at least all
/// pairs closer than `cell`; sorted. Cost O(n log n) for bounded density.
std::vector<std::pair<std::int32_t, std::int32_t>> near_pairs(std::span<const Point> centres, double cell);

}  // namespace scenes
