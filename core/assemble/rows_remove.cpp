#include "assemble/contacts.h"
#include "assemble/rows.h"
#include "assemble/validate.h"

namespace mlcp {

namespace {

constexpr std::int32_t removed = -1;

/// work.index: old row → new row, or removed. Returns the new number of rows.
std::int32_t number_rows(Problem& problem, std::int32_t count, const std::int32_t* rows) {
  Array<std::int32_t>& to = problem.work.index;
  to.assign(problem.m(), 0);
  for (std::int32_t e = 0; e < count; ++e) {
    if (rows[e] < 0 || rows[e] >= problem.m())
      throw Error(MLCP_ERROR_RANGE, "rows[%d] = %d is not one of %d rows", e, rows[e], problem.m());
    if (to[rows[e]] == removed) throw Error(MLCP_ERROR_ARGUMENT, "rows[%d] = %d is there twice", e, rows[e]);
    to[rows[e]] = removed;
  }
  std::int32_t next = 0;
  for (std::int32_t& row : to)
    if (row != removed) row = next++;
  return next;
}

template <class T>
void compact(Array<T>& a, const Array<std::int32_t>& to, std::int32_t left) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (to[i] != removed) a[to[i]] = a[i];
  a.resize(left);
}

/// Keeps the entries (i, j) of the compressed rows i that stay. renumber: columns are rows of the problem too.
void compact(SparseArrays& a, const Array<std::int32_t>& to, std::int32_t left, bool renumber) {
  std::int32_t next = 0, begin = 0;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const std::int32_t end = a.pointers[i + 1];
    for (std::int32_t e = begin; e < end; ++e) {
      const std::int32_t column = renumber ? to[a.indices[e]] : a.indices[e];
      if (to[i] == removed || column == removed) continue;
      a.indices[next] = column;
      a.values[next++] = a.values[e];
    }
    begin = end;
    if (to[i] != removed) a.pointers[to[i] + 1] = next;
  }
  a.pointers.resize(std::size_t(left) + 1);
  a.indices.resize(next);
  a.values.resize(next);
}

}  // namespace

void rows_remove(Problem& problem, std::int32_t count, const std::int32_t* rows) {
  check_count("count", count);
  check_array("rows", rows, count);
  const std::int32_t left = number_rows(problem, count, rows);
  const Array<std::int32_t>& to = problem.work.index;
  check_contacts_renumber(problem, to.span());
  contacts_renumber(problem, to.span());
  compact(problem.jacobian, to, left, false);
  compact(problem.compliance, to, left, true);
  for (Array<double>* a : {&problem.r, &problem.lo, &problem.hi}) compact(*a, to, left);
  compact(problem.key, to, left);
  problem.diagonal.resize(left);
  for (std::int32_t i = 0; i < left; ++i)
    for (std::int32_t p = problem.compliance.pointers[i]; p < problem.compliance.pointers[i + 1]; ++p)
      if (problem.compliance.indices[p] == i) problem.diagonal[i] = p;
}

}  // namespace mlcp
