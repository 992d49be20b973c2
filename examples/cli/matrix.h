#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cli {

/// A sparse matrix by entries, in any order, indices from 0. Explicit zeros are entries.
struct Matrix {
  std::string source;  // path, for messages
  std::int32_t rows = 0, columns = 0;
  bool symmetric = false;  // each entry off the diagonal stands for two; it may be in either triangle
  std::vector<std::int32_t> row, column;
  std::vector<double> value;
  std::vector<std::uint64_t> whole;  // of a file with integers: the values exactly, negative ones modulo 2⁶⁴

  void add(std::int32_t i, std::int32_t j, double a) {
    row.push_back(i);
    column.push_back(j);
    value.push_back(a);
  }
};

/// Compressed rows or columns.
struct Compressed {
  std::vector<std::int32_t> pointers, indices;
  std::vector<double> values;
};

/// Throws std::runtime_error if an entry comes twice; of a symmetric matrix also if once in each triangle.
Compressed compress_rows(const Matrix& matrix);
/// The same by columns; of a symmetric matrix the lower triangle only.
Compressed compress_columns(const Matrix& matrix);

/// The same matrix with both triangles as entries.
Matrix expand(Matrix matrix);

/// The rows (or columns, or both) i with new_index[i] ≥ 0, moved there. `count`: how many those are.
Matrix select_rows(const Matrix& matrix, std::span<const std::int32_t> new_index, std::int32_t count);
Matrix select_columns(const Matrix& matrix, std::span<const std::int32_t> new_index, std::int32_t count);
Matrix select_rows_and_columns(const Matrix& matrix, std::span<const std::int32_t> new_index, std::int32_t count);

}  // namespace cli
