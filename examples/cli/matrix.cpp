#include "matrix.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace cli {
namespace {

/// Sorts entries into `count` runs by outer index, in their order; cost O(entries + count).
Compressed compress(std::int32_t count, std::span<const std::int32_t> outer, std::span<const std::int32_t> inner,
                    std::span<const double> value) {
  Compressed result;
  result.pointers.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const std::int32_t o : outer) ++result.pointers[static_cast<std::size_t>(o) + 1];
  for (std::size_t o = 0; o < static_cast<std::size_t>(count); ++o) result.pointers[o + 1] += result.pointers[o];
  std::vector<std::int32_t> next(result.pointers.begin(), result.pointers.end() - 1);
  result.indices.resize(outer.size());
  result.values.resize(outer.size());
  for (std::size_t e = 0; e < outer.size(); ++e) {
    const auto slot = static_cast<std::size_t>(next[static_cast<std::size_t>(outer[e])]++);
    result.indices[slot] = inner[e];
    result.values[slot] = value[e];
  }
  return result;
}

void check_unique(const Matrix& matrix, const Compressed& compressed, bool outer_is_row) {
  std::vector<std::int32_t> seen(static_cast<std::size_t>(std::max(matrix.rows, matrix.columns)), -1);
  for (std::size_t o = 0; o + 1 < compressed.pointers.size(); ++o) {
    for (std::int32_t e = compressed.pointers[o]; e < compressed.pointers[o + 1]; ++e) {
      const std::int32_t inner = compressed.indices[static_cast<std::size_t>(e)], outer = static_cast<std::int32_t>(o);
      std::int32_t& last = seen[static_cast<std::size_t>(inner)];
      if (last == outer) {
        const auto [i, j] = outer_is_row ? std::pair(outer, inner) : std::pair(inner, outer);
        const std::string entry = std::to_string(i + 1) + " " + std::to_string(j + 1);
        throw std::runtime_error(matrix.source + ": entry " + entry + " comes twice");
      }
      last = outer;
    }
  }
}

Matrix select(const Matrix& matrix, std::span<const std::int32_t> new_row, std::span<const std::int32_t> new_column) {
  Matrix result;
  result.source = matrix.source;
  result.symmetric = matrix.symmetric;
  for (std::size_t e = 0; e < matrix.value.size(); ++e) {
    const std::int32_t i = new_row.empty() ? matrix.row[e] : new_row[static_cast<std::size_t>(matrix.row[e])];
    const std::int32_t j = new_column.empty() ? matrix.column[e] : new_column[static_cast<std::size_t>(matrix.column[e])];
    if (i >= 0 && j >= 0) result.add(i, j, matrix.value[e]);
  }
  return result;
}

}  // namespace

Compressed compress_rows(const Matrix& matrix) {
  Compressed result = compress(matrix.rows, matrix.row, matrix.column, matrix.value);
  check_unique(matrix, result, true);
  return result;
}

Compressed compress_columns(const Matrix& matrix) {
  std::vector<std::int32_t> row = matrix.row, column = matrix.column;
  for (std::size_t e = 0; matrix.symmetric && e < row.size(); ++e) {
    if (row[e] < column[e]) std::swap(row[e], column[e]);
  }
  Compressed result = compress(matrix.columns, column, row, matrix.value);
  check_unique(matrix, result, false);
  return result;
}

Matrix expand(Matrix matrix) {
  if (!matrix.symmetric) return matrix;
  matrix.symmetric = false;
  const std::size_t entries = matrix.value.size();
  for (std::size_t e = 0; e < entries; ++e) {
    if (matrix.row[e] != matrix.column[e]) matrix.add(matrix.column[e], matrix.row[e], matrix.value[e]);
  }
  return matrix;
}

Matrix select_rows(const Matrix& matrix, std::span<const std::int32_t> new_index, std::int32_t count) {
  Matrix result = select(matrix, new_index, {});
  result.rows = count;
  result.columns = matrix.columns;
  return result;
}

Matrix select_columns(const Matrix& matrix, std::span<const std::int32_t> new_index, std::int32_t count) {
  Matrix result = select(matrix, {}, new_index);
  result.rows = matrix.rows;
  result.columns = count;
  return result;
}

Matrix select_rows_and_columns(const Matrix& matrix, std::span<const std::int32_t> new_index, std::int32_t count) {
  Matrix result = select(matrix, new_index, new_index);
  result.rows = result.columns = count;
  return result;
}

}  // namespace cli
