#include "assemble/symmetric.h"

#include <bit>
#include <cstring>
#include <limits>

#include "assemble/validate.h"

namespace mlcp {

namespace {

constexpr std::int32_t none = -1;

/// The arrays are there and as long as they have to be, their values finite. Returns the number of entries.
std::int32_t check_arrays(const SymmetricInput& a) {
  if (a.triangle < MLCP_FULL || a.triangle > MLCP_UPPER)
    throw Error(MLCP_ERROR_ARGUMENT, "triangle = %d is unknown", a.triangle);
  const std::int32_t entries = check_pointers("column_pointers", a.column_pointers, a.size);
  check_array("row_indices", a.row_indices, entries);
  check_array("values", a.values, entries);
  check_entries("the matrix", 2 * std::int64_t(entries) + a.size);
  return entries;
}

/// Indices in range, none twice in a column, only in the triangle that was announced.
void check_indices(const SymmetricInput& a, Marker& marker) {
  for (std::int32_t j = 0; j < a.size; ++j) {
    marker.start(a.size);
    for (std::int32_t e = a.column_pointers[j]; e < a.column_pointers[j + 1]; ++e) {
      const std::int32_t i = a.row_indices[e];
      if (i < 0 || i >= a.size) throw Error(MLCP_ERROR_RANGE, "row_indices[%d] = %d is not in 0 .. %d", e, i, a.size - 1);
      if ((a.triangle == MLCP_LOWER && i < j) || (a.triangle == MLCP_UPPER && i > j))
        throw Error(MLCP_ERROR_ARGUMENT, "row_indices[%d] = %d in column %d is not in the %s triangle", e, i, j,
                    a.triangle == MLCP_LOWER ? "lower" : "upper");
      if (!marker.insert(i)) throw Error(MLCP_ERROR_ARGUMENT, "row_indices[%d] = %d is twice in column %d", e, i, j);
    }
  }
}

/// Differences of pairs, collected by |: a sum would wait for the one before. Those of finite, equal pairs are 0 or −0.
std::uint64_t difference(double a, double b) { return std::bit_cast<std::uint64_t>(a - b); }
bool equal(std::uint64_t differences) { return differences << 1 == 0; }

/// What most callers hand in: both triangles, every column ascending. Then the mirrors of column j are met in the order in which the other columns
/// have them, and pattern and slots are those of the input.  false: it is not so, or something is wrong with it.
/// after true: as place(); exact: the values are those of a symmetric matrix, finite and not negative on the diagonal.       cost: 1 step an entry
bool take_sorted(const SymmetricInput& a, std::int32_t entries, EditWorkspace& work, bool& exact) {
  if (a.triangle != MLCP_FULL || a.size == 0) return false;  // of a size of 0, column_pointers may be null
  const std::int32_t *start = a.column_pointers, *rows = a.row_indices;
  std::int32_t* slot = work.slot.data();
  work.index.resize(a.size);
  std::int32_t* const next = work.index.data();  // of each column: its first entry whose mirror was not met
  std::copy(start, start + a.size, next);
  std::uint64_t off = 0;
  bool positive = true;
  for (std::int32_t j = 0; j < a.size; ++j) {
    std::int32_t before = j - 1;
    for (std::int32_t e = next[j], end = start[j + 1]; e < end; ++e) {
      const std::int32_t i = rows[e];
      if (i <= before || i >= a.size) return false;
      before = i;
      slot[2 * e] = e;
      if (i == j) {
        slot[2 * e + 1] = e;
        positive &= (a.values[e] >= 0) & (a.values[e] < infinity);
        continue;
      }
      const std::int32_t mirror = next[i]++;
      if (mirror >= start[i + 1] || rows[mirror] != j) return false;
      slot[2 * e + 1] = mirror;
      slot[2 * mirror] = mirror;
      slot[2 * mirror + 1] = e;
      off |= difference(a.values[e], a.values[mirror]);
    }
  }
  exact = positive && equal(off);
  work.expanded.pointers.assign({start, std::size_t(a.size) + 1});
  work.expanded.indices.assign({rows, std::size_t(entries)});
  work.expanded.values.resize(entries);
  return true;
}

/// slot[2e + 1]: the caller's entry (j, i) for his entry e at (i, j); none where there is none.
/// entries by row, against the positions of the column with the same number.
void find_mirrors(const SymmetricInput& a, std::int32_t entries, Marker& marker, Array<std::int32_t>& scratch,
                  std::int32_t* slot) {
  const std::size_t size = a.size;
  scratch.assign(2 * size + 1 + 2 * std::size_t(entries), 0);
  std::int32_t *row_start = scratch.data(), *position = row_start + size + 1;
  std::int32_t *by_row = position + size, *column = by_row + entries;
  for (std::int32_t e = 0; e < entries; ++e) ++row_start[a.row_indices[e] + 1];
  for (std::size_t i = 0; i < size; ++i) row_start[i + 1] += row_start[i];
  for (std::size_t i = 0; i < size; ++i) position[i] = row_start[i];
  for (std::int32_t j = 0; j < a.size; ++j)
    for (std::int32_t e = a.column_pointers[j]; e < a.column_pointers[j + 1]; ++e) {
      const std::int32_t p = position[a.row_indices[e]]++;
      by_row[p] = e;
      column[p] = j;
    }
  for (std::int32_t j = 0; j < a.size; ++j) {
    marker.start(size);
    for (std::int32_t e = a.column_pointers[j]; e < a.column_pointers[j + 1]; ++e) {
      marker.insert(a.row_indices[e]);
      position[a.row_indices[e]] = e;
    }
    for (std::int32_t p = row_start[j]; p < row_start[j + 1]; ++p)
      slot[2 * by_row[p] + 1] = marker.contains(column[p]) ? position[column[p]] : none;
  }
}

/// before: slot[2e + 1] is the caller's mirror of e, or none.     after: pattern and slots of both triangles.
void place(const SymmetricInput& a, EditWorkspace& work) {
  auto& [pointers, indices, values] = work.expanded;
  std::int32_t* slot = work.slot.data();
  pointers.assign(std::size_t(a.size) + 1, 0);
  work.index.resize(a.size);
  for (std::int32_t j = 0; j < a.size; ++j)
    for (std::int32_t e = a.column_pointers[j]; e < a.column_pointers[j + 1]; ++e) {
      ++pointers[j + 1];
      if (slot[2 * e + 1] == none) ++pointers[a.row_indices[e] + 1];
    }
  for (std::int32_t j = 0; j < a.size; ++j) pointers[j + 1] += pointers[j];
  indices.resize(pointers[a.size]);
  values.resize(pointers[a.size]);
  for (std::int32_t j = 0; j < a.size; ++j) {
    std::int32_t next = pointers[j];
    for (std::int32_t e = a.column_pointers[j]; e < a.column_pointers[j + 1]; ++e) {
      indices[next] = a.row_indices[e];
      slot[2 * e] = next++;
    }
    work.index[j] = next;
  }
  for (std::int32_t j = 0; j < a.size; ++j)
    for (std::int32_t e = a.column_pointers[j]; e < a.column_pointers[j + 1]; ++e) {
      if (slot[2 * e + 1] == none) {
        const std::int32_t p = work.index[a.row_indices[e]]++;
        indices[p] = j;
        slot[2 * e + 1] = p;
      } else {
        slot[2 * e + 1] = slot[2 * slot[2 * e + 1]];
      }
    }
}

}  // namespace

bool is_diagonal(const SymmetricInput& a) {
  if (a.triangle < MLCP_FULL || a.triangle > MLCP_UPPER || a.size == 0 || !a.column_pointers || !a.row_indices || !a.values) return false;
  if (a.column_pointers[a.size] != a.size) return false;
  std::int32_t off = 0;
  for (std::int32_t j = 0; j < a.size; ++j) off |= a.column_pointers[j] ^ j;
  if (off) return false;
  for (std::int32_t j = 0; j < a.size; ++j) off |= a.row_indices[j] ^ j;
  return off == 0;
}

void expand(const SymmetricInput& input, EditWorkspace& work) {
  const std::int32_t entries = check_arrays(input);
  work.slot.resize(2 * std::size_t(entries));
  bool exact = false;
  if (!take_sorted(input, entries, work, exact)) {
    check_indices(input, work.marker);
    if (input.triangle == MLCP_FULL) {
      find_mirrors(input, entries, work.marker, work.index, work.slot.data());
    } else {
      for (std::int32_t j = 0; j < input.size; ++j)
        for (std::int32_t e = input.column_pointers[j]; e < input.column_pointers[j + 1]; ++e)
          work.slot[2 * e + 1] = input.row_indices[e] == j ? e : none;
    }
    place(input, work);
  }
  const SymmetricPattern pattern{input.size, work.expanded.pointers.data(), work.expanded.indices.data(), 0, work.slot.data(), entries, input.triangle};
  work.value.clear();
  if (exact || (static_cast<std::int64_t>(work.expanded.values.size()) == entries && mirrored(pattern, input.values))) {
    std::copy_n(input.values, entries, work.expanded.values.begin());
    return;
  }
  check_finite("values", input.values, entries);
  work.value.resize(input.size);
  expand_values("values", pattern, input.values, work.value.data(), work.expanded.values.span());
}

bool mirrored(const SymmetricPattern& a, const double* values) {
  if (a.triangle != MLCP_FULL) return false;
  std::int64_t paired = 0;
  for (std::int32_t j = 0; j < a.size; ++j) {
    const std::int32_t begin = a.pointers[j] - a.pointers[0], end = a.pointers[j + 1] - a.pointers[0];
    std::int32_t e = begin, mirror = begin;
    std::uint64_t off = 0;
    for (; e < end && (mirror = a.slot[2 * e + 1]) < e; ++e) off |= difference(values[e], values[mirror]);
    if (!equal(off)) return false;
    paired += 2 * (e - begin);
    if (e == end || mirror > e) continue;
    if (!(values[e] >= 0 && values[e] < infinity)) return false;
    ++paired;
  }
  return paired == a.count;
}

bool has_values_of(const SparseView& pattern, const SymmetricInput& a, Array<std::int32_t>& scratch) {
  if (a.triangle != MLCP_FULL || a.size != pattern.outer || a.size == 0 || !a.column_pointers || !a.row_indices || !a.values) return false;
  const std::int32_t *start = pattern.pointers, *rows = pattern.indices;
  const std::size_t entries = start[a.size];
  if (std::memcmp(a.column_pointers, start, (std::size_t(a.size) + 1) * sizeof *start) != 0) return false;
  if (std::memcmp(a.row_indices, rows, entries * sizeof *rows) != 0) return false;
  scratch.assign({start, std::size_t(a.size)});
  std::int32_t* const next = scratch.data();  // of each column: its first entry whose mirror was not met
  std::uint64_t off = 0;
  bool positive = true;
  for (std::int32_t j = 0; j < a.size; ++j) {
    std::int32_t e = next[j];
    positive &= (a.values[e] >= 0) & (a.values[e] < infinity);
    for (const std::int32_t end = start[j + 1]; ++e < end;) off |= difference(a.values[e], a.values[next[rows[e]]++]);
  }
  return positive && equal(off);
}

void expand_values(const char* name, const SymmetricPattern& a, const double* values, double* diagonal,
                   std::span<double> out) {
  std::fill(diagonal, diagonal + a.size, 0.0);
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();  // the caller's own values are finite
  if (static_cast<std::int64_t>(out.size()) > a.count) std::fill(out.begin(), out.end(), missing);
  for (std::int64_t e = 0; e < a.count; ++e) {
    const std::int32_t p = a.slot[2 * e], q = a.slot[2 * e + 1];
    out[p] = values[e];
    if (a.triangle != MLCP_FULL) out[q] = values[e];
    if (p == q) diagonal[a.indices[p] - a.base] = values[e];
  }
  if (a.triangle != MLCP_FULL) return;
  for (std::int64_t e = 0; e < a.count; ++e) {
    const std::int32_t p = a.slot[2 * e], q = a.slot[2 * e + 1];
    if (out[p] == out[q]) continue;
    const std::int32_t i = a.indices[p] - a.base, j = a.indices[q] - a.base;
    const bool alone = std::isnan(out[q]);
    if (alone) out[q] = 0;
    if ((alone && out[p] != 0) || !nearly_symmetric(out[p], out[q], diagonal[i], diagonal[j]))
      throw Error(MLCP_ERROR_ARGUMENT, "%s[%lld] is not symmetric: entry (%d, %d) = %.17g, entry (%d, %d) = %.17g", name,
                  static_cast<long long>(e), i, j, out[p], j, i, out[q]);
    out[p] = out[q] = middle(out[p], out[q]);
  }
}

/// Where the columns ascend and have their diagonals, as those of take_sorted do: columns of a symmetric matrix are its rows.
/// after true: as sort_with_diagonal().
bool take_columns_as_rows(std::int32_t size, EditWorkspace& work) {
  const auto& [from, rows, numbers] = work.expanded;
  work.index.resize(size);
  for (std::int32_t j = 0; j < size; ++j) {
    std::int32_t diagonal = none;
    for (std::int32_t p = from[j]; p < from[j + 1]; ++p) {
      if (p > from[j] && rows[p] < rows[p - 1]) return false;
      if (rows[p] == j) diagonal = p;
    }
    if (diagonal == none) return false;
    work.index[j] = diagonal;
  }
  work.sorted.pointers.swap(work.expanded.pointers);
  work.sorted.indices.swap(work.expanded.indices);
  work.sorted.values.swap(work.expanded.values);
  return true;
}

void sort_with_diagonal(std::int32_t size, EditWorkspace& work) {
  if (take_columns_as_rows(size, work)) return;
  const auto& [from, rows, numbers] = work.expanded;
  auto& [pointers, indices, values] = work.sorted;
  Array<std::int32_t>& position = work.index;
  pointers.assign(std::size_t(size) + 1, 0);
  position.resize(size);
  std::int32_t* next = position.data();
  work.slot.assign(size, 0);
  std::int32_t* has_diagonal = work.slot.data();
  for (std::int32_t j = 0; j < size; ++j)
    for (std::int32_t p = from[j]; p < from[j + 1]; ++p) {
      ++pointers[rows[p] + 1];
      has_diagonal[j] |= rows[p] == j;
    }
  for (std::int32_t j = 0; j < size; ++j) {
    pointers[j + 1] += pointers[j] + !has_diagonal[j];
    next[j] = pointers[j];
  }
  indices.resize(pointers[size]);
  values.resize(pointers[size]);
  const auto put = [next, &column = indices, &number = values](std::int32_t i, std::int32_t j, double value) {
    column[next[i]] = j;
    number[next[i]++] = value;
  };
  for (std::int32_t j = 0; j < size; ++j) {
    for (std::int32_t p = from[j]; p < from[j + 1]; ++p) put(rows[p], j, numbers[p]);
    if (!has_diagonal[j]) put(j, j, 0.0);
  }
  for (std::int32_t j = 0; j < size; ++j)
    for (std::int32_t p = pointers[j]; p < pointers[j + 1]; ++p)
      if (indices[p] == j) position[j] = p;
}

}  // namespace mlcp
