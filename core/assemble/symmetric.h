#pragma once
#include "assemble/problem.h"

namespace mlcp {

/// A symmetric matrix as callers hand it in: size × size, compressed columns in any order, both triangles or one.
struct SymmetricInput {
  std::int32_t size;
  const std::int32_t* column_pointers;
  const std::int32_t* row_indices;
  const double* values;
  mlcp_triangle triangle;
};

/// Whether every column has its diagonal entry and nothing else.  false: or something is wrong with the arrays.
/// cost: O(size), as vectors.
bool is_diagonal(const SymmetricInput& input);

/// Both triangles, in work.expanded: the caller's entries in the caller's order within a column, then the mirrors that are
/// missing. work.slot as Problem::mass_slot. work.value: the diagonal; empty if nothing negative is known to be in it.
/// cost:  O(entries).      fails: Error, bad_alloc; nothing but the workspace has changed.
void expand(const SymmetricInput& input, EditWorkspace& work);

/// Where the values of an expanded matrix go. pointers: of its columns, all plus the first; indices: of its rows, all plus `base`.
struct SymmetricPattern {
  std::int32_t size;
  const std::int32_t* pointers;
  const std::int32_t* indices;
  std::int32_t base;
  const std::int32_t* slot;
  std::int64_t count;  ///< of the caller's values
  mlcp_triangle triangle;
};

/// Whether the caller's values are the expanded ones as they stand, which most callers hand in: finite, columns ascending,
/// the two triangles equal, nothing negative on the diagonal.  before: there are as many of both, so that each has its place.
/// cost: a step for every other entry, which is all that a new mass has to pay beside the copy.
bool mirrored(const SymmetricPattern& pattern, const double* values);

/// Whether a matrix has the pattern of an earlier one, with sorted columns and every diagonal entry there, and values that may take the place of its values as
/// they stand, as in mirrored().
/// cost: a step for every other entry.
bool has_values_of(const SparseView& pattern, const SymmetricInput& matrix, Array<std::int32_t>& scratch);

/// out: the expanded values, the two triangles made equal.      diagonal: size doubles; whatever is negative there is found in them.
/// fails: Error on the argument `name`, when they differ by more than rounding or one of them is missing and not 0.
void expand_values(const char* name, const SymmetricPattern& pattern, const double* values, double* diagonal,
                   std::span<double> out);

/// The expanded matrix with rows sorted and every diagonal entry there, in work.sorted; diagonal positions in work.index.
/// A symmetric matrix is its own transpose, and transposing sorts.
void sort_with_diagonal(std::int32_t size, EditWorkspace& work);

}  // namespace mlcp
