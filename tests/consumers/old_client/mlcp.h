/* The declarations of mlcp.h as they were in the first 0.1, before newton and friction came: what a program compiled then knows. Frozen. */
#ifndef MLCP_H
#define MLCP_H 
#include <stddef.h>
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif
#if defined(_WIN32)
#define MLCP_API 
#elif defined(__GNUC__)
#define MLCP_API __attribute__((visibility("default")))
#else
#define MLCP_API 
#endif
#define MLCP_ABI_VERSION 0
MLCP_API int32_t mlcp_abi_version(void);
MLCP_API const char *mlcp_version(void);
typedef int32_t mlcp_status;
enum {
  MLCP_OK = 0,
  MLCP_ERROR_NULL = 1,
  MLCP_ERROR_ARGUMENT = 2,
  MLCP_ERROR_RANGE = 3,
  MLCP_ERROR_STATE = 4,
  MLCP_ERROR_OUT_OF_MEMORY = 5,
  MLCP_ERROR_IO = 6,
  MLCP_ERROR_FORMAT = 7,
  MLCP_ERROR_UNSUPPORTED = 8,
  MLCP_ERROR_INTERNAL = 9
};
MLCP_API const char *mlcp_status_text(mlcp_status status);
typedef int32_t mlcp_outcome;
enum {
  MLCP_SOLVED = 0,
  MLCP_ITERATION_LIMIT = 1,
  MLCP_WORK_LIMIT = 2,
  MLCP_TIME_LIMIT = 3,
  MLCP_INTERRUPTED = 4,
  MLCP_INFEASIBLE = 5,
  MLCP_UNBOUNDED = 6,
  MLCP_NOT_POSITIVE_DEFINITE = 7,
  MLCP_BAD_INPUT = 8
};
MLCP_API const char *mlcp_outcome_text(mlcp_outcome outcome);
typedef struct mlcp_allocator {
  void *context;
  void *(*reallocate)(void *context, void *block, size_t old_size, size_t new_size);
  void (*release)(void *context, void *block, size_t size);
} mlcp_allocator;
typedef struct mlcp_problem mlcp_problem;
#define MLCP_WORLD (-1)
MLCP_API mlcp_status mlcp_problem_create(const mlcp_allocator *allocator, mlcp_problem **problem);
MLCP_API void mlcp_problem_destroy(mlcp_problem *problem);
MLCP_API mlcp_status mlcp_problem_clone(const mlcp_problem *problem, mlcp_problem **copy);
MLCP_API const char *mlcp_problem_error(const mlcp_problem *problem);
MLCP_API int32_t mlcp_problem_velocity_count(const mlcp_problem *problem);
MLCP_API int32_t mlcp_problem_row_count(const mlcp_problem *problem);
MLCP_API int32_t mlcp_problem_body_count(const mlcp_problem *problem);
MLCP_API int64_t mlcp_problem_entry_count(const mlcp_problem *problem);
MLCP_API mlcp_status mlcp_problem_reserve(mlcp_problem *problem, int32_t bodies, int32_t velocities, int32_t rows,
                                          int64_t entries);
MLCP_API mlcp_status mlcp_problem_trim(mlcp_problem *problem);
MLCP_API mlcp_status mlcp_problem_clear(mlcp_problem *problem);
typedef int32_t mlcp_triangle;
enum { MLCP_FULL = 0, MLCP_LOWER = 1, MLCP_UPPER = 2 };
MLCP_API mlcp_status mlcp_problem_bodies_add(mlcp_problem *problem, int32_t count, int32_t dimension, const double *masses,
                                             ptrdiff_t stride_bytes, int32_t *ids);
MLCP_API mlcp_status mlcp_problem_body_add_sparse(mlcp_problem *problem, int32_t dimension, const int32_t *column_pointers,
                                                  const int32_t *row_indices, const double *values, mlcp_triangle triangle,
                                                  int32_t *id);
MLCP_API mlcp_status mlcp_problem_body_set_mass(mlcp_problem *problem, int32_t body, const double *mass, int64_t count);
MLCP_API mlcp_status mlcp_problem_body_remove(mlcp_problem *problem, int32_t body);
MLCP_API mlcp_status mlcp_problem_body_range(const mlcp_problem *problem, int32_t body, int32_t *offset, int32_t *dimension);
MLCP_API mlcp_status mlcp_problem_bodies(const mlcp_problem *problem, int32_t capacity, int32_t *ids, int32_t *count);
MLCP_API mlcp_status mlcp_problem_body_set_prescribed(mlcp_problem *problem, int32_t body, const double *velocity,
                                                      int32_t count);
MLCP_API mlcp_status mlcp_problem_body_set_dynamic(mlcp_problem *problem, int32_t body);
MLCP_API mlcp_status mlcp_problem_body_state(const mlcp_problem *problem, int32_t body, int32_t *prescribed, int32_t count,
                                             double *velocity);
MLCP_API mlcp_status mlcp_problem_set_momentum(mlcp_problem *problem, int32_t first, int32_t count, const double *k);
typedef struct mlcp_rows {
  size_t struct_size;
  int32_t count;
  const int32_t *body_a;
  const int32_t *body_b;
  const double *jacobian_a;
  const double *jacobian_b;
  ptrdiff_t jacobian_a_stride;
  ptrdiff_t jacobian_b_stride;
  const double *r;
  const double *lo;
  const double *hi;
  const double *compliance;
  const uint64_t *key;
  ptrdiff_t value_stride;
  ptrdiff_t body_stride;
  ptrdiff_t key_stride;
} mlcp_rows;
typedef struct mlcp_rows_f32 {
  size_t struct_size;
  int32_t count;
  const int32_t *body_a;
  const int32_t *body_b;
  const float *jacobian_a;
  const float *jacobian_b;
  ptrdiff_t jacobian_a_stride;
  ptrdiff_t jacobian_b_stride;
  const float *r;
  const float *lo;
  const float *hi;
  const float *compliance;
  const uint64_t *key;
  ptrdiff_t value_stride;
  ptrdiff_t body_stride;
  ptrdiff_t key_stride;
} mlcp_rows_f32;
MLCP_API void mlcp_rows_init(mlcp_rows *rows, size_t struct_size);
MLCP_API void mlcp_rows_f32_init(mlcp_rows_f32 *rows, size_t struct_size);
MLCP_API mlcp_status mlcp_problem_rows_add(mlcp_problem *problem, const mlcp_rows *rows, int32_t *first);
MLCP_API mlcp_status mlcp_problem_rows_add_f32(mlcp_problem *problem, const mlcp_rows_f32 *rows, int32_t *first);
MLCP_API mlcp_status mlcp_problem_row_add(mlcp_problem *problem, int32_t count, const int32_t *columns, const double *values,
                                          double r, double lo, double hi, double compliance, uint64_t key, int32_t *index);
MLCP_API mlcp_status mlcp_problem_rows_add_csr(mlcp_problem *problem, int32_t count, const int32_t *row_pointers,
                                               const int32_t *columns, const double *values, const double *r,
                                               const double *lo, const double *hi, const double *compliance,
                                               const uint64_t *key, int32_t *first);
MLCP_API mlcp_status mlcp_problem_rows_add_csc(mlcp_problem *problem, int32_t count, const int32_t *column_pointers,
                                               const int32_t *row_indices, const double *values, const double *r,
                                               const double *lo, const double *hi, const double *compliance,
                                               const uint64_t *key, int32_t *first);
MLCP_API mlcp_status mlcp_problem_set_compliance_matrix(mlcp_problem *problem, int32_t count, const int32_t *column_pointers,
                                                        const int32_t *row_indices, const double *values,
                                                        mlcp_triangle triangle);
MLCP_API mlcp_status mlcp_problem_rows_set_r(mlcp_problem *problem, int32_t first, int32_t count, const double *r);
MLCP_API mlcp_status mlcp_problem_rows_set_bounds(mlcp_problem *problem, int32_t first, int32_t count, const double *lo,
                                                  const double *hi);
MLCP_API mlcp_status mlcp_problem_rows_set_compliance(mlcp_problem *problem, int32_t first, int32_t count,
                                                      const double *compliance);
MLCP_API mlcp_status mlcp_problem_rows_set_keys(mlcp_problem *problem, int32_t first, int32_t count, const uint64_t *keys);
MLCP_API mlcp_status mlcp_problem_row_set_jacobian(mlcp_problem *problem, int32_t row, const double *values, int32_t count);
MLCP_API mlcp_status mlcp_problem_rows_remove(mlcp_problem *problem, int32_t count, const int32_t *rows);
MLCP_API mlcp_status mlcp_problem_rows_clear(mlcp_problem *problem);
MLCP_API mlcp_status mlcp_problem_get_momentum(const mlcp_problem *problem, int32_t count, double *k);
MLCP_API mlcp_status mlcp_problem_get_rows(const mlcp_problem *problem, int32_t count, double *r, double *lo, double *hi,
                                           double *compliance, uint64_t *key);
typedef struct mlcp_matrix_view {
  size_t struct_size;
  int32_t rows;
  int32_t columns;
  int64_t entries;
  const int32_t *pointers;
  const int32_t *indices;
  const double *values;
} mlcp_matrix_view;
MLCP_API void mlcp_matrix_view_init(mlcp_matrix_view *view, size_t struct_size);
MLCP_API mlcp_status mlcp_problem_mass(const mlcp_problem *problem, mlcp_matrix_view *mass);
MLCP_API mlcp_status mlcp_problem_jacobian(const mlcp_problem *problem, mlcp_matrix_view *jacobian);
MLCP_API mlcp_status mlcp_problem_compliance(const mlcp_problem *problem, mlcp_matrix_view *compliance);
MLCP_API mlcp_status mlcp_timestep_momentum(mlcp_problem *problem, double h, int32_t count, const double *v, const double *q);
MLCP_API mlcp_status mlcp_timestep_rows(double h, double stabilisation, int32_t unilateral, int32_t count, const double *phi,
                                        const double *phi_t, double *r);
MLCP_API mlcp_status mlcp_timestep_spring(double h, double stiffness, double damping, double phi, double *compliance,
                                          double *r);
MLCP_API mlcp_status mlcp_timestep_erp_cfm(double h, double erp, double cfm, double phi, double *compliance, double *r);
typedef struct mlcp_mask mlcp_mask;
typedef uint8_t mlcp_row_state;
enum {
  MLCP_ROW_DISABLED = 0,
  MLCP_ROW_AT_LOWER = 1,
  MLCP_ROW_ACTIVE = 2,
  MLCP_ROW_AT_UPPER = 3
};
MLCP_API mlcp_status mlcp_mask_create(const mlcp_allocator *allocator, int32_t count, mlcp_row_state state, mlcp_mask **mask);
MLCP_API void mlcp_mask_destroy(mlcp_mask *mask);
MLCP_API mlcp_status mlcp_mask_clone(const mlcp_allocator *allocator, const mlcp_mask *mask, mlcp_mask **copy);
MLCP_API const char *mlcp_mask_error(const mlcp_mask *mask);
MLCP_API int32_t mlcp_mask_size(const mlcp_mask *mask);
MLCP_API mlcp_status mlcp_mask_resize(mlcp_mask *mask, int32_t count, mlcp_row_state state);
MLCP_API mlcp_status mlcp_mask_set(mlcp_mask *mask, int32_t first, int32_t count, const mlcp_row_state *states);
MLCP_API mlcp_status mlcp_mask_get(const mlcp_mask *mask, int32_t first, int32_t count, mlcp_row_state *states);
MLCP_API const mlcp_row_state *mlcp_mask_states(const mlcp_mask *mask);
MLCP_API int32_t mlcp_mask_count(const mlcp_mask *mask, mlcp_row_state state);
MLCP_API int32_t mlcp_mask_equal(const mlcp_mask *a, const mlcp_mask *b);
MLCP_API mlcp_status mlcp_mask_take_keys(mlcp_mask *mask, const mlcp_problem *problem);
MLCP_API mlcp_status mlcp_mask_carry(mlcp_mask *mask, const mlcp_problem *problem, const mlcp_mask *previous,
                                     mlcp_row_state otherwise);
typedef struct mlcp_solver mlcp_solver;
typedef int32_t mlcp_method;
enum {
  MLCP_METHOD_AUTO = 0,
  MLCP_METHOD_SIMPLEX = 1
};
MLCP_API const char *mlcp_method_text(mlcp_method method);
typedef int32_t mlcp_pivot_rule;
enum {
  MLCP_PIVOT_DUAL = 0,
  MLCP_PIVOT_PRINTED = 1
};
typedef int32_t mlcp_refactorize;
enum {
  MLCP_REFACTORIZE_WHEN_NEEDED = 0,
  MLCP_REFACTORIZE_ALWAYS = 1
};
typedef struct mlcp_progress {
  size_t struct_size;
  double seconds;
  int64_t pivots;
  int64_t work;
  int32_t island;
  int32_t islands;
  double violation;
} mlcp_progress;
typedef int32_t (*mlcp_progress_callback)(void *context, const mlcp_progress *progress);
typedef struct mlcp_settings {
  size_t struct_size;
  mlcp_method method;
  mlcp_pivot_rule pivot_rule;
  mlcp_refactorize refactorize;
  int32_t trace;
  double tolerance;
  int64_t max_iterations;
  int64_t max_work;
  double max_seconds;
  mlcp_progress_callback progress;
  void *progress_context;
} mlcp_settings;
MLCP_API void mlcp_settings_init(mlcp_settings *settings, size_t struct_size);
MLCP_API mlcp_status mlcp_solver_create(const mlcp_settings *settings, const mlcp_allocator *allocator, mlcp_solver **solver);
MLCP_API void mlcp_solver_destroy(mlcp_solver *solver);
MLCP_API mlcp_status mlcp_solver_set_settings(mlcp_solver *solver, const mlcp_settings *settings);
MLCP_API mlcp_status mlcp_solver_get_settings(const mlcp_solver *solver, mlcp_settings *settings);
MLCP_API const char *mlcp_solver_error(const mlcp_solver *solver);
MLCP_API mlcp_status mlcp_solver_trim(mlcp_solver *solver);
typedef struct mlcp_report {
  size_t struct_size;
  mlcp_outcome outcome;
  mlcp_method method;
  double momentum_error;
  double constraint_error;
  double largest_error;
  double momentum_residual;
  double constraint_residual;
  int32_t worst_velocity;
  int32_t worst_row;
  int32_t worst_body;
  int32_t islands;
  int32_t islands_failed;
  int32_t enabled_rows;
  int32_t active_rows;
  int32_t redundant_rows;
  int64_t pivots;
  int64_t toggles;
  int64_t factorizations;
  int64_t refinements;
  int64_t work;
  int64_t factor_entries;
  double seconds;
  double seconds_analyze;
  double seconds_factorize;
  double seconds_solve;
  double seconds_report;
  int32_t analyzed;
  int32_t refactorized_for_drift;
} mlcp_report;
MLCP_API void mlcp_report_init(mlcp_report *report, size_t struct_size);
MLCP_API mlcp_status mlcp_analyze(mlcp_solver *solver, const mlcp_problem *problem, const mlcp_mask *enabled);
MLCP_API mlcp_status mlcp_solve(mlcp_solver *solver, const mlcp_problem *problem, const mlcp_mask *enabled,
                                const mlcp_mask *start, mlcp_report *report);
MLCP_API mlcp_status mlcp_solver_velocities(const mlcp_solver *solver, const double **v, int32_t *count);
MLCP_API mlcp_status mlcp_solver_impulses(const mlcp_solver *solver, const double **gamma, int32_t *count);
MLCP_API mlcp_status mlcp_solver_slacks(const mlcp_solver *solver, const double **w, int32_t *count);
MLCP_API mlcp_status mlcp_solver_mask(const mlcp_solver *solver, const mlcp_mask **mask);
MLCP_API mlcp_status mlcp_solver_redundant(const mlcp_solver *solver, const uint8_t **redundant, int32_t *count);
MLCP_API mlcp_status mlcp_solver_read_velocities_f32(const mlcp_solver *solver, int32_t count, float *v, ptrdiff_t stride_bytes);
MLCP_API mlcp_status mlcp_solver_read_impulses_f32(const mlcp_solver *solver, int32_t count, float *gamma, ptrdiff_t stride_bytes);
MLCP_API mlcp_status mlcp_solver_reaction(const mlcp_solver *solver, const mlcp_problem *problem, int32_t body, int32_t count,
                                          double *reaction);
MLCP_API mlcp_status mlcp_solver_row_islands(const mlcp_solver *solver, const int32_t **island, int32_t *count);
MLCP_API mlcp_status mlcp_solver_island_outcomes(const mlcp_solver *solver, const mlcp_outcome **outcome, int32_t *count);
MLCP_API mlcp_status mlcp_solver_certificate(const mlcp_solver *solver, int32_t island, const int32_t **rows, const double **y,
                                             int32_t *count);
typedef struct mlcp_pivot {
  int32_t island;
  int32_t entering;
  int32_t blocking;
  mlcp_row_state to;
  uint8_t dependent;
  double step;
  double violation;
  double schur;
} mlcp_pivot;
MLCP_API mlcp_status mlcp_solver_trace(const mlcp_solver *solver, const mlcp_pivot **pivots, int64_t *count);
MLCP_API mlcp_status mlcp_snapshot_save(const char *path, const mlcp_problem *problem, const mlcp_solver *solver,
                                        const mlcp_mask *enabled, const mlcp_mask *start, char *message, size_t message_size);
MLCP_API mlcp_status mlcp_snapshot_write(const mlcp_problem *problem, const mlcp_solver *solver, const mlcp_mask *enabled,
                                         const mlcp_mask *start, size_t capacity, void *buffer, size_t *size, char *message,
                                         size_t message_size);
MLCP_API mlcp_status mlcp_snapshot_load(const char *path, const mlcp_allocator *allocator, mlcp_problem **problem,
                                        mlcp_solver **solver, mlcp_mask **enabled, mlcp_mask **start, char *message,
                                        size_t message_size);
MLCP_API mlcp_status mlcp_snapshot_read(const void *bytes, size_t size, const mlcp_allocator *allocator,
                                        mlcp_problem **problem, mlcp_solver **solver, mlcp_mask **enabled, mlcp_mask **start,
                                        char *message, size_t message_size);
#ifdef __cplusplus
}
#endif
#endif
