#include "analyze/mass_parts.h"

#include "analyze/union_find.h"

namespace mlcp {

void MassParts::build(const KktPattern& pattern) {
  const std::int32_t size = pattern.size();
  start_sets(parent_, size);
  for (std::int32_t p = 0; p < size; ++p)
    if (!pattern.is_row(p))
      for (std::int32_t t = pattern.lower_pointers[p]; t < pattern.lower_pointers[p + 1]; ++t)
        if (!pattern.is_row(pattern.lower_rows[t])) join(parent_, p, pattern.lower_rows[t]);

  // a part stands under its first position; large ones are struck out
  seen_.assign(size, 0);
  for (std::int32_t p = 0; p < size; ++p) ++seen_[parent_[p] = root_of(parent_, p)];
  part_of.assign(size, -1);
  pointers.assign(1, 0);
  block.assign(1, 0);
  for (std::int32_t p = 0; p < size; ++p) {
    if (pattern.is_row(p) || seen_[parent_[p]] > largest) continue;
    const std::int32_t root = parent_[p];
    if (root == p) {
      part_of[p] = count();
      pointers.push_back(pointers.back() + seen_[p]);
      block.push_back(block.back() + static_cast<std::int64_t>(seen_[p]) * seen_[p]);
    }
    part_of[p] = part_of[root];
  }
  members.resize(pointers.back());
  seen_.assign(pointers.span().first(count()));
  for (std::int32_t p = 0; p < size; ++p)
    if (part_of[p] >= 0) members[seen_[part_of[p]]++] = p;

  seen_.assign(count(), -1);
  response_pointers.assign(1, 0);
  response_part_pointers.assign(1, 0);
  response_parts.clear();
  response_columns.clear();
  reachable.assign(pattern.rows(), 1);
  for (std::int32_t o = 0; o < pattern.rows(); ++o) {
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) {
      const std::int32_t p = pattern.row_columns[t], part = part_of[p];
      if (part < 0) {
        if (!pattern.is_row(p)) reachable[o] = 0;
      } else if (seen_[part] != o) {
        seen_[part] = o;
        response_parts.push_back(part);
        for (std::int32_t m = pointers[part]; m < pointers[part + 1]; ++m) response_columns.push_back(members[m]);
      }
    }
    response_pointers.push_back(static_cast<std::int64_t>(response_columns.size()));
    response_part_pointers.push_back(static_cast<std::int32_t>(response_parts.size()));
  }
}

}  // namespace mlcp
