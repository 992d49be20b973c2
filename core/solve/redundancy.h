#pragma once
#include "solve/basis.h"

namespace mlcp {

/// Marks the rows that hold (|w| ≤ 1e-9 of its scale) although they are not in the factor, because they depend on active rows: Schur pivot
/// at most dependent_pivot · a.  redundant: the caller's rows.
/// cost: one forward solve for each row that holds and rests.
void mark_redundant(const Island& island, Basis& basis, std::int32_t n, std::uint8_t* redundant, Counts& counts);

}  // namespace mlcp
