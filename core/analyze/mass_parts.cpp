#include "analyze/mass_parts.h"

#include <algorithm>

#include "analyze/union_find.h"

namespace mlcp {

void MassParts::build(const KktPattern& pattern) {
  const std::int32_t size = pattern.size();
  start_sets(parent_, size);
  for (std::int32_t p = 0; p < size; ++p)
    if (!pattern.is_row(p))
      for (std::int32_t t = pattern.lower_pointers[p]; t < pattern.lower_pointers[p + 1]; ++t)
        if (!pattern.is_row(pattern.lower_rows[t])) join(parent_, p, pattern.lower_rows[t]);

  // velocities that only rows couple, and the same first row: those of a body with a diagonal mass fill a four together
  seen_.assign(size, 0);
  for (std::int32_t p = 0; p < size; ++p) ++seen_[root_of(parent_, p)];
  const auto alone = [&](std::int32_t p) { return !pattern.is_row(p) && seen_[parent_[p]] == 1 && pattern.lower_pointers[p] < pattern.lower_pointers[p + 1]; };
  const auto first_row = [&](std::int32_t p) { return pattern.lower_rows[pattern.lower_pointers[p]]; };
  for (std::int32_t p = 0; p < size;) {
    std::int32_t last = p + 1;
    while (alone(p) && last < std::min(size, p + 4) && alone(last) && first_row(p) == first_row(last)) ++last;
    for (std::int32_t q = p + 1; q < last; ++q) parent_[q] = p;
    p = last;
  }

  // a part stands under its first position; large ones are struck out
  seen_.assign(size, 0);
  for (std::int32_t p = 0; p < size; ++p) ++seen_[parent_[p] = root_of(parent_, p)];
  part_of.assign(size, -1);
  pointers.assign(1, 0);
  block.assign(1, 0);
  first_four.assign(1, 0);
  before.resize(size + 1);
  for (std::int32_t p = 0; p < size; ++p) {
    before[p] = count();
    if (pattern.is_row(p) || seen_[parent_[p]] > largest) continue;
    const std::int32_t root = parent_[p];
    if (root == p) {
      part_of[p] = count();
      pointers.push_back(pointers.back() + seen_[p]);
      first_four.push_back(first_four.back() + (seen_[p] + 3) / 4);
      block.push_back(block.back() + static_cast<std::int64_t>(seen_[p]) * seen_[p]);
    }
    part_of[p] = part_of[root];
  }
  before[size] = count();
  members.resize(pointers.back());
  seen_.assign(pointers.span().first(count()));
  for (std::int32_t p = 0; p < size; ++p)
    if (part_of[p] >= 0) members[seen_[part_of[p]]++] = p;

  seen_.assign(count(), -1);
  response_pointers.assign(1, 0);
  response_part_pointers.assign(1, 0);
  response_parts.clear();
  four_pointers.assign(1, 0);
  fours.clear();
  beside.clear();
  reachable.assign(pattern.rows(), 1);
  for (std::int32_t o = 0; o < pattern.rows(); ++o) {
    std::int64_t entries = response_pointers.back();
    std::int32_t t = pattern.row_pointers[o];
    for (; t < pattern.row_pointers[o + 1] && !pattern.is_row(pattern.row_columns[t]); ++t) {
      const std::int32_t part = part_of[pattern.row_columns[t]];
      if (part < 0) {
        reachable[o] = 0;
      } else if (seen_[part] != o) {
        seen_[part] = o;
        response_parts.push_back(part);
        for (std::int32_t f = first_four[part]; f < first_four[part + 1]; ++f) fours.push_back(f);
        entries += this->size(part);
      }
    }
    beside.push_back(t);
    response_pointers.push_back(entries);
    response_part_pointers.push_back(static_cast<std::int32_t>(response_parts.size()));
    four_pointers.push_back(static_cast<std::int64_t>(fours.size()));
  }
}

}  // namespace mlcp
