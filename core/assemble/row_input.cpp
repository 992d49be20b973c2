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
  const std::int32_t m = problem.m();
  const auto position = static_cast<std::int32_t>(problem.compliance.values.size());
  auto& [pointers, indices, values] = problem.compliance;
  for (Array<double>* a : {&problem.r, &problem.lo, &problem.hi}) a->resize(m + count);
  problem.key.resize(m + count);
  problem.diagonal.resize(m + count);
  pointers.resize(m + count + 1);
  indices.resize(position + count);
  values.resize(position + count);
  for (std::int32_t i = 0; i < count; ++i) {
    problem.diagonal[m + i] = position + i;
    indices[position + i] = m + i;
    pointers[m + i + 1] = position + i + 1;
  }
  const auto take = [&](const auto& field, auto* to) {
    for (std::int32_t i = 0; i < count; ++i) to[i] = field[i];
  };
  take(fields.compliance, values.data() + position);
  take(fields.r, problem.r.data() + m);
  take(fields.lo, problem.lo.data() + m);
  take(fields.hi, problem.hi.data() + m);
  take(fields.key, problem.key.data() + m);
}

}  // namespace mlcp
