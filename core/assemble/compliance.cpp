#include "assemble/compliance.h"

#include <algorithm>

#include "assemble/validate.h"

namespace mlcp {

void set_compliance_matrix(Problem& problem, const SymmetricInput& matrix) {
  check_length("count", matrix.size, problem.m());
  EditWorkspace& work = problem.work;
  if (has_values_of(problem.compliance_view(), matrix, work.index)) {
    std::copy_n(matrix.values, problem.compliance.values.size(), problem.compliance.values.data());
    return;
  }
  expand(matrix, work);
  sort_with_diagonal(matrix.size, work);
  const std::int32_t* pointers = problem.jacobian.pointers.data();
  for (std::int32_t i = 0; i < problem.m(); ++i) {
    const double value = work.sorted.values[work.index[i]];
    if (value < 0 && pointers[i + 1] > pointers[i])
      throw Error(MLCP_ERROR_ARGUMENT, "values: diagonal entry %d = %.17g is negative", i, value);
  }
  problem.compliance.pointers.swap(work.sorted.pointers);
  problem.compliance.indices.swap(work.sorted.indices);
  problem.compliance.values.swap(work.sorted.values);
  problem.diagonal.swap(work.index);
}

}  // namespace mlcp
