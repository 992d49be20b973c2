/* What call_cost.rs does, in C. */
#include <mlcp.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { BODIES = 25, ROWS = 2 * BODIES };

struct contacts {
  int32_t body_a[ROWS], body_b[ROWS];
  double jacobian_a[6 * ROWS], jacobian_b[6 * BODIES];
  uint64_t key[ROWS];
};

static void make_contacts(struct contacts *contacts, const int32_t *bodies) {
  for (int i = 0; i < ROWS; ++i) {
    const int body = i % BODIES;
    contacts->body_a[i] = bodies[body];
    contacts->body_b[i] = MLCP_WORLD;
    contacts->key[i] = (uint64_t)i + 1;
    contacts->jacobian_a[6 * i + (i < BODIES ? 2 : 0)] = 1.0;
    contacts->jacobian_a[6 * i + 4] = 0.01 * body;
    if (i > BODIES) {
      contacts->body_b[i] = bodies[body - 1];
      contacts->jacobian_b[6 * (body - 1)] = -1.0;
    }
  }
}

static void require(int good) {
  if (good) return;
  fprintf(stderr, "a call failed\n");
  exit(1);
}

static double run(int steps) {
  static struct contacts contacts;
  static double masses[36 * BODIES], k[6 * BODIES];
  int32_t bodies[BODIES];
  mlcp_problem *problem = NULL;
  mlcp_solver *solver = NULL;
  mlcp_mask *start = NULL;
  double sum = 0.0;

  for (int i = 0; i < BODIES; ++i)
    for (int j = 0; j < 6; ++j) masses[36 * i + 7 * j] = j < 3 ? 2.0 : 0.1;
  require(!mlcp_problem_create(NULL, &problem) && !mlcp_solver_create(NULL, NULL, &solver) &&
          !mlcp_mask_create(NULL, 0, MLCP_ROW_AT_LOWER, &start) && !mlcp_problem_bodies_add(problem, BODIES, 6, masses, 0, bodies));
  make_contacts(&contacts, bodies);

  for (int step = 0; step < steps; ++step) {
    const double *gamma = NULL, *v = NULL;
    const mlcp_mask *last = NULL;
    int32_t count = 0;
    double impulses = 0.0;
    mlcp_rows rows;
    mlcp_report report;
    for (int body = 0; body < BODIES; ++body) {
      k[6 * body] = (step + body) % 7 == 0 ? 0.02 : -0.1;
      k[6 * body + 2] = -0.2;
    }
    require(!mlcp_problem_set_momentum(problem, 0, 6 * BODIES, k) && !mlcp_problem_rows_clear(problem));
    mlcp_rows_init(&rows, sizeof rows);
    rows.count = ROWS;
    rows.body_a = contacts.body_a;
    rows.body_b = contacts.body_b;
    rows.jacobian_a = contacts.jacobian_a;
    rows.jacobian_b = contacts.jacobian_b;
    rows.key = contacts.key;
    require(!mlcp_problem_rows_add(problem, &rows, NULL));
    mlcp_report_init(&report, sizeof report);
    if (step > 0)
      require(!mlcp_solver_mask(solver, &last) && !mlcp_mask_carry(start, problem, last, MLCP_ROW_AT_LOWER));
    require(!mlcp_solve(solver, problem, NULL, step > 0 ? start : NULL, &report) && report.outcome == MLCP_SOLVED);
    require(!mlcp_solver_impulses(solver, &gamma, &count));
    for (int32_t i = 0; i < count; ++i) impulses += gamma[i];
    require(!mlcp_solver_velocities(solver, &v, &count));
    sum += impulses + v[0];
  }
  mlcp_mask_destroy(start);
  mlcp_solver_destroy(solver);
  mlcp_problem_destroy(problem);
  return sum;
}

int main(int argc, char **argv) {
  const int steps = argc > 1 ? atoi(argv[1]) : 10000;
  struct timespec begin, end;
  clock_gettime(CLOCK_MONOTONIC, &begin);
  printf("sum %.17e\n", run(steps));
  clock_gettime(CLOCK_MONOTONIC, &end);
  fprintf(stderr, "%.2f us a step\n", ((double)(end.tv_sec - begin.tv_sec) * 1e9 + (double)(end.tv_nsec - begin.tv_nsec)) / 1e3 / steps);
  return 0;
}
