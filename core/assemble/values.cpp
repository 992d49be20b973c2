#include "assemble/values.h"

#include "assemble/validate.h"

namespace mlcp {

void rows_set_r(Problem& problem, std::int32_t first, std::int32_t count, const double* r) {
  check_range(first, count, problem.m());
  check_array("r", r, count);
  check_finite("r", r, count);
  std::copy_n(r, count, problem.r.data() + first);
}

void rows_set_bounds(Problem& problem, std::int32_t first, std::int32_t count, const double* lo, const double* hi) {
  check_range(first, count, problem.m());
  check_array("lo", lo, count);
  check_array("hi", hi, count);
  for (std::int32_t i = 0; i < count; ++i) check_bounds(lo[i], hi[i], i);
  std::copy_n(lo, count, problem.lo.data() + first);
  std::copy_n(hi, count, problem.hi.data() + first);
}

void rows_set_compliance(Problem& problem, std::int32_t first, std::int32_t count, const double* compliance) {
  check_range(first, count, problem.m());
  check_array("compliance", compliance, count);
  const std::int32_t* pointers = problem.jacobian.pointers.data() + first;
  for (std::int32_t i = 0; i < count; ++i) check_compliance(compliance[i], pointers[i + 1] > pointers[i], i);
  for (std::int32_t i = 0; i < count; ++i) problem.compliance.values[problem.diagonal[first + i]] = compliance[i];
}

void rows_set_keys(Problem& problem, std::int32_t first, std::int32_t count, const std::uint64_t* keys) {
  check_range(first, count, problem.m());
  check_array("keys", keys, count);
  std::copy_n(keys, count, problem.key.data() + first);
}

void row_set_jacobian(Problem& problem, std::int32_t row, const double* values, std::int32_t count) {
  if (row < 0 || row >= problem.m()) throw Error(MLCP_ERROR_RANGE, "row = %d is not one of %d rows", row, problem.m());
  const std::int32_t begin = problem.jacobian.pointers[row];
  check_length("count", count, problem.jacobian.pointers[row + 1] - begin);
  check_array("values", values, count);
  check_finite("values", values, count);
  std::copy_n(values, count, problem.jacobian.values.data() + begin);
}

}  // namespace mlcp
