#include "swap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

Swap::Swap(const mlcp_settings* settings) : solver_(handles::make_solver(settings)) { mlcp_report_init(&report_, sizeof report_); }

bool Swap::solve(int n, const double* A, double* x, const double* b, double* w, int nub, const double* lo, const double* hi,
                 const int* findex) {
  const std::ptrdiff_t stride = n > 1 ? (n + 3) / 4 * 4 : n;
  const auto size = static_cast<std::size_t>(n);
  std::vector<std::int32_t> pointers(size + 1, 0), indices;
  std::vector<double> values;
  std::vector<double> low(lo, lo + n), high(hi, hi + n);
  std::fill_n(low.begin(), nub, -INFINITY);
  std::fill_n(high.begin(), nub, INFINITY);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (A[i * stride + j] == 0) continue;
      indices.push_back(j);
      values.push_back(A[i * stride + j]);
    }
    pointers[static_cast<std::size_t>(i) + 1] = static_cast<std::int32_t>(indices.size());
    if (!findex || findex[i] < 0) continue;
    high[static_cast<std::size_t>(i)] = std::abs(hi[i]);  // dSolveLCP looks at hi alone
    low[static_cast<std::size_t>(i)] = -std::abs(hi[i]);
  }
  // the reduced problem of mlcp.h: no bodies, rows without entries, S = A, r = b
  const std::vector<std::int32_t> empty(size + 1, 0);
  mlcp_problem* problem = problem_.get();
  handles::check(mlcp_problem_clear(problem), problem_);
  handles::check(mlcp_problem_rows_add_csr(problem, n, empty.data(), nullptr, nullptr, b, low.data(), high.data(), nullptr, nullptr, nullptr),
                 problem_);
  handles::check(mlcp_problem_set_compliance_matrix(problem, n, pointers.data(), indices.data(), values.data(), MLCP_FULL), problem_);
  if (findex) handles::check(mlcp_problem_rows_set_findex(problem, 0, n, findex), problem_);
  handles::check(mlcp_solve(solver_.get(), problem, nullptr, nullptr, &report_), solver_);

  const double *impulses = nullptr, *slacks = nullptr;
  std::int32_t count = 0;
  handles::check(mlcp_solver_impulses(solver_.get(), &impulses, &count));
  handles::check(mlcp_solver_slacks(solver_.get(), &slacks, &count));
  std::copy_n(impulses, count, x);
  std::copy_n(slacks, count, w);
  return report_.outcome == MLCP_SOLVED;
}
