#include "factorize/mass_response.h"

#include <algorithm>
#include <utility>

#include "factorize/small_ldl.h"

namespace mlcp {
void MassResponse::prepare(const MassParts& parts, const KktPattern& pattern) {
  parts_ = &parts;
  pattern_ = &pattern;
  for (auto* a : {&jacobian_, &entries_}) a->resize(4 * parts.fours.size());
  for (auto* a : {&velocity, &direction}) a->assign(4 * static_cast<std::size_t>(parts.first_four.back()), 0.0);
  for (auto* a : {&diagonal, &inverse}) a->resize(pattern.rows());
  lower_.resize(parts.block.back());
  dense_.assign(pattern.size(), 0.0);
}

bool MassResponse::compute(const Island& island, const KktValues& values, std::int64_t& work) {
  const MassParts& parts = *parts_;
  for (std::int32_t part = first_part(island); part < last_part(island); ++part)
    if (!decompose_part(part, values, work)) return false;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o)
    if (!parts.reachable[o]) return false;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    for (std::int32_t t = pattern_->row_pointers[o]; t < parts.beside[o]; ++t) dense_[pattern_->row_columns[t]] = values.row[t];
    double a = -values.diagonal[pattern_->row_position[o]];
    double *j = jacobian_.data() + 4 * parts.four_pointers[o], *e = entries_.data() + 4 * parts.four_pointers[o];
    for (std::int32_t s = parts.response_part_pointers[o]; s < parts.response_part_pointers[o + 1]; ++s) {
      const std::int32_t part = parts.response_parts[s], d = parts.size(part), padded = 4 * (parts.first_four[part + 1] - parts.first_four[part]);
      const std::int32_t* member = parts.members.data() + parts.pointers[part];
      for (std::int32_t c = 0; c < padded; ++c) j[c] = e[c] = c < d ? std::exchange(dense_[member[c]], 0.0) : 0.0;
      small_solve(d, lower_.data() + parts.block[part], e);
      for (std::int32_t c = 0; c < d; ++c) a += j[c] * e[c];
      j += padded;
      e += padded;
    }
    diagonal[o] = a;
    inverse[o] = 1 / a;
  }
  work += parts.response_pointers[island.last_row] - parts.response_pointers[island.first_row];
  return true;
}

/// L D Lᵀ of a part, its velocities in order.     false: it is not positive definite.
bool MassResponse::decompose_part(std::int32_t part, const KktValues& values, std::int64_t& work) {
  const MassParts& parts = *parts_;
  const std::int32_t d = parts.size(part), *member = parts.members.data() + parts.pointers[part];
  double* lower = lower_.data() + parts.block[part];
  if (d == 1) {
    *lower = values.diagonal[*member];
    return *lower > 0;
  }
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
  work += static_cast<std::int64_t>(d) * d;
  return small_factor(d, lower);
}

void MassResponse::solve(const Island& island, const double* x) {
  for (std::int32_t part = first_part(island); part < last_part(island); ++part) {
    double* u = velocity.data() + place(part);
    for (std::int32_t m = parts_->pointers[part]; m < parts_->pointers[part + 1]; ++m) u[m - parts_->pointers[part]] = x[parts_->members[m]];
    small_solve(parts_->size(part), lower_.data() + parts_->block[part], u);
  }
}

void MassResponse::give(const Island& island, double* x) const {
  for (std::int32_t part = first_part(island); part < last_part(island); ++part) {
    const double* u = velocity.data() + place(part);
    for (std::int32_t m = parts_->pointers[part]; m < parts_->pointers[part + 1]; ++m) x[parts_->members[m]] = u[m - parts_->pointers[part]];
  }
}

void MassResponse::clear_direction(const Island& island) { std::ranges::fill(of(direction, island), 0.0); }

void MassResponse::advance(const Island& island, double t) {
  const std::span<double> u = of(velocity, island), du = of(direction, island);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += t * du[i];
}

}  // namespace mlcp
