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
  for (const Coupling& c : problem.couplings) {
    const std::int32_t i = c.row - first;
    if (i >= 0 && i < count && !(std::isfinite(lo[i]) && std::isfinite(hi[i]) && lo[i] <= 0 && hi[i] >= 0))
      throw Error(MLCP_ERROR_ARGUMENT, "lo[%d] = %g and hi[%d] = %g are not finite factors with 0 between them, but row %d follows row %d", i,
                  lo[i], i, hi[i], c.row, c.normal);
  }
  for (const Contact& c : problem.contacts) {
    const std::int32_t i = c.row - first;
    if (i >= 0 && i < count && (lo[i] != 0 || hi[i] != infinity))
      throw Error(MLCP_ERROR_ARGUMENT, "lo[%d] = %g and hi[%d] = %g, but row %d is the normal of a contact: 0 and infinity", i, lo[i], i, hi[i],
                  c.row);
  }
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
