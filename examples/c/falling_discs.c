/* How an engine uses libmlcp: discs fall into a bin and come to rest on each other, with friction, and every step starts from the last one.
 *
 * The problem and the solver live as long as the engine. In each step the momentum is set, the contacts of the step are added with a key
 * each, and the solver finds where the last solve left those with the same key: the first step is cold, all others are warm.
 */
#include <math.h>
#include <mlcp.h>
#include <stdint.h>
#include <stdio.h>

enum { DISCS = 12, STEPS = 200, MOST_CONTACTS = 8 * DISCS };

static const double h = 0.01, gravity = 9.81, radius = 0.1, mass = 1.0, friction = 0.4, bin = 0.45, margin = 0.05;

typedef struct Disc {
  double x, y, angle;
} Disc;

/* What is handed over in one call: per contact a normal row and a tangent row, three velocities a body. */
typedef struct Contacts {
  int32_t count, body_a[MOST_CONTACTS], body_b[MOST_CONTACTS];
  double jacobian_a[MOST_CONTACTS][2][3], jacobian_b[MOST_CONTACTS][2][3], r[MOST_CONTACTS][2], mu[MOST_CONTACTS];
  uint64_t key[MOST_CONTACTS];
} Contacts;

/* Disc b and what lies on its side against n: disc a, or for MLCP_WORLD the wall `feature`. n points at b. */
static mlcp_status touch(Contacts *to, int32_t a, int32_t b, uint64_t feature, double nx, double ny, double gap) {
  int32_t i = to->count;
  const double rows[2][3] = {{nx, ny, 0}, {-ny, nx, -radius}}; /* b's surface lies at -radius n from its centre */
  if (gap > margin || i == MOST_CONTACTS) return MLCP_OK;
  for (int row = 0; row < 2; ++row) {
    for (int k = 0; k < 3; ++k) {
      to->jacobian_b[i][row][k] = rows[row][k];
      to->jacobian_a[i][row][k] = k < 2 ? -rows[row][k] : rows[row][k]; /* a's surface lies at +radius n: it turns the other way */
    }
  }
  to->body_a[i] = a;
  to->body_b[i] = b;
  to->mu[i] = friction;
  to->key[i] = ((uint64_t)(a + 2) << 40) | ((uint64_t)(b + 2) << 16) | feature; /* the same for the same pair in every step */
  to->r[i][1] = 0;
  to->count = i + 1;
  return mlcp_timestep_rows(h, 0.2, 1, 1, &gap, NULL, &to->r[i][0]);
}

static mlcp_status find_contacts(const Disc *disc, Contacts *found) {
  mlcp_status status = MLCP_OK;
  found->count = 0;
  for (int32_t b = 0; b < DISCS && !status; ++b) {
    status = touch(found, MLCP_WORLD, b, 1, 0, 1, disc[b].y - radius);
    if (!status) status = touch(found, MLCP_WORLD, b, 2, 1, 0, disc[b].x + bin - radius);
    if (!status) status = touch(found, MLCP_WORLD, b, 3, -1, 0, bin - disc[b].x - radius);
    for (int32_t a = 0; a < b && !status; ++a) {
      const double dx = disc[b].x - disc[a].x, dy = disc[b].y - disc[a].y, distance = sqrt(dx * dx + dy * dy);
      status = touch(found, a, b, 0, dx / distance, dy / distance, distance - 2 * radius);
    }
  }
  return status;
}

static mlcp_status add_contacts(mlcp_problem *problem, const Contacts *found) {
  mlcp_contacts contacts;
  mlcp_contacts_init(&contacts, sizeof contacts); /* Coulomb's law unless a model is given */
  contacts.count = found->count;
  contacts.dimension = 2;
  contacts.body_a = found->body_a;
  contacts.body_b = found->body_b;
  contacts.jacobian_a = &found->jacobian_a[0][0][0];
  contacts.jacobian_b = &found->jacobian_b[0][0][0];
  contacts.jacobian_a_stride = contacts.jacobian_b_stride = sizeof found->jacobian_a[0];
  contacts.r = &found->r[0][0];
  contacts.mu = found->mu;
  contacts.key = found->key;
  return mlcp_problem_contacts_add(problem, &contacts, NULL);
}

int main(void) {
  mlcp_problem *problem = NULL;
  mlcp_solver *solver = NULL;
  mlcp_report report;
  Disc disc[DISCS];
  Contacts found;
  double masses[DISCS][9] = {{0}}, velocity[3 * DISCS] = {0}, force[3 * DISCS] = {0};

  for (int i = 0; i < DISCS; ++i) {
    disc[i] = (Disc){-0.3 + 0.29 * (i % 3) + 0.01 * (i / 3), 0.15 + 0.22 * (i / 3), 0};
    masses[i][0] = masses[i][4] = mass;
    masses[i][8] = 0.5 * mass * radius * radius;
    force[3 * i + 1] = -gravity * mass;
  }
  mlcp_report_init(&report, sizeof report);
  if (mlcp_problem_create(NULL, &problem) || mlcp_solver_create(NULL, NULL, &solver) ||
      mlcp_problem_bodies_add(problem, DISCS, 3, &masses[0][0], 0, NULL)) return 1;

  printf("step contacts sticking sliding warm pivots  error  highest disc\n");
  for (int step = 0; step < STEPS; ++step) {
    const double *v = NULL;
    double highest = 0;
    int32_t count = 0;
    if (mlcp_timestep_momentum(problem, h, 3 * DISCS, velocity, force) || mlcp_problem_rows_clear(problem) ||
        find_contacts(disc, &found) || add_contacts(problem, &found) || mlcp_solve(solver, problem, NULL, NULL, &report) ||
        mlcp_solver_velocities(solver, &v, &count)) {
      fprintf(stderr, "%s%s\n", mlcp_problem_error(problem), mlcp_solver_error(solver));
      return 1;
    }
    for (int i = 0; i < DISCS; ++i) {
      for (int k = 0; k < 3; ++k) velocity[3 * i + k] = v[3 * i + k];
      disc[i].x += h * velocity[3 * i];
      disc[i].y += h * velocity[3 * i + 1];
      disc[i].angle += h * velocity[3 * i + 2];
      highest = fmax(highest, disc[i].y);
    }
    if (step % 20 == 0 || report.outcome != MLCP_SOLVED)
      printf("%4d %8d %8d %7d %4d %6d  %.0e  %.4f m%s\n", step, found.count, report.contacts_sticking, report.contacts_sliding, report.warm,
             (int)report.pivots, report.largest_error, highest, report.outcome == MLCP_SOLVED ? "" : "  not solved");
    if (report.outcome != MLCP_SOLVED) return 1;
  }
  mlcp_solver_destroy(solver);
  mlcp_problem_destroy(problem);
  return 0;
}
