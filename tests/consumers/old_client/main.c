/* A program that was compiled when mlcp.h was shorter, run with the library of today: what it knows works, and nothing behind its structs is
 * touched, though today's are longer. */
#include "mlcp.h"

#include <stdio.h>
#include <string.h>

#define GUARD 64

/* A struct of then in the middle of memory that belongs to somebody else. */
#define GUARDED(type) \
  struct {            \
    type value;       \
    unsigned char behind[GUARD]; \
  }

static int untouched(const unsigned char *behind) {
  int i;
  for (i = 0; i < GUARD; ++i)
    if (behind[i] != 0x5a) return 0;
  return 1;
}

#define CHECK(condition)                                           \
  do {                                                             \
    if (!(condition)) {                                            \
      printf("line %d: %s does not hold\n", __LINE__, #condition); \
      return 1;                                                    \
    }                                                              \
  } while (0)

static int32_t calls;

static int32_t watch(void *context, const mlcp_progress *progress) {
  (void)context;
  ++calls;
  return progress->island >= progress->islands;
}

int main(void) {
  const double mass[4] = {2, 0, 0, 2}, momentum[2] = {-0.25, 0.5}, upward[4] = {1, 0, 1, 0}, too_fast = 3, downward[2] = {-1, 0};
  const int32_t bodies[2] = {0, 0}, columns[2] = {0, 1};
  const double *impulses = NULL, *y = NULL;
  const int32_t *rows = NULL;
  const mlcp_pivot *pivots = NULL;
  const mlcp_mask *lent = NULL;
  mlcp_problem *problem = NULL, *copy = NULL;
  mlcp_mask *mask = NULL, *start = NULL;
  mlcp_solver *solver = NULL, *twin = NULL;
  char message[512];
  unsigned char bytes[4096];
  mlcp_mask *enabled = NULL;
  size_t size = 0;
  int64_t steps = 0;
  int32_t body = -1, count = 0;
  GUARDED(mlcp_settings) settings;
  GUARDED(mlcp_report) report;
  GUARDED(mlcp_rows) contacts;
  GUARDED(mlcp_matrix_view) view;

  memset(&settings, 0x5a, sizeof settings);
  memset(&report, 0x5a, sizeof report);
  memset(&contacts, 0x5a, sizeof contacts);
  memset(&view, 0x5a, sizeof view);
  mlcp_settings_init(&settings.value, sizeof settings.value);
  mlcp_report_init(&report.value, sizeof report.value);
  mlcp_rows_init(&contacts.value, sizeof contacts.value);
  mlcp_matrix_view_init(&view.value, sizeof view.value);
  settings.value.method = MLCP_METHOD_SIMPLEX;
  settings.value.trace = 1;
  settings.value.progress = watch;
  CHECK(mlcp_abi_version() == MLCP_ABI_VERSION);
  CHECK(mlcp_problem_create(NULL, &problem) == MLCP_OK);
  CHECK(mlcp_solver_create(&settings.value, NULL, &solver) == MLCP_OK);
  CHECK(mlcp_problem_bodies_add(problem, 1, 2, mass, 0, &body) == MLCP_OK && body == 0);
  CHECK(mlcp_problem_set_momentum(problem, 0, 2, momentum) == MLCP_OK);
  contacts.value.count = 2;
  contacts.value.body_a = bodies;
  contacts.value.jacobian_a = upward;
  CHECK(mlcp_problem_rows_add(problem, &contacts.value, NULL) == MLCP_OK);

  CHECK(mlcp_solve(solver, problem, NULL, NULL, &report.value) == MLCP_OK);
  CHECK(report.value.outcome == MLCP_SOLVED && report.value.largest_error <= 1e-12 && report.value.enabled_rows == 2);
  CHECK(mlcp_solver_impulses(solver, &impulses, &count) == MLCP_OK && count == 2);
  CHECK(impulses[0] + impulses[1] == 0.25);
  CHECK(calls > 0);
  CHECK(mlcp_solver_trace(solver, &pivots, &steps) == MLCP_OK && steps == report.value.pivots && pivots[0].entering >= 0);
  CHECK(mlcp_problem_jacobian(problem, &view.value) == MLCP_OK && view.value.rows == 2 && view.value.entries == 4);

  /* the next step, from the last mask */
  CHECK(mlcp_solver_mask(solver, &lent) == MLCP_OK);
  CHECK(mlcp_mask_create(NULL, 0, MLCP_ROW_ACTIVE, &mask) == MLCP_OK);
  CHECK(mlcp_mask_carry(mask, problem, lent, MLCP_ROW_AT_LOWER) == MLCP_OK && mlcp_mask_size(mask) == 2);
  CHECK(mlcp_solve(solver, problem, NULL, mask, &report.value) == MLCP_OK && report.value.outcome == MLCP_SOLVED);

  /* a ceiling that comes down */
  CHECK(mlcp_problem_row_add(problem, 2, columns, downward, too_fast, 0, 1e300 * 1e300, 0, 7, NULL) == MLCP_OK);
  CHECK(mlcp_solve(solver, problem, NULL, NULL, &report.value) == MLCP_OK && report.value.outcome == MLCP_INFEASIBLE);
  CHECK(mlcp_solver_certificate(solver, -1, &rows, &y, &count) == MLCP_OK && count == 2);

  CHECK(mlcp_snapshot_write(problem, solver, NULL, NULL, sizeof bytes, bytes, &size, message, sizeof message) == MLCP_OK);
  CHECK(mlcp_snapshot_read(bytes, size, NULL, &copy, &twin, &enabled, &start, message, sizeof message) == MLCP_OK);
  CHECK(mlcp_solve(twin, copy, enabled, start, &report.value) == MLCP_OK && report.value.outcome == MLCP_INFEASIBLE);
  CHECK(mlcp_solver_get_settings(twin, &settings.value) == MLCP_OK && settings.value.method == MLCP_METHOD_SIMPLEX);

  CHECK(untouched(settings.behind) && untouched(report.behind) && untouched(contacts.behind) && untouched(view.behind));
  mlcp_solver_destroy(twin);
  mlcp_problem_destroy(copy);
  mlcp_mask_destroy(enabled);
  mlcp_mask_destroy(start);
  mlcp_mask_destroy(mask);
  mlcp_solver_destroy(solver);
  mlcp_problem_destroy(problem);
  puts("all of it works");
  return 0;
}
