// A consumer in C++ gets mlcp.h and nothing else from the package.
#if __has_include(<Eigen/Core>)
#error "the package leads to Eigen"
#endif
#include <mlcp.h>

#include <cstdint>
#include <cstdio>
#include <memory>

int main() {
  const double mass[4] = {2, 0, 0, 0.1};
  const double momentum[2] = {-0.1962, 0};
  const double corners[4] = {1, -0.2, 1, 0.2};
  mlcp_problem* made = nullptr;
  mlcp_solver* solver_made = nullptr;
  if (mlcp_problem_create(nullptr, &made) || mlcp_solver_create(nullptr, nullptr, &solver_made)) return 1;
  const std::unique_ptr<mlcp_problem, decltype(&mlcp_problem_destroy)> problem(made, mlcp_problem_destroy);
  const std::unique_ptr<mlcp_solver, decltype(&mlcp_solver_destroy)> solver(solver_made, mlcp_solver_destroy);

  std::int32_t body = 0;
  if (mlcp_problem_bodies_add(problem.get(), 1, 2, mass, 0, &body)) return 1;
  if (mlcp_problem_set_momentum(problem.get(), 0, 2, momentum)) return 1;
  const std::int32_t bodies[2] = {body, body};
  mlcp_rows rows;
  mlcp_rows_init(&rows, sizeof rows);
  rows.count = 2;
  rows.body_a = bodies;
  rows.jacobian_a = corners;
  if (mlcp_problem_rows_add(problem.get(), &rows, nullptr)) return 1;

  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  const double* impulses = nullptr;
  std::int32_t count = 0;
  if (mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, &report)) return 1;
  if (mlcp_solver_impulses(solver.get(), &impulses, &count) || count != 2) return 1;
  std::printf("%s: %.4f and %.4f N.s\n", mlcp_outcome_text(report.outcome), impulses[0], impulses[1]);
}
