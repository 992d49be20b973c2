#include "factorize/tableau.h"

namespace mlcp {

void Tableau::load(const Island& island, const KktPattern& pattern, const KktValues& values) {
  size_ = island.last - island.first;
  entry_.assign(static_cast<std::size_t>(size_) * (size_ + 1) / 2, 0);
  column_.resize(size_);
  in_.assign(size_, 0);
  for (std::int32_t p = 0; p < size_; ++p) {
    const std::int32_t column = island.first + p;
    row(p)[p] = values.diagonal[column];
    for (std::int32_t t = pattern.lower_pointers[column]; t < pattern.lower_pointers[column + 1]; ++t)
      row(pattern.lower_rows[t] - island.first)[p] = values.lower[t];
  }
}

std::int64_t Tableau::sweep(std::int32_t p) {
  const Extended pivot = (*this)(p, p), sign = in_[p] ? -1 : 1;
  for (std::int32_t i = 0; i < size_; ++i) column_[i] = i == p ? 0 : (*this)(i, p);
  std::int64_t touched = size_;
  for (std::int32_t i = 0; i < size_; ++i) {
    if (column_[i] == 0) continue;
    const Extended factor = column_[i] / pivot;
    Extended* r = row(i);
    for (std::int32_t j = 0; j <= i; ++j)
      if (column_[j] != 0) r[j] -= factor * column_[j];
    (p < i ? r[p] : row(p)[i]) = sign * factor;
    touched += i;
  }
  row(p)[p] = -1 / pivot;
  in_[p] ^= 1;
  return touched;
}

void Tableau::multiply(const Extended* x, Extended* y) const {
  for (std::int32_t p = 0; p < size_; ++p) y[p] = 0;
  for (std::int32_t p = 0; p < size_; ++p) {
    const Extended* r = row(p);
    for (std::int32_t q = 0; q < p; ++q) {
      y[p] += r[q] * x[q];
      y[q] += r[q] * x[p];
    }
    y[p] += r[p] * x[p];
  }
}

}  // namespace mlcp
