#include "factorize/mass_response.h"

#include <algorithm>
#include <utility>

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
      solve_part(part, e);
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
  return decompose(d, lower);
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

void MassResponse::solve(const Island& island, const double* x) {
  for (std::int32_t part = first_part(island); part < last_part(island); ++part) {
    double* u = velocity.data() + place(part);
    for (std::int32_t m = parts_->pointers[part]; m < parts_->pointers[part + 1]; ++m) u[m - parts_->pointers[part]] = x[parts_->members[m]];
    solve_part(part, u);
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
