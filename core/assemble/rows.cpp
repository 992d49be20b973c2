#include "assemble/rows.h"

#include "assemble/row_input.h"
#include "assemble/validate.h"

namespace mlcp {

namespace {

RowFields row_fields(const RowArrays& a) {
  return {numbers(a.r, 0), numbers(a.lo, 0), numbers(a.hi, infinity), numbers(a.compliance, 0),
          {a.key, std::ptrdiff_t(sizeof(std::uint64_t)), 0}};
}

/// Entries begin .. end − 1 of one row.
void check_columns(Problem& problem, const std::int32_t* columns, std::int32_t begin, std::int32_t end) {
  Marker& marker = problem.work.marker;
  marker.start(problem.n());
  for (std::int32_t e = begin; e < end; ++e) {
    if (columns[e] < 0 || columns[e] >= problem.n())
      throw Error(MLCP_ERROR_RANGE, "columns[%d] = %d is not one of %d velocities", e, columns[e], problem.n());
    if (!marker.insert(columns[e])) throw Error(MLCP_ERROR_ARGUMENT, "columns[%d] = %d is twice in its row", e, columns[e]);
  }
}

/// `count` rows with the entries row_pointers[0] .. row_pointers[count] − 1.  before: checked and reserved.
void append_entries(Problem& problem, std::int32_t count, const std::int32_t* row_pointers, const std::int32_t* columns, const double* values) {
  if (count == 0) return;  // there need be no arrays
  auto& [pointers, indices, numbers] = problem.jacobian;
  const std::int32_t before = pointers.back(), first = row_pointers[0], entries = row_pointers[count] - first;
  indices.append({columns + first, static_cast<std::size_t>(entries)});
  numbers.append({values + first, static_cast<std::size_t>(entries)});
  const std::size_t rows = pointers.size();
  pointers.resize(rows + count);
  for (std::int32_t i = 0; i < count; ++i) pointers[rows + i] = before + (row_pointers[i + 1] - first);
}

/// work.index: number of entries of every row.
void check_compressed_columns(Problem& problem, std::int32_t count, const std::int32_t* column_pointers,
                              const std::int32_t* row_indices) {
  EditWorkspace& work = problem.work;
  work.index.assign(count, 0);
  for (std::int32_t j = 0; j < problem.n(); ++j) {
    work.marker.start(count);
    for (std::int32_t e = column_pointers[j]; e < column_pointers[j + 1]; ++e) {
      const std::int32_t i = row_indices[e];
      if (i < 0 || i >= count) throw Error(MLCP_ERROR_RANGE, "row_indices[%d] = %d is not one of %d rows", e, i, count);
      if (!work.marker.insert(i)) throw Error(MLCP_ERROR_ARGUMENT, "row_indices[%d] = %d is twice in column %d", e, i, j);
      ++work.index[i];
    }
  }
}

}  // namespace

std::int32_t row_add(Problem& problem, std::int32_t count, const std::int32_t* columns, const double* values, double r,
                     double lo, double hi, double compliance, std::uint64_t key) {
  check_count("count", count);
  check_array("columns", columns, count);
  check_array("values", values, count);
  check_columns(problem, columns, 0, count);
  check_finite("values", values, count);
  const RowFields fields = row_fields({&r, &lo, &hi, &compliance, &key});
  check_fields(fields, 0, count > 0);
  reserve_rows(problem, 1, count);
  const std::int32_t first = problem.m();
  const std::int32_t row_pointers[] = {0, count};
  append_entries(problem, 1, row_pointers, columns, values);
  append_fields(problem, fields, 1);
  return first;
}

std::int32_t rows_add_csr(Problem& problem, std::int32_t count, const std::int32_t* row_pointers, const std::int32_t* columns,
                          const double* values, const RowArrays& arrays) {
  check_count("count", count);
  const std::int32_t entries = check_pointers("row_pointers", row_pointers, count);
  check_array("columns", columns, entries);
  check_array("values", values, entries);
  const RowFields fields = row_fields(arrays);
  for (std::int32_t i = 0; i < count; ++i) {
    check_columns(problem, columns, row_pointers[i], row_pointers[i + 1]);
    check_fields(fields, i, row_pointers[i + 1] > row_pointers[i]);
  }
  check_finite("values", values, entries);
  reserve_rows(problem, count, entries);
  const std::int32_t first = problem.m();
  append_entries(problem, count, row_pointers, columns, values);
  append_fields(problem, fields, count);
  return first;
}

std::int32_t rows_add_csc(Problem& problem, std::int32_t count, const std::int32_t* column_pointers,
                          const std::int32_t* row_indices, const double* values, const RowArrays& arrays) {
  check_count("count", count);
  const std::int32_t entries = check_pointers("column_pointers", column_pointers, problem.n());
  check_array("row_indices", row_indices, entries);
  check_array("values", values, entries);
  check_compressed_columns(problem, count, column_pointers, row_indices);
  check_finite("values", values, entries);
  const RowFields fields = row_fields(arrays);
  for (std::int32_t i = 0; i < count; ++i) check_fields(fields, i, problem.work.index[i] > 0);
  reserve_rows(problem, count, entries);

  const std::int32_t first = problem.m();
  auto& [pointers, indices, numbers] = problem.jacobian;
  Array<std::int32_t>& next = problem.work.index;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t begin = pointers.back();
    pointers.push_back(begin + next[i]);
    next[i] = begin;
  }
  indices.resize(pointers.back());
  numbers.resize(pointers.back());
  for (std::int32_t j = 0; j < problem.n(); ++j)
    for (std::int32_t e = column_pointers[j]; e < column_pointers[j + 1]; ++e) {
      const std::int32_t p = next[row_indices[e]]++;
      indices[p] = j;
      numbers[p] = values[e];
    }
  append_fields(problem, fields, count);
  return first;
}

void rows_clear(Problem& problem) {
  for (SparseArrays* a : {&problem.jacobian, &problem.compliance}) {
    a->pointers.resize(1);
    a->indices.clear();
    a->values.clear();
  }
  problem.diagonal.clear();
  for (Array<double>* a : {&problem.r, &problem.lo, &problem.hi}) a->clear();
  problem.key.clear();
  problem.contacts.clear();
  problem.couplings.clear();
}

}  // namespace mlcp
