#pragma once
#include "assemble/problem.h"

/// Rows come and go. Every call: checks, then room, then changes; fails with Error or bad_alloc, nothing changed. Those that add
/// return the index of the first new row.
namespace mlcp {

/// Rows between bodies; struct_size has been looked at.
std::int32_t rows_add(Problem& problem, const mlcp_rows& rows);
std::int32_t rows_add(Problem& problem, const mlcp_rows_f32& rows);

/// cost: O(count).
std::int32_t row_add(Problem& problem, std::int32_t count, const std::int32_t* columns, const double* values, double r,
                     double lo, double hi, double compliance, std::uint64_t key);

/// NULL: 0, 0, +inf, 0, none.
struct RowArrays {
  const double *r, *lo, *hi, *compliance;
  const std::uint64_t* key;
};
std::int32_t rows_add_csr(Problem& problem, std::int32_t count, const std::int32_t* row_pointers, const std::int32_t* columns,
                          const double* values, const RowArrays& arrays);
std::int32_t rows_add_csc(Problem& problem, std::int32_t count, const std::int32_t* column_pointers,
                          const std::int32_t* row_indices, const double* values, const RowArrays& arrays);

/// cost: O(m + entries).
void rows_remove(Problem& problem, std::int32_t count, const std::int32_t* rows);
/// cost: O(1).
void rows_clear(Problem& problem);

}  // namespace mlcp
