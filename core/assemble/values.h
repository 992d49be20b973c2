#pragma once
#include "assemble/problem.h"

/// New values in place: the pattern stays. Rows first .. first + count − 1.
namespace mlcp {

void rows_set_r(Problem& problem, std::int32_t first, std::int32_t count, const double* r);
void rows_set_bounds(Problem& problem, std::int32_t first, std::int32_t count, const double* lo, const double* hi);
void rows_set_compliance(Problem& problem, std::int32_t first, std::int32_t count, const double* compliance);
void rows_set_keys(Problem& problem, std::int32_t first, std::int32_t count, const std::uint64_t* keys);
/// The row's entries in the order of adding.
void row_set_jacobian(Problem& problem, std::int32_t row, const double* values, std::int32_t count);

}  // namespace mlcp
