#include "grid.h"

#include <algorithm>
#include <cmath>

namespace scenes {
namespace {

using Cell = std::array<std::int32_t, 3>;
using Occupant = std::pair<Cell, std::int32_t>;

/// Each body with its cell, sorted by cell: cells above each other are neighbours in the list.
std::vector<Occupant> sorted_by_cell(std::span<const Point> centres, double cell) {
  std::vector<Occupant> occupants;
  occupants.reserve(centres.size());
  for (std::size_t body = 0; body < centres.size(); ++body) {
    Cell at;
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = static_cast<std::int32_t>(std::floor(centres[body][axis] / cell));
    occupants.push_back({at, static_cast<std::int32_t>(body)});
  }
  std::sort(occupants.begin(), occupants.end());
  return occupants;
}

}  // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> near_pairs(std::span<const Point> centres, double cell) {
  const std::vector<Occupant> occupants = sorted_by_cell(centres, cell);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::int32_t dx = -1; dx <= 1; ++dx) {
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
      auto column = occupants.begin();  // only moves forward: shifted cells come in the same order
      for (const auto& [at, a] : occupants) {
        const Cell lowest = {at[0] + dx, at[1] + dy, at[2] - 1}, highest = {at[0] + dx, at[1] + dy, at[2] + 1};
        while (column != occupants.end() && column->first < lowest) ++column;
        for (auto near = column; near != occupants.end() && near->first <= highest; ++near) {
          if (a < near->second) pairs.push_back({a, near->second});
        }
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace scenes
