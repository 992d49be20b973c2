#pragma once
#include "solve/basis.h"

namespace mlcp {

/// Marks the rows that hold (|w| ≤ 1e-9 of its scale) and depend on active ones: those that rest with a Schur pivot of at most dependent_pivot · a,
/// and, in a factor with ε, active rows whose pivot is hardly more than ε a. In crowded islands the pivots do not tell: there a row is
/// dependent when the others explain it, which is not looked for row by row.  redundant: the caller's rows.
/// returns whether impulses may not be unique: a row that rests holds, an active one is marked, or the island is crowded.
/// cost: one forward solve for each row that holds and rests.
bool mark_redundant(const Island& island, Basis& basis, double epsilon, std::int32_t n, std::uint8_t* redundant, Counts& counts);

}  // namespace mlcp
