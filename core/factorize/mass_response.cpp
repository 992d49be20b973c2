#include "factorize/mass_response.h"

#include <algorithm>

namespace mlcp {
namespace {

/// L D Lᵀ of a dense symmetric block in place, columns of d: L below the diagonal, D on it. No roots, so that units of powers of two change no
/// bit.  false: a pivot is not positive.
bool decompose(std::int32_t d, double* block) {
  for (std::int32_t c = 0; c < d; ++c) {
    double* column = block + static_cast<std::int64_t>(c) * d;
    for (std::int32_t k = 0; k < c; ++k) {
      const double* before = block + static_cast<std::int64_t>(k) * d;
      const double f = before[c] * before[k];  // l_ck · d_k
      for (std::int32_t r = c; r < d; ++r) column[r] -= f * before[r];
    }
    if (!(column[c] > 0)) return false;
    for (std::int32_t r = c + 1; r < d; ++r) column[r] /= column[c];
  }
  return true;
}

}  // namespace

void MassResponse::prepare(const MassParts& parts, const KktPattern& pattern) {
  parts_ = &parts;
  pattern_ = &pattern;
  entries.resize(parts.response_pointers.back());
  diagonal.resize(pattern.rows());
  lower_.resize(parts.block.back());
  dense_.resize(pattern.size());
}

bool MassResponse::compute(const Island& island, const KktValues& values, std::int64_t& work) {
  const MassParts& parts = *parts_;
  for (std::int32_t p = island.first; p < island.last; ++p) {
    const std::int32_t part = parts.part_of[p];
    if (part < 0 || parts.members[parts.pointers[part]] != p) continue;
    // the part's velocities in order: the block's columns
    const std::int32_t d = parts.size(part);
    double* lower = lower_.data() + parts.block[part];
    if (d == 1) {
      if (!(values.diagonal[p] > 0)) return false;
      *lower = values.diagonal[p];
      continue;
    }
    const std::int32_t* member = parts.members.data() + parts.pointers[part];
    std::fill(lower, lower + static_cast<std::int64_t>(d) * d, 0.0);
    for (std::int32_t c = 0; c < d; ++c) {
      const std::int32_t column = member[c];
      lower[static_cast<std::int64_t>(c) * d + c] = values.diagonal[column];
      for (std::int32_t t = pattern_->lower_pointers[column]; t < pattern_->lower_pointers[column + 1]; ++t) {
        const std::int32_t q = pattern_->lower_rows[t];
        if (parts.part_of[q] != part) continue;
        const std::int32_t r = static_cast<std::int32_t>(std::lower_bound(member + c, member + d, q) - member);
        lower[static_cast<std::int64_t>(c) * d + r] = values.lower[t];
      }
    }
    if (!decompose(d, lower)) return false;
    work += static_cast<std::int64_t>(d) * d;
  }
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (!parts.reachable[o]) return false;
    for (std::int32_t s = parts.response_part_pointers[o]; s < parts.response_part_pointers[o + 1]; ++s) {
      const std::int32_t part = parts.response_parts[s];
      for (std::int32_t m = parts.pointers[part]; m < parts.pointers[part + 1]; ++m) dense_[parts.members[m]] = 0;
    }
    for (std::int32_t t = pattern_->row_pointers[o]; t < pattern_->row_pointers[o + 1]; ++t)
      if (!pattern_->is_row(pattern_->row_columns[t])) dense_[pattern_->row_columns[t]] = values.row[t];
    double a = -values.diagonal[pattern_->row_position[o]];
    double* e = entries.data() + parts.response_pointers[o];
    for (std::int32_t s = parts.response_part_pointers[o]; s < parts.response_part_pointers[o + 1]; ++s) {
      const std::int32_t part = parts.response_parts[s], d = parts.size(part);
      const std::int32_t* member = parts.members.data() + parts.pointers[part];
      for (std::int32_t c = 0; c < d; ++c) e[c] = dense_[member[c]];
      solve_part(part, e);
      for (std::int32_t c = 0; c < d; ++c) a += dense_[member[c]] * e[c];
      e += d;
    }
    diagonal[o] = a;
  }
  work += parts.response_pointers[island.last_row] - parts.response_pointers[island.first_row];
  return true;
}

void MassResponse::solve_part(std::int32_t part, double* x) const {
  const std::int32_t d = parts_->size(part);
  const double* lower = lower_.data() + parts_->block[part];
  if (d == 1) {
    *x /= *lower;
    return;
  }
  for (std::int32_t c = 0; c < d; ++c)
    for (std::int32_t r = c + 1; r < d; ++r) x[r] -= lower[static_cast<std::int64_t>(c) * d + r] * x[c];
  for (std::int32_t c = d; c-- > 0;) {
    double sum = x[c] / lower[static_cast<std::int64_t>(c) * d + c];
    for (std::int32_t r = c + 1; r < d; ++r) sum -= lower[static_cast<std::int64_t>(c) * d + r] * x[r];
    x[c] = sum;
  }
}

void MassResponse::solve(const Island& island, double* x) const {
  for (std::int32_t p = island.first; p < island.last; ++p) {
    const std::int32_t part = parts_->part_of[p];
    if (part < 0 || parts_->members[parts_->pointers[part]] != p) continue;
    const std::int32_t d = parts_->size(part);
    const std::int32_t* member = parts_->members.data() + parts_->pointers[part];
    double* y = dense_.data() + p;  // the first member's place and those behind it: enough for d positions
    if (d == 1) {
      solve_part(part, x + p);
      continue;
    }
    for (std::int32_t c = 0; c < d; ++c) y[c] = x[member[c]];
    solve_part(part, y);
    for (std::int32_t c = 0; c < d; ++c) x[member[c]] = y[c];
  }
}

}  // namespace mlcp
