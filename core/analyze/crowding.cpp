#include "analyze/crowding.h"

#include <algorithm>

#include "analyze/union_find.h"

namespace mlcp {

namespace {

/// Below so many rows the dense triangle of the rows costs nothing, and every method runs in one order.
constexpr std::int32_t fewest_rows = 20;

}  // namespace

bool too_many(std::int64_t rows, std::int64_t velocities) { return velocities > 0 && rows >= fewest_rows && 2 * rows > 3 * velocities; }

void Crowding::find(const Problem& problem, const Selection& selection, bool exact) {
  const std::int32_t n = problem.n(), m = problem.m();
  crowded.assign(n + m, 0);
  any_ = false;
  if (exact || n == 0) return;
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  start_sets(parent_, n + m);
  for (std::int32_t j = 0; j < n; ++j)
    if (selection.velocity[j])
      for (std::int32_t t = mass.pointers[j]; t < mass.pointers[j + 1]; ++t) join(parent_, j, mass.indices[t]);
  for (std::int32_t i = 0; i < m; ++i) {
    if (!selection.row[i]) continue;
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t)
      if (selection.velocity[jacobian.indices[t]]) join(parent_, n + i, jacobian.indices[t]);
    for (std::int32_t t = sigma.pointers[i]; t < sigma.pointers[i + 1]; ++t)
      if (selection.row[sigma.indices[t]]) join(parent_, n + i, n + sigma.indices[t]);
  }
  velocities_.assign(n + m, 0);
  rows_.assign(n + m, 0);
  for (std::int32_t node = 0; node < n + m; ++node)
    if (selection.has(node)) ++(node < n ? velocities_ : rows_)[root_of(parent_, node)];
  for (std::int32_t node = 0; node < n + m; ++node) {
    const std::int32_t root = root_of(parent_, node);
    crowded[node] = selection.has(node) && too_many(rows_[root], velocities_[root]);
    any_ |= crowded[node] != 0;
  }
}

}  // namespace mlcp
