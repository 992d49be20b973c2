#include "friction/lemke.h"

#include <cmath>

namespace mlcp {
namespace {

/// Coefficients up to this block no step; ratios that differ by less are equal.
constexpr double zero = 1e-11, equal = 1e-12;
constexpr std::int64_t pivots_a_row = 50;

}  // namespace

/// nonbasic `column` becomes basic in `row`.
void Lemke::pivot(std::int32_t row, std::int32_t column) {
  const std::int32_t width = size_ + 2;
  double* r = dictionary_.data() + std::size_t(row) * width;
  const double p = r[column];
  for (std::int32_t j = 0; j < width; ++j) r[j] /= -p;
  r[column] = 1 / p;
  for (std::int32_t i = 0; i < size_; ++i) {
    double* d = dictionary_.data() + std::size_t(i) * width;
    const double f = d[column];
    if (i == row || f == 0) continue;
    d[column] = 0;
    for (std::int32_t j = 0; j < width; ++j) d[j] += f * r[j];
  }
  std::swap(basic_[row], nonbasic_[column]);
}

/// The row that blocks, −1: none. Among equal ratios z₀, else the largest pivot.
std::int32_t Lemke::leaving(std::int32_t column) const {
  const std::int32_t width = size_ + 2;
  std::int32_t best = -1;
  double least = 0, size = 0;
  for (std::int32_t i = 0; i < size_; ++i) {
    const double* d = dictionary_.data() + std::size_t(i) * width;
    const double slope = -d[column];
    if (!(slope > zero)) continue;
    const double ratio = std::max(d[size_ + 1], 0.0) / slope;
    const bool tie = best >= 0 && std::abs(ratio - least) <= equal * (1 + least);
    if (best < 0 || (tie ? basic_[best] != 2 * size_ && (basic_[i] == 2 * size_ || slope > size) : ratio < least)) {
      best = i;
      least = ratio;
      size = slope;
    }
  }
  return best;
}

bool Lemke::solve(std::int32_t size, std::span<const double> matrix, std::span<const double> q, std::span<double> z) {
  size_ = size;
  const std::int32_t width = size + 2, z0 = 2 * size;
  dictionary_.resize(std::size_t(size) * width);
  basic_.resize(size);
  nonbasic_.resize(std::size_t(size) + 1);
  std::int32_t row = -1;
  for (std::int32_t i = 0; i < size; ++i) {
    double* d = dictionary_.data() + std::size_t(i) * width;
    for (std::int32_t j = 0; j < size; ++j) d[j] = matrix[std::size_t(i) * size + j];
    d[size] = 1 + static_cast<double>(i % 61) / 61;  // a covering vector with few equal entries leaves few ties
    d[size + 1] = q[i];
    basic_[i] = i;
    nonbasic_[i] = size + i;
    if (q[i] < 0 && (row < 0 || q[i] / d[size] < dictionary_[std::size_t(row) * width + size + 1] / dictionary_[std::size_t(row) * width + size])) row = i;
  }
  nonbasic_[size] = z0;
  std::fill(z.begin(), z.end(), 0.0);
  if (row < 0) return true;
  std::int32_t column = size;
  for (std::int64_t pivots = 0; pivots < pivots_a_row * (size + 1); ++pivots) {
    const std::int32_t left = basic_[row];
    pivot(row, column);
    if (left == z0) {
      for (std::int32_t i = 0; i < size; ++i)
        if (basic_[i] >= size) z[basic_[i] - size] = std::max(0.0, dictionary_[std::size_t(i) * width + size + 1]);
      return true;
    }
    const std::int32_t enters = left < size ? left + size : left - size;
    for (column = 0; nonbasic_[column] != enters;) ++column;
    row = leaving(column);
    if (row < 0) return false;
  }
  return false;
}

}  // namespace mlcp
