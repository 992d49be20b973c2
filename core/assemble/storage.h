#pragma once
#include "assemble/problem.h"

namespace mlcp {

/// Room for that many in all, so that adding them allocates nothing. Entries of M are not asked for: room for dense bodies of the
/// mean dimension, at least 6, at most 64; larger ones, sparse masses and a compliance matrix may need more.
void reserve(Problem& problem, std::int32_t bodies, std::int32_t velocities, std::int32_t rows, std::int64_t entries);
/// Gives memory back. fails: bad_alloc, contents unchanged.
void trim(Problem& problem);
/// Back to empty, memory is kept.
void clear(Problem& problem);

}  // namespace mlcp
