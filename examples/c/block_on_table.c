/* A block rests on a table with two corners: which impulses carry it through a step of 10 ms? */
#include <mlcp.h>
#include <stdio.h>

int main(void) {
  const double h = 0.01, mass = 2.0, inertia = 0.1, half_width = 0.2;
  const double block_mass[9] = {mass, 0, 0, 0, mass, 0, 0, 0, inertia}; /* velocities x, y, angle */
  const double momentum[3] = {0, -9.81 * mass * h, 0};                  /* k = M v + h Q: at rest, its weight */
  const double corners[6] = {0, 1, -half_width, 0, 1, half_width};      /* how fast each corner rises: a row of J */
  const double *impulses = NULL;
  int32_t block = 0, bodies[2], count = 0;
  mlcp_problem *problem = NULL;
  mlcp_solver *solver = NULL;
  mlcp_rows rows;
  mlcp_report report;

  mlcp_report_init(&report, sizeof report);
  mlcp_rows_init(&rows, sizeof rows); /* unilateral, against the world, r = 0 */
  rows.count = 2;
  rows.body_a = bodies;
  rows.jacobian_a = corners;

  if (mlcp_problem_create(NULL, &problem) || mlcp_solver_create(NULL, NULL, &solver) ||
      mlcp_problem_bodies_add(problem, 1, 3, block_mass, 0, &block) ||
      mlcp_problem_set_momentum(problem, 0, 3, momentum)) return 1;
  bodies[0] = bodies[1] = block;
  if (mlcp_problem_rows_add(problem, &rows, NULL) || mlcp_solve(solver, problem, NULL, NULL, &report) ||
      mlcp_solver_impulses(solver, &impulses, &count)) return 1;

  printf("%s: %.4f and %.4f N.s, error %.0e\n", mlcp_outcome_text(report.outcome), impulses[0], impulses[1],
         report.largest_error);
  mlcp_solver_destroy(solver);
  mlcp_problem_destroy(problem);
  return report.outcome == MLCP_SOLVED ? 0 : 1;
}
