#include "assemble/row_input.h"

#include "assemble/validate.h"

namespace mlcp {

void check_fields(const RowFields& fields, std::int64_t i, bool has_entries) {
  const double r = fields.r[i];
  if (!std::isfinite(r)) throw Error(MLCP_ERROR_ARGUMENT, "r[%lld] = %g is not finite", static_cast<long long>(i), r);
  check_bounds(fields.lo[i], fields.hi[i], i);
  check_compliance(fields.compliance[i], has_entries, i);
}

void reserve_rows(Problem& problem, std::int64_t rows, std::int64_t entries) {
  const std::int64_t m = problem.m() + rows;
  check_index_space(problem.n(), m);
  check_entries("J", std::int64_t(problem.jacobian.values.size()) + entries);
  check_entries("the compliance", std::int64_t(problem.compliance.values.size()) + rows);
  problem.r.reserve(m);
  problem.lo.reserve(m);
  problem.hi.reserve(m);
  problem.key.reserve(m);
  problem.diagonal.reserve(m);
  problem.compliance.pointers.reserve(m + 1);
  problem.compliance.indices.reserve(problem.compliance.indices.size() + rows);
  problem.compliance.values.reserve(problem.compliance.values.size() + rows);
  problem.jacobian.pointers.reserve(m + 1);
  problem.jacobian.indices.reserve(problem.jacobian.indices.size() + entries);
  problem.jacobian.values.reserve(problem.jacobian.values.size() + entries);
}

void append_fields(Problem& problem, const RowFields& fields, std::int32_t count) {
  for (std::int32_t i = 0; i < count; ++i) {
    const auto position = static_cast<std::int32_t>(problem.compliance.values.size());
    problem.diagonal.push_back(position);
    problem.compliance.indices.push_back(problem.m());
    problem.compliance.values.push_back(fields.compliance[i]);
    problem.compliance.pointers.push_back(position + 1);
    problem.lo.push_back(fields.lo[i]);
    problem.hi.push_back(fields.hi[i]);
    problem.key.push_back(fields.key[i]);
    problem.r.push_back(fields.r[i]);
  }
}

}  // namespace mlcp
