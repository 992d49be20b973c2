#include "candidate_rows.h"

#include <algorithm>
#include <vector>

#include "clock.h"
#include "scene_problem.h"

namespace bench {
namespace {

using handles::check;

double solve_once(const mlcp_problem* problem, const mlcp_mask* enabled, handles::Solver& solver, bool known,
                  const mlcp_settings& settings) {
  if (!known) solver = handles::make_solver(&settings);
  const double start = wall_seconds();
  check(mlcp_solve(solver.get(), problem, enabled, nullptr, nullptr), solver);
  return wall_seconds() - start;
}

double median(std::vector<double>& values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

CandidateRows candidate_rows(const mlcp_problem* problem, std::int32_t stride, bool known, const mlcp_settings& settings, int turns) {
  const std::int32_t m = mlcp_problem_row_count(problem);
  const handles::Mask enabled = handles::make_mask(m, MLCP_ROW_DISABLED);
  const mlcp_row_state in = MLCP_ROW_AT_LOWER;
  for (std::int32_t i = 0; i < m; i += stride) check(mlcp_mask_set(enabled.get(), i, 1, &in), enabled);
  const handles::Problem part = every_row(problem, stride);

  handles::Solver with_mask = handles::make_solver(&settings), without = handles::make_solver(&settings);
  std::vector<double> masked, alone;
  for (int turn = 0; turn <= turns; ++turn) {
    masked.push_back(solve_once(problem, enabled.get(), with_mask, known, settings));
    alone.push_back(solve_once(part.get(), nullptr, without, known, settings));
    if (turn == 0) {  // the first one analyzes
      masked.clear();
      alone.clear();
    }
  }
  return {median(masked), median(alone)};
}

}  // namespace bench
