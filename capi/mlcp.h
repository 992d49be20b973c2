/* libmlcp: the mixed linear complementarity problem of multibody systems.
 *
 * The whole ABI. No other page is needed to use the library from C.
 *
 * THE PROBLEM
 *
 *     M v - J' g = k                                   momentum
 *     J v + S g - r = w                                constraint rows
 *     lo <= g <= hi,  w_i > 0 => g_i = lo_i,  w_i < 0 => g_i = hi_i,  else w_i = 0
 *
 *   v  velocities    n   m/s or rad/s      k  momentum           n   N.s
 *   g  impulses      m   N.s               r  right-hand side    m   m/s
 *   w  slacks        m   m/s               S  compliance         m x m, symmetric PSD, m/(N.s)
 *   M  mass          n x n, symmetric positive definite          J  Jacobian, m x n, sparse
 *
 * M may be semidefinite, down to velocities without any mass, where rows hold what it does not.
 * A bilateral row (joint) has lo = -inf, hi = +inf; a unilateral row (contact, limit) lo = 0, hi = +inf; a boxed row
 * (motor, fixed-bound friction) finite bounds. The reduced problem w = A z + b, 0 <= z, w is n = 0, S = A, r = -b, g = z.
 * Source: Tasora, Manconi, Silvestri, "Un nuovo metodo del simplesso per il problema di complementarita lineare mista in
 * sistemi multibody con vincoli unilateri", equations (2.5) to (3.3); any consistent units will do.
 *
 * CONVENTIONS
 *
 *   Status     Every function that can fail returns mlcp_status; MLCP_OK is 0. How a solve ended is mlcp_outcome, in the report.
 *   Errors     The text of the last failure lives in the object that was edited or used (mlcp_problem_error,
 *              mlcp_mask_error, mlcp_solver_error) and names the argument and the index. Functions that take a const
 *              object leave no text; those for snapshots give it to the caller. A call that fails changes nothing; a bulk
 *              call is all or nothing.
 *   Ownership  Input arrays are copied before the call returns. What an object lends through a pointer is valid until the
 *              next call that takes that object as non-const. Handles are freed by their destroy function; destroy(NULL) is fine.
 *   Threads    Objects share nothing. One object may be used by one thread at a time, except that any number of threads
 *              may read one const mlcp_problem or mlcp_mask, so several solvers may solve one problem at the same time.
 *   Sizes      Every array comes with its length, which is checked. Indices are 32-bit and start at 0.
 *   Structs    Start with struct_size and are filled by their init function, to which the caller passes sizeof the struct
 *              as compiled; fields are only ever appended.
 *   Silence    The library never prints, exits, throws across this boundary, installs signal handlers, keeps global state
 *              or touches the floating-point environment.
 */
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

/* The number of the ABI; equal to the SOVERSION of the shared library. */
#define MLCP_ABI_VERSION 0

/* ABI number of the library that is loaded. A binding compares it with the MLCP_ABI_VERSION it was built with. */
MLCP_API int32_t mlcp_abi_version(void);

/* "major.minor.patch" of the library that is loaded; static storage. */
MLCP_API const char *mlcp_version(void);

/* ---------------------------------------------------------------------------------------------------------- status */

typedef int32_t mlcp_status;
enum {
  MLCP_OK = 0,
  MLCP_ERROR_NULL = 1,          /* a handle or a required pointer is NULL */
  MLCP_ERROR_ARGUMENT = 2,      /* a value is not legal: NaN, lo > hi, an asymmetric matrix, an unknown enumerator */
  MLCP_ERROR_RANGE = 3,         /* an index is out of range, or a length does not match */
  MLCP_ERROR_STATE = 4,         /* the call does not fit the state of the object, e.g. results before a solve */
  MLCP_ERROR_OUT_OF_MEMORY = 5, /* the allocator returned NULL */
  MLCP_ERROR_IO = 6,            /* a file cannot be opened, read or written */
  MLCP_ERROR_FORMAT = 7,        /* a snapshot is damaged or from an unknown version */
  MLCP_ERROR_UNSUPPORTED = 8,   /* legal, but this build or this method cannot do it */
  MLCP_ERROR_INTERNAL = 9       /* a defect of the library: please report it with a snapshot */
};

/* Short English name of a status, e.g. "bad argument"; static storage, never NULL. */
MLCP_API const char *mlcp_status_text(mlcp_status status);

/* How a solve ended. */
typedef int32_t mlcp_outcome;
enum {
  MLCP_SOLVED = 0,                /* every error recomputed from the problem is within the tolerance */
  MLCP_ITERATION_LIMIT = 1,       /* max_iterations, or no further progress above the tolerance */
  MLCP_WORK_LIMIT = 2,            /* max_work entries touched */
  MLCP_TIME_LIMIT = 3,            /* max_seconds passed */
  MLCP_INTERRUPTED = 4,           /* the progress callback asked to stop */
  MLCP_INFEASIBLE = 5,            /* rows contradict each other; the certificate names them */
  MLCP_UNBOUNDED = 6,             /* only for semidefinite M: a ray along which the energy falls without end */
  MLCP_NOT_POSITIVE_DEFINITE = 7, /* M (or S of a reduced problem) is indefinite, or semidefinite and no row holds what it does not; the
                                     report names body and velocity */
  MLCP_BAD_INPUT = 8              /* never returned in a report: input is checked as it is added */
};

/* The name that the command line prints, e.g. "solved", "iteration_limit"; static storage, never NULL. */
MLCP_API const char *mlcp_outcome_text(mlcp_outcome outcome);

/* ------------------------------------------------------------------------------------------------------- allocation */

/* Memory hooks of one object and all it owns. NULL where one is taken means malloc, realloc and free.
 * reallocate(ctx, NULL, 0, n) allocates; returns NULL on failure and then leaves the old block as it is; blocks must be
 * aligned as by malloc. Called only on the thread that calls into the object. */
typedef struct mlcp_allocator {
  void *context;
  void *(*reallocate)(void *context, void *block, size_t old_size, size_t new_size);
  void (*release)(void *context, void *block, size_t size);
} mlcp_allocator;

/* ---------------------------------------------------------------------------------------------------------- problem */

/* Bodies, rows and their numbers: sparse assembly. Memory only grows until trim or destroy. */
typedef struct mlcp_problem mlcp_problem;

#define MLCP_WORLD (-1) /* the body that never moves */

MLCP_API mlcp_status mlcp_problem_create(const mlcp_allocator *allocator, mlcp_problem **problem);
MLCP_API void mlcp_problem_destroy(mlcp_problem *problem);

/* A deep copy with the same allocator. */
MLCP_API mlcp_status mlcp_problem_clone(const mlcp_problem *problem, mlcp_problem **copy);

/* Text of the last failed call on this problem, "" if none; never NULL. */
MLCP_API const char *mlcp_problem_error(const mlcp_problem *problem);

/* Number of velocities n, rows m, bodies, and stored entries of J. 0 for NULL. */
MLCP_API int32_t mlcp_problem_velocity_count(const mlcp_problem *problem);
MLCP_API int32_t mlcp_problem_row_count(const mlcp_problem *problem);
MLCP_API int32_t mlcp_problem_body_count(const mlcp_problem *problem);
MLCP_API int64_t mlcp_problem_entry_count(const mlcp_problem *problem);

/* Makes room for that many bodies, velocities, rows and entries of J, so that adding them calls no allocator. */
MLCP_API mlcp_status mlcp_problem_reserve(mlcp_problem *problem, int32_t bodies, int32_t velocities, int32_t rows,
                                          int64_t entries);
/* Gives unused memory back. */
MLCP_API mlcp_status mlcp_problem_trim(mlcp_problem *problem);
/* Back to empty; memory is kept. */
MLCP_API mlcp_status mlcp_problem_clear(mlcp_problem *problem);

/* Bodies. A body is a block of `dimension` velocities (3 in the plane, 6 in space, 1 for a joint coordinate, more for an
 * articulated or flexible body) with its mass matrix. The velocities of all bodies stand in v and k in ascending order of body
 * id. Ids are stable until the body is removed; ids of removed bodies are given out again, smallest first. */

/* Triangles of a symmetric matrix that the caller stores. */
typedef int32_t mlcp_triangle;
enum { MLCP_FULL = 0, MLCP_LOWER = 1, MLCP_UPPER = 2 };

/* Adds `count` bodies of one dimension. masses: count dense symmetric matrices, dimension*dimension doubles each,
 * stride_bytes apart (0: packed). ids: count entries, may be NULL. k starts at 0. Errors: NaN or Inf, asymmetry
 * (relative to the diagonal 1e-12), a non-positive diagonal, a pivot below -1e-12 M_jj. */
MLCP_API mlcp_status mlcp_problem_bodies_add(mlcp_problem *problem, int32_t count, int32_t dimension, const double *masses,
                                             ptrdiff_t stride_bytes, int32_t *ids);

/* Adds one body whose mass is sparse (articulated, flexible): dimension x dimension, compressed columns (or rows, it is
 * symmetric), column_pointers has dimension + 1 entries, row_indices and values column_pointers[dimension]. Entries may
 * be in any order, no (row, column) twice. The triangle is that of compressed columns: whoever passes the lower triangle as
 * compressed rows says MLCP_UPPER. Definiteness is judged in the solve. */
MLCP_API mlcp_status mlcp_problem_body_add_sparse(mlcp_problem *problem, int32_t dimension, const int32_t *column_pointers,
                                                  const int32_t *row_indices, const double *values, mlcp_triangle triangle,
                                                  int32_t *id);

/* New mass of a body: dense, dimension*dimension doubles; for a sparse body exactly the values in the order they were given. The
 * pattern stays, nothing is analyzed again. count = number of doubles in mass. */
MLCP_API mlcp_status mlcp_problem_body_set_mass(mlcp_problem *problem, int32_t body, const double *mass, int64_t count);

/* Removes a body. Error MLCP_ERROR_STATE while a row refers to it. The velocities behind it move up. */
MLCP_API mlcp_status mlcp_problem_body_remove(mlcp_problem *problem, int32_t body);

/* First velocity of a body in v and k, and its dimension; either pointer may be NULL. */
MLCP_API mlcp_status mlcp_problem_body_range(const mlcp_problem *problem, int32_t body, int32_t *offset, int32_t *dimension);

/* Ids of the bodies that there are, ascending. count is set to their number; ids may be NULL to ask for it; MLCP_ERROR_RANGE if
 * capacity is too small. */
MLCP_API mlcp_status mlcp_problem_bodies(const mlcp_problem *problem, int32_t capacity, int32_t *ids, int32_t *count);

/* Makes a body prescribed (static, kinematic, asleep): its velocity is given, `count` = its dimension doubles. Its columns
 * move into the right-hand side and it joins no islands; mlcp_solver_reaction reads the impulse on it. */
MLCP_API mlcp_status mlcp_problem_body_set_prescribed(mlcp_problem *problem, int32_t body, const double *velocity,
                                                      int32_t count);
MLCP_API mlcp_status mlcp_problem_body_set_dynamic(mlcp_problem *problem, int32_t body);

/* Whether a body is prescribed (1 or 0) and its given velocity, `count` = its dimension doubles, zeros for a dynamic body. Either
 * pointer may be NULL; count does not matter without velocity. */
MLCP_API mlcp_status mlcp_problem_body_state(const mlcp_problem *problem, int32_t body, int32_t *prescribed, int32_t count,
                                             double *velocity);

/* k, for velocities first .. first + count - 1. */
MLCP_API mlcp_status mlcp_problem_set_momentum(mlcp_problem *problem, int32_t first, int32_t count, const double *k);

/* Rows. Indices are dense in order of adding. */

typedef struct mlcp_rows {
  size_t struct_size;
  int32_t count;              /* number of rows */
  const int32_t *body_a;      /* count ids; NULL: all MLCP_WORLD */
  const int32_t *body_b;      /* count ids; NULL: all MLCP_WORLD; must differ from body_a unless both are the world */
  const double *jacobian_a;   /* per row dimension(body_a) doubles; may be NULL if all body_a are the world */
  const double *jacobian_b;   /* per row dimension(body_b) doubles */
  ptrdiff_t jacobian_a_stride; /* bytes from one row to the next; 0: packed one behind the other, the world taking none */
  ptrdiff_t jacobian_b_stride;
  const double *r;            /* NULL: 0 */
  const double *lo;           /* NULL: 0; -INFINITY is legal */
  const double *hi;           /* NULL: +INFINITY */
  const double *compliance;   /* diagonal of S; NULL: 0 */
  const uint64_t *key;        /* identity over time steps; NULL or 0: none */
  ptrdiff_t value_stride;     /* bytes between entries of r, lo, hi, compliance; 0: packed */
  ptrdiff_t body_stride;      /* bytes between entries of body_a, body_b; 0: packed */
  ptrdiff_t key_stride;       /* bytes between entries of key; 0: packed */
} mlcp_rows;

/* Single precision twin: r, lo, hi, compliance and Jacobians are floats, widened on the way in. */
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

/* Adds rows between bodies. first: index of the first one, may be NULL. All of a body's velocities become entries of the
 * row, explicit zeros included. */
MLCP_API mlcp_status mlcp_problem_rows_add(mlcp_problem *problem, const mlcp_rows *rows, int32_t *first);
MLCP_API mlcp_status mlcp_problem_rows_add_f32(mlcp_problem *problem, const mlcp_rows_f32 *rows, int32_t *first);

/* Adds one row over any velocities: `count` entries (columns[i], values[i]), columns index v. */
MLCP_API mlcp_status mlcp_problem_row_add(mlcp_problem *problem, int32_t count, const int32_t *columns, const double *values,
                                          double r, double lo, double hi, double compliance, uint64_t key, int32_t *index);

/* Adds `count` rows as compressed rows over the velocities: row_pointers has count + 1 entries and starts at 0. r, lo, hi,
 * compliance, key: count entries or NULL (0, 0, +INFINITY, 0, none). */
MLCP_API mlcp_status mlcp_problem_rows_add_csr(mlcp_problem *problem, int32_t count, const int32_t *row_pointers,
                                               const int32_t *columns, const double *values, const double *r,
                                               const double *lo, const double *hi, const double *compliance,
                                               const uint64_t *key, int32_t *first);

/* The same as compressed columns: column_pointers has n + 1 entries, row_indices in 0 .. count - 1. */
MLCP_API mlcp_status mlcp_problem_rows_add_csc(mlcp_problem *problem, int32_t count, const int32_t *column_pointers,
                                               const int32_t *row_indices, const double *values, const double *r,
                                               const double *lo, const double *hi, const double *compliance,
                                               const uint64_t *key, int32_t *first);

/* S as a whole, count x count with count = m, symmetric, replacing every compliance; both triangles or one. Diagonal entries >= 0
 * for rows with an entry of J, any finite value in a reduced problem. Rows added later have only their diagonal. The triangle is
 * that of compressed columns: whoever passes the lower triangle as compressed rows says MLCP_UPPER. */
MLCP_API mlcp_status mlcp_problem_set_compliance_matrix(mlcp_problem *problem, int32_t count, const int32_t *column_pointers,
                                                        const int32_t *row_indices, const double *values,
                                                        mlcp_triangle triangle);

/* Values in place, for rows first .. first + count - 1; the pattern stays and nothing is analyzed again. In set_bounds lo and hi
 * are both needed. set_jacobian takes the entries of one row in the order they were added (body_a's block, then
 * body_b's); count must match. set_compliance sets the diagonal. */
MLCP_API mlcp_status mlcp_problem_rows_set_r(mlcp_problem *problem, int32_t first, int32_t count, const double *r);
MLCP_API mlcp_status mlcp_problem_rows_set_bounds(mlcp_problem *problem, int32_t first, int32_t count, const double *lo,
                                                  const double *hi);
MLCP_API mlcp_status mlcp_problem_rows_set_compliance(mlcp_problem *problem, int32_t first, int32_t count,
                                                      const double *compliance);
MLCP_API mlcp_status mlcp_problem_rows_set_keys(mlcp_problem *problem, int32_t first, int32_t count, const uint64_t *keys);
MLCP_API mlcp_status mlcp_problem_row_set_jacobian(mlcp_problem *problem, int32_t row, const double *values, int32_t count);

/* Removes `count` different rows; those behind move up, their order stays. */
MLCP_API mlcp_status mlcp_problem_rows_remove(mlcp_problem *problem, int32_t count, const int32_t *rows);
/* Removes all rows; bodies stay. O(1). */
MLCP_API mlcp_status mlcp_problem_rows_clear(mlcp_problem *problem);

/* Contacts. A contact is a normal row, unilateral, and right behind it its tangent rows: one in the plane, two in space. They are
 * rows like all others (index, mask, key, impulse, slack); the contact adds a coefficient mu >= 0 and a model of friction:
 *
 *   NONE      the tangent rows are left out
 *   CONVEX    the impulse g lies in the cone |g_T| <= mu g_n or in a pyramid inside it, the slack in the dual cone (Anitescu 2006): cheap and
 *             convex, but a sliding contact opens by mu times its slip
 *   COULOMB   the same with mu |w_T| added to the slack of the normal (de Saxce & Feng 1998): Coulomb's law, g_T against the slip w_T
 *   BOX       fixed bounds: -bound <= g_T <= bound, each tangent row for itself
 *   FINDEX    the bounds follow the normal impulse, -mu g_n <= g_T <= mu g_n, as with the findex of ODE, Bullet and DART
 *
 * facets: 0 takes settings.facets; else the cone is the pyramid of that many generators n + mu (t1 cos a + t2 sin a), a = 2 pi j / facets,
 * which is in 3 .. 1048576 and of no effect in the plane, where the cone is a pyramid already. Facets are internal: a contact keeps its rows.
 * A mask that disables the normal row leaves the contact out; one that disables a tangent row leaves its friction out. */
typedef int32_t mlcp_friction;
enum {
  MLCP_FRICTION_NONE = 0,
  MLCP_FRICTION_CONVEX = 1,
  MLCP_FRICTION_COULOMB = 2,
  MLCP_FRICTION_BOX = 3,
  MLCP_FRICTION_FINDEX = 4
};

typedef struct mlcp_contacts {
  size_t struct_size;
  int32_t count;               /* number of contacts */
  int32_t dimension;           /* rows a contact: 2 in the plane, 3 in space (the default) */
  const int32_t *body_a;       /* count ids; NULL: all MLCP_WORLD */
  const int32_t *body_b;       /* count ids; NULL: all MLCP_WORLD */
  const double *jacobian_a;    /* per contact `dimension` rows of dimension(body_a) doubles, the normal first */
  const double *jacobian_b;
  ptrdiff_t jacobian_a_stride; /* bytes from one contact to the next; 0: packed, the world taking none */
  ptrdiff_t jacobian_b_stride;
  const double *r;             /* per contact `dimension` doubles; NULL: 0 */
  const double *compliance;    /* per contact `dimension` doubles; NULL: 0 */
  const double *mu;            /* coefficient of friction; NULL: 0 */
  const double *bound;         /* N.s, for MLCP_FRICTION_BOX; NULL: +INFINITY */
  const mlcp_friction *model;  /* NULL: MLCP_FRICTION_COULOMB */
  const int32_t *facets;       /* NULL: 0 */
  const uint64_t *key;         /* one a contact, taken by all its rows; NULL or 0: none */
  ptrdiff_t vector_stride;     /* bytes from one contact to the next in r and compliance; 0: packed */
  ptrdiff_t value_stride;      /* bytes between entries of mu, bound; 0: packed */
  ptrdiff_t choice_stride;     /* bytes between entries of model, facets; 0: packed */
  ptrdiff_t body_stride;       /* bytes between entries of body_a, body_b; 0: packed */
  ptrdiff_t key_stride;        /* bytes between entries of key; 0: packed */
} mlcp_contacts;

/* Single precision twin: Jacobians, r, compliance, mu and bound are floats, widened on the way in. */
typedef struct mlcp_contacts_f32 {
  size_t struct_size;
  int32_t count;
  int32_t dimension;
  const int32_t *body_a;
  const int32_t *body_b;
  const float *jacobian_a;
  const float *jacobian_b;
  ptrdiff_t jacobian_a_stride;
  ptrdiff_t jacobian_b_stride;
  const float *r;
  const float *compliance;
  const float *mu;
  const float *bound;
  const mlcp_friction *model;
  const int32_t *facets;
  const uint64_t *key;
  ptrdiff_t vector_stride;
  ptrdiff_t value_stride;
  ptrdiff_t choice_stride;
  ptrdiff_t body_stride;
  ptrdiff_t key_stride;
} mlcp_contacts_f32;

MLCP_API void mlcp_contacts_init(mlcp_contacts *contacts, size_t struct_size);
MLCP_API void mlcp_contacts_f32_init(mlcp_contacts_f32 *contacts, size_t struct_size);

/* Adds contacts and their rows, `dimension` rows a contact in order. first: index of the first row, may be NULL. Errors: as for rows; a
 * model that is none, mu < 0 or not finite, bound < 0, facets 1 or 2 in space. Removing some rows of a contact but not all is an error. */
MLCP_API mlcp_status mlcp_problem_contacts_add(mlcp_problem *problem, const mlcp_contacts *contacts, int32_t *first);
MLCP_API mlcp_status mlcp_problem_contacts_add_f32(mlcp_problem *problem, const mlcp_contacts_f32 *contacts, int32_t *first);

/* Makes contacts of rows that are there (added as CSR, or without entries for a reduced problem, where S is the Delassus matrix):
 * row[c] is the normal, with the bounds 0 and infinity, and rows row[c] + 1 .. row[c] + dimension - 1 are its tangents, whose bounds are
 * set as the model has them. row: count entries; model, mu, bound, facets: count entries or NULL, as in mlcp_contacts. */
MLCP_API mlcp_status mlcp_problem_contacts_declare(mlcp_problem *problem, int32_t count, int32_t dimension, const int32_t *row,
                                                   const mlcp_friction *model, const double *mu, const double *bound,
                                                   const int32_t *facets);

/* New friction of contacts first .. first + count - 1, counted in order of adding; NULL leaves what there is. */
MLCP_API mlcp_status mlcp_problem_contacts_set_friction(mlcp_problem *problem, int32_t first, int32_t count,
                                                        const mlcp_friction *model, const double *mu, const double *bound,
                                                        const int32_t *facets);

/* Number of contacts; 0 for NULL. */
MLCP_API int32_t mlcp_problem_contact_count(const mlcp_problem *problem);
/* Reading back: normal row, rows a contact, model, coefficient, facets. count = the number of contacts; any pointer may be NULL. */
MLCP_API mlcp_status mlcp_problem_get_contacts(const mlcp_problem *problem, int32_t count, int32_t *row, int32_t *dimension,
                                               mlcp_friction *model, double *mu, int32_t *facets);

/* The findex array of ODE, Bullet and DART, for rows first .. first + count - 1: findex[i] >= 0 makes lo and hi of row first + i factors
 * (finite, lo <= 0 <= hi) of the impulse of row findex[i]: lo g_n <= g <= hi g_n. -1: plain bounds. Errors: the row belongs to a
 * contact (whose model tells); findex[i] is the row itself or one whose bounds follow another. */
MLCP_API mlcp_status mlcp_problem_rows_set_findex(mlcp_problem *problem, int32_t first, int32_t count, const int32_t *findex);
/* Reading back: count = m entries. */
MLCP_API mlcp_status mlcp_problem_get_findex(const mlcp_problem *problem, int32_t count, int32_t *findex);

/* Reading back, into the caller's arrays of exactly the stated length: k n doubles; r, lo, hi, diagonal of S, keys m. Any pointer
 * may be NULL. */
MLCP_API mlcp_status mlcp_problem_get_momentum(const mlcp_problem *problem, int32_t count, double *k);
MLCP_API mlcp_status mlcp_problem_get_rows(const mlcp_problem *problem, int32_t count, double *r, double *lo, double *hi,
                                           double *compliance, uint64_t *key);

/* A sparse matrix that the problem lends: compressed rows of J; compressed columns of M and S with both triangles. In J
 * and M columns and rows are not sorted in general. Valid until the problem changes. */
typedef struct mlcp_matrix_view {
  size_t struct_size;
  int32_t rows;
  int32_t columns;
  int64_t entries;
  const int32_t *pointers; /* rows + 1 (J) or columns + 1 (M, S) */
  const int32_t *indices;  /* entries */
  const double *values;    /* entries */
} mlcp_matrix_view;

MLCP_API void mlcp_matrix_view_init(mlcp_matrix_view *view, size_t struct_size);
MLCP_API mlcp_status mlcp_problem_mass(const mlcp_problem *problem, mlcp_matrix_view *mass);
MLCP_API mlcp_status mlcp_problem_jacobian(const mlcp_problem *problem, mlcp_matrix_view *jacobian);
MLCP_API mlcp_status mlcp_problem_compliance(const mlcp_problem *problem, mlcp_matrix_view *compliance);

/* --------------------------------------------------------------------------------------------------- time stepping */

/* k = M v + h q for every body (paper (2.5)). v and q: n = count doubles, velocities and generalised forces at the start of
 * the step, the gyroscopic ones included; h > 0 in s. Prescribed bodies keep their velocity. */
MLCP_API mlcp_status mlcp_timestep_momentum(mlcp_problem *problem, double h, int32_t count, const double *v, const double *q);

/* r of `count` constraint rows (paper (2.5)): r_i = -(K/h) phi_i - phi_t_i. For a unilateral row with an open gap
 * (unilateral != 0 and phi_i >= 0) K = 1, so that the gap may close fully but not more; otherwise K = stabilisation in
 * 0..1. phi: constraint values in m; phi_t: their partial time derivative in m/s, NULL: 0. */
MLCP_API mlcp_status mlcp_timestep_rows(double h, double stabilisation, int32_t unilateral, int32_t count, const double *phi,
                                        const double *phi_t, double *r);

/* Newton's law of restitution for unilateral rows (Moreau 1988), after mlcp_timestep_rows: a row that closes within the step, phi_i + h rate_i
 * <= 0, faster than slowest, rate_i < -slowest, opens with at least e_i = restitution_i in 0..1 times that speed: r_i becomes
 * max(r_i, -e_i rate_i - phi_t_i); the others keep their r. rate: d phi / dt before the step in m/s, J v + phi_t; phi_t as above, NULL: 0;
 * slowest >= 0 in m/s, so that what bounces low comes to rest. All contacts obey the law at once: where balls touch in a row, the last one
 * does not take the whole blow as in Newton's cradle. r may be phi or rate. */
MLCP_API mlcp_status mlcp_timestep_restitution(double h, double slowest, int32_t count, const double *restitution, const double *phi,
                                               const double *rate, const double *phi_t, double *r);

/* A spring of stiffness s >= 0 (N/m) and damper d >= 0 (N.s/m), s and d not both 0, integrated implicitly over a step h:
 * compliance = 1 / (h (h s + d)), r = -s phi / (h s + d). */
MLCP_API mlcp_status mlcp_timestep_spring(double h, double stiffness, double damping, double phi, double *compliance,
                                          double *r);

/* The way of ODE and Bullet: compliance = cfm / h, r = -(erp / h) phi; cfm >= 0 as a compliance on forces, 0 <= erp <= 1. */
MLCP_API mlcp_status mlcp_timestep_erp_cfm(double h, double erp, double cfm, double phi, double *compliance, double *r);

/* ------------------------------------------------------------------------------------------------------------- mask */

/* One state a row: which rows are enabled, active, at which bound; with the keys of the rows it was made for. Of a contact with friction
 * the normal row is at lower (open) or active, its tangent rows are active (sticking) or at the bound that the slip drives them to. A mask
 * that a solve returned also keeps how contacts slip, so that the next solve starts there. */
typedef struct mlcp_mask mlcp_mask;

typedef uint8_t mlcp_row_state;
enum {
  MLCP_ROW_DISABLED = 0, /* not part of the problem: costs nothing, constrains nothing, impulse 0 */
  MLCP_ROW_AT_LOWER = 1, /* impulse at lo; for a contact: open */
  MLCP_ROW_ACTIVE = 2,   /* w = 0, impulse between the bounds */
  MLCP_ROW_AT_UPPER = 3  /* impulse at hi */
};

/* A mask of `count` rows, all in `state`, without keys. */
MLCP_API mlcp_status mlcp_mask_create(const mlcp_allocator *allocator, int32_t count, mlcp_row_state state, mlcp_mask **mask);
MLCP_API void mlcp_mask_destroy(mlcp_mask *mask);
/* A deep copy, with the allocator given. */
MLCP_API mlcp_status mlcp_mask_clone(const mlcp_allocator *allocator, const mlcp_mask *mask, mlcp_mask **copy);
MLCP_API const char *mlcp_mask_error(const mlcp_mask *mask);

MLCP_API int32_t mlcp_mask_size(const mlcp_mask *mask);
/* Makes the mask `count` rows long; new rows get `state`, no key. */
MLCP_API mlcp_status mlcp_mask_resize(mlcp_mask *mask, int32_t count, mlcp_row_state state);
MLCP_API mlcp_status mlcp_mask_set(mlcp_mask *mask, int32_t first, int32_t count, const mlcp_row_state *states);
MLCP_API mlcp_status mlcp_mask_get(const mlcp_mask *mask, int32_t first, int32_t count, mlcp_row_state *states);
/* mlcp_mask_size states, lent until the mask changes; NULL for NULL or an empty mask. */
MLCP_API const mlcp_row_state *mlcp_mask_states(const mlcp_mask *mask);
/* How many rows are in `state`. */
MLCP_API int32_t mlcp_mask_count(const mlcp_mask *mask, mlcp_row_state state);
/* 1 if both have the same states in the same order (keys do not matter), else 0. */
MLCP_API int32_t mlcp_mask_equal(const mlcp_mask *a, const mlcp_mask *b);

/* Impulses that go with the states, in N.s: where an iterative method starts. A mask that a solve returns has them; mlcp_mask_carry carries them
 * too. get: MLCP_ERROR_STATE if the mask has none. set: rows outside the range get 0 if the mask had none. */
MLCP_API mlcp_status mlcp_mask_set_impulses(mlcp_mask *mask, int32_t first, int32_t count, const double *impulses);
MLCP_API mlcp_status mlcp_mask_get_impulses(const mlcp_mask *mask, int32_t first, int32_t count, double *impulses);

/* Takes the keys of the problem's rows; the sizes must match. */
MLCP_API mlcp_status mlcp_mask_take_keys(mlcp_mask *mask, const mlcp_problem *problem);

/* Fills `mask` for the rows of `problem` from the states and impulses that rows with the same key had in `previous`; rows with a new key
 * or none get `otherwise` and 0. Equal keys match in order of adding. Expected O(m). */
MLCP_API mlcp_status mlcp_mask_carry(mlcp_mask *mask, const mlcp_problem *problem, const mlcp_mask *previous,
                                     mlcp_row_state otherwise);

/* ----------------------------------------------------------------------------------------------------------- solver */

/* Settings, ordering, factor, results and history. */
typedef struct mlcp_solver mlcp_solver;

typedef int32_t mlcp_method;
enum {
  MLCP_METHOD_AUTO = 0,    /* the library chooses, island by island */
  MLCP_METHOD_SIMPLEX = 1, /* the paper's method, section 3: exact, finite, one row at a time; where M is only semidefinite, proximal steps
                              around it */
  MLCP_METHOD_NEWTON = 2,  /* many rows at a time: primal-dual active set, proximal with line search where needed; exact; falls back on
                              the simplex */
  MLCP_METHOD_PGS = 3      /* projected Gauss-Seidel, for low accuracy: set a tolerance that it can reach. Islands whose mass couples more than
                              64 velocities are solved by newton */
};
MLCP_API const char *mlcp_method_text(mlcp_method method);

typedef int32_t mlcp_pivot_rule;
enum {
  MLCP_PIVOT_DUAL = 0,   /* only impulses that reach a bound block; the row with the largest |w|/sqrt(a) enters */
  MLCP_PIVOT_PRINTED = 1 /* the paper's pseudocode, mended: satisfied rows that would become violated block too */
};

typedef int32_t mlcp_refactorize;
enum {
  MLCP_REFACTORIZE_WHEN_NEEDED = 0, /* row toggles; afresh when the factor has drifted or a batch is cheaper so */
  MLCP_REFACTORIZE_ALWAYS = 1       /* afresh at every pivot, as the historical code did: to compare */
};

/* Which impulses, where dependent rows leave a choice; v is the same for all. */
typedef int32_t mlcp_impulses;
enum {
  MLCP_IMPULSES_ANY = 0,       /* those that the method ends with */
  MLCP_IMPULSES_LEAST_NORM = 1 /* the least sum of a_i g_i^2, a as in the report: table legs carry equal loads; a second solve on such islands */
};

/* Fork and join over independent islands: calls task(data, index, worker) once for every index in 0 .. count - 1, on any threads in any
 * order, and returns when all are done. worker: 0 .. on the caller's side, one per thread at a time. task may not be called afterwards. */
typedef void (*mlcp_task)(void *data, int32_t index, int32_t worker);
typedef void (*mlcp_parallel_for)(void *context, int32_t count, mlcp_task task, void *data);

typedef struct mlcp_progress {
  size_t struct_size;
  double seconds;
  int64_t pivots;
  int64_t work;          /* entries touched so far in this island; pivots too */
  int32_t island;        /* index of the island being solved */
  int32_t islands;
  double violation;      /* largest violation in this island, relative as in the report */
} mlcp_progress;

/* Called now and then on the thread that called mlcp_solve, for the islands that it works on; return 0 to go on, anything else to stop all
 * islands with MLCP_INTERRUPTED. Must not call into the same solver. */
typedef int32_t (*mlcp_progress_callback)(void *context, const mlcp_progress *progress);

typedef struct mlcp_settings {
  size_t struct_size;
  mlcp_method method;            /* AUTO */
  mlcp_pivot_rule pivot_rule;    /* DUAL */
  mlcp_refactorize refactorize;  /* WHEN_NEEDED */
  int32_t trace;                 /* != 0: record every pivot; 0 */
  double tolerance;              /* 1e-9, on the largest relative error of the report; > 0 */
  int64_t max_iterations;        /* an island: pivots, Newton steps or sweeps; 0: 50 (rows + 10) */
  int64_t max_work;              /* entries touched, an island; 0: no limit. The same everywhere, unlike seconds. */
  double max_seconds;            /* 0: no limit */
  mlcp_progress_callback progress; /* NULL: none */
  void *progress_context;
  mlcp_impulses impulses;        /* ANY */
  int32_t canonical;             /* != 0: the answer is computed anew from its active set, so that warm and cold starts and all exact methods give the
                                    same bits where active rows are independent and none is at zero by accident; one more analysis and factorization; 0 */
  int32_t warm_start;            /* != 0: without a start mask, rows with keys start where the last solve left rows with the same key, and the
                                  * elimination order of the last analysis is carried over to rows that came and went; 0: bits do not
                                  * depend on what was solved before; 1 */
  int32_t num_threads;           /* that solve islands, the caller's among them; 0: one a CPU; 1. The bits do not depend on it. */
  mlcp_parallel_for parallel_for; /* the caller's threads instead of ours; NULL: none */
  void *parallel_context;
  int32_t facets;                /* of contacts that do not say; 0: the circular cone, by generators aimed at the slip until its error
                                    is within the tolerance; else 3 .. 1048576 */
  int32_t max_shifts;            /* solves of the iteration for friction; 0: 300 */
} mlcp_settings;

MLCP_API void mlcp_settings_init(mlcp_settings *settings, size_t struct_size);

/* settings, allocator: NULL for the defaults. On a bad setting *solver stays NULL and the status tells. */
MLCP_API mlcp_status mlcp_solver_create(const mlcp_settings *settings, const mlcp_allocator *allocator, mlcp_solver **solver);
MLCP_API void mlcp_solver_destroy(mlcp_solver *solver);
/* New settings; the analysis and the results stay. */
MLCP_API mlcp_status mlcp_solver_set_settings(mlcp_solver *solver, const mlcp_settings *settings);
MLCP_API mlcp_status mlcp_solver_get_settings(const mlcp_solver *solver, mlcp_settings *settings);
MLCP_API const char *mlcp_solver_error(const mlcp_solver *solver);
MLCP_API mlcp_status mlcp_solver_trim(mlcp_solver *solver);

typedef struct mlcp_report {
  size_t struct_size;
  mlcp_outcome outcome;          /* the worst over the islands */
  mlcp_method method;            /* the one that ran; AUTO: several did */
  /* errors recomputed from the problem's own numbers, rows left out by `enabled` excepted; not finite: INFINITY */
  double momentum_error;         /* max |Mv - J'g - k|_i / (|M||v| + |J|'|g| + |k|)_i over dynamic velocities */
  double constraint_error;       /* max |median(w, a(g - lo), a(g - hi))|_i / (|J|(|v| + |v0|) + |S||g| + |r|)_i,
                                    a = sum J^2/M_jj + S_ii, v0 = k/M_jj, with 1 for an M_jj of 0 */
  double largest_error;          /* the larger of the two */
  double momentum_residual;      /* max |Mv - J'g - k|_i in N.s */
  double constraint_residual;    /* max |median(w, a(g - lo), a(g - hi))|_i in m/s */
  int32_t worst_velocity;        /* where momentum_error is, -1 if n = 0; NOT_POSITIVE_DEFINITE: whose pivot failed */
  int32_t worst_row;             /* where constraint_error is, -1 if there is none */
  int32_t worst_body;            /* NOT_POSITIVE_DEFINITE: the body whose mass is not; else -1. Row for a reduced problem. */
  int32_t islands;               /* connected components of dynamic bodies and enabled rows */
  int32_t islands_failed;        /* of them not solved */
  int32_t enabled_rows;
  int32_t active_rows;
  int32_t redundant_rows;
  int64_t pivots;                /* steps of the simplex, Newton steps, sweeps of Gauss-Seidel */
  int64_t toggles;               /* rows taken into or out of the factor along the elimination tree */
  int64_t factorizations;
  int64_t refinements;           /* steps of iterative refinement */
  int64_t work;                  /* entries of L, J and M touched */
  int64_t factor_entries;        /* below the diagonal of L, every enabled row in */
  double seconds;                /* all of the following, wall clock */
  double seconds_analyze;        /* 0 if the pattern was known */
  double seconds_factorize;
  double seconds_solve;
  double seconds_report;         /* measuring the errors */
  int32_t analyzed;              /* 1 if this solve had to analyze */
  int32_t refactorized_for_drift;
  int32_t warm;                  /* 1 if it started from a mask, given or found by keys */
  int32_t fallbacks;             /* islands that newton or pgs gave up and another method solved */
  /* contacts with friction; all 0 where there is none */
  double cone_error;             /* largest over CONVEX and COULOMB contacts: of a dist(g, K), dist(w, K*), |g.w|/|g|, w with the Coulomb
                                    shift mu max(-d.w_T), a their mean, over the largest of the contact's scales in constraint_error; part
                                    of largest_error. Their rows are not in constraint_error; rows with findex are, by the bounds that
                                    their normal impulse gives. */
  double cone_residual;          /* the same in m/s */
  int32_t worst_contact;         /* where cone_error is, -1 if there is none */
  int32_t contacts_open;
  int32_t contacts_sticking;
  int32_t contacts_sliding;
  int32_t generators;            /* rows that stand for cones in the solves */
  int32_t facets;                /* most generators that one contact needed, those aimed anew included */
  int32_t shift_iterations;      /* solves of the iteration for friction */
  int32_t islands_by_lemke;      /* islands that the finite fallback solved */
} mlcp_report;

MLCP_API void mlcp_report_init(mlcp_report *report, size_t struct_size);

/* Orders and analyzes the pattern of the problem with the enabled rows (NULL: all), so that a solve need not. */
MLCP_API mlcp_status mlcp_analyze(mlcp_solver *solver, const mlcp_problem *problem, const mlcp_mask *enabled);

/* Solves. enabled: rows in state MLCP_ROW_DISABLED are left out; NULL: all rows count. start: the active set to start from,
 * e.g. the mask of the last step carried over; any will do; NULL: what settings.warm_start finds by the rows' keys, else bilateral rows
 * only. Both must be m long. The outcome is in the report (may be NULL); the status only says whether the call could be made. Analysis is
 * repeated only when the pattern differs from the last one or rows are enabled that were not; then rows whose keys or bodies are known
 * keep their places in the elimination order while that is as good as it was. */
MLCP_API mlcp_status mlcp_solve(mlcp_solver *solver, const mlcp_problem *problem, const mlcp_mask *enabled,
                                const mlcp_mask *start, mlcp_report *report);

/* Results of the last solve, lent until the solver's next non-const call. MLCP_ERROR_STATE before the first one. Prescribed
 * bodies have their given velocity in v; disabled rows have impulse 0. */
MLCP_API mlcp_status mlcp_solver_velocities(const mlcp_solver *solver, const double **v, int32_t *count);
MLCP_API mlcp_status mlcp_solver_impulses(const mlcp_solver *solver, const double **gamma, int32_t *count);
MLCP_API mlcp_status mlcp_solver_slacks(const mlcp_solver *solver, const double **w, int32_t *count);
/* States and keys of the rows at the end: the start of the next step. */
MLCP_API mlcp_status mlcp_solver_mask(const mlcp_solver *solver, const mlcp_mask **mask);
/* 1 for rows found dependent on active ones: not factored (their impulse is at a bound or 0) or, by newton, sharing the load with
 * them. None is looked for in an island that a limit of work or time or the progress callback stopped. */
MLCP_API mlcp_status mlcp_solver_redundant(const mlcp_solver *solver, const uint8_t **redundant, int32_t *count);
/* Copies in single precision; entries stride_bytes apart (0: packed). */
MLCP_API mlcp_status mlcp_solver_read_velocities_f32(const mlcp_solver *solver, int32_t count, float *v, ptrdiff_t stride_bytes);
MLCP_API mlcp_status mlcp_solver_read_impulses_f32(const mlcp_solver *solver, int32_t count, float *gamma, ptrdiff_t stride_bytes);

/* Per contact, in order of adding: what it does and how many generators of its cone were tried (0 where it has none). */
typedef uint8_t mlcp_contact_state;
enum {
  MLCP_CONTACT_DISABLED = 0, /* its normal row is left out */
  MLCP_CONTACT_OPEN = 1,     /* no impulse */
  MLCP_CONTACT_STICKING = 2, /* w_T = 0 */
  MLCP_CONTACT_SLIDING = 3   /* w_T != 0, the impulse at the limit of friction */
};
MLCP_API mlcp_status mlcp_solver_contact_states(const mlcp_solver *solver, const mlcp_contact_state **state, int32_t *count);
MLCP_API mlcp_status mlcp_solver_contact_facets(const mlcp_solver *solver, const int32_t **facets, int32_t *count);

/* The impulse that a prescribed body needs to keep its velocity, (M v - k - J' g) on its velocities; count = dimension. */
MLCP_API mlcp_status mlcp_solver_reaction(const mlcp_solver *solver, const mlcp_problem *problem, int32_t body, int32_t count,
                                          double *reaction);

/* Per row its island, -1 for disabled rows; per island its outcome. */
MLCP_API mlcp_status mlcp_solver_row_islands(const mlcp_solver *solver, const int32_t **island, int32_t *count);
MLCP_API mlcp_status mlcp_solver_island_outcomes(const mlcp_solver *solver, const mlcp_outcome **outcome, int32_t *count);

/* Farkas certificate of an infeasible island (-1: the first one): rows that conflict and their multipliers y, with J'y = 0 and
 * S y = 0 on dynamic velocities to 1e-12 relative, y > 0 only where hi is infinite, y < 0 only where lo is, and r'y > 0 after
 * moving prescribed velocities and fixed impulses into r. MLCP_ERROR_STATE when there is none. */
MLCP_API mlcp_status mlcp_solver_certificate(const mlcp_solver *solver, int32_t island, const int32_t **rows, const double **y,
                                             int32_t *count);

/* Pattern of L of the last analysis, every enabled row in: K = [M J'; J -S] in elimination order. What couples to nothing is not in it.
 * Positions count from 0; the first entry of a column is its parent in the elimination tree, and an island is a range of
 * positions that ends with a column without entries. Lent until the solver's next non-const call. */
typedef struct mlcp_factor_view {
  size_t struct_size;
  int32_t size;            /* positions */
  int64_t entries;         /* below the diagonal */
  const int32_t *nodes;    /* size; what stands at a position: velocity j as j, row i as n + i */
  const int64_t *pointers; /* size + 1; compressed columns */
  const int32_t *rows;     /* entries; positions, ascending in each column */
} mlcp_factor_view;

MLCP_API void mlcp_factor_view_init(mlcp_factor_view *view, size_t struct_size);
/* That of the last analysis. MLCP_ERROR_STATE where there is none: before the first mlcp_analyze or mlcp_solve, after mlcp_solver_trim, and as long as
 * AUTO has met small islands alone, which it solves without. */
MLCP_API mlcp_status mlcp_solver_factor(const mlcp_solver *solver, mlcp_factor_view *factor);

/* One step of the method, recorded when settings.trace is set. */
typedef struct mlcp_pivot {
  int32_t island;
  int32_t entering;  /* row whose violation drives the step */
  int32_t blocking;  /* row that stopped it; entering itself when it reached w = 0 or its far bound; -1: nothing did */
  mlcp_row_state to; /* new state of the blocking row */
  uint8_t dependent; /* 1: entering depends on active rows, the step is along impulses only */
  double step;       /* change of the entering impulse */
  double violation;  /* w of the entering row before the step */
  double schur;      /* its Schur pivot relative to a */
} mlcp_pivot;
MLCP_API mlcp_status mlcp_solver_trace(const mlcp_solver *solver, const mlcp_pivot **pivots, int64_t *count);

/* --------------------------------------------------------------------------------------------------------- snapshot */

/* All four: message, NULL or message_size bytes, gets the cause of a failure (the file and what the system says of it, or the
 * part of the snapshot, argument and index), "" when there is none; cut to fit and always terminated, whole in 512 bytes. */

/* A file that holds problem, settings, enabled mask, start and ordering, and replays to the same bits with the same build. Little
 * endian, compressed, with checksum; written beside the target and renamed, so that a full disk leaves an old file as it was. solver:
 * gives settings and ordering, and without a start mask the start that its last solve found by keys; NULL for the defaults; masks may be NULL. */
MLCP_API mlcp_status mlcp_snapshot_save(const char *path, const mlcp_problem *problem, const mlcp_solver *solver,
                                        const mlcp_mask *enabled, const mlcp_mask *start, char *message, size_t message_size);
/* The same as bytes: size is set to what is needed; buffer may be NULL to ask for it; MLCP_ERROR_RANGE if capacity is too small. */
MLCP_API mlcp_status mlcp_snapshot_write(const mlcp_problem *problem, const mlcp_solver *solver, const mlcp_mask *enabled,
                                         const mlcp_mask *start, size_t capacity, void *buffer, size_t *size, char *message,
                                         size_t message_size);
/* Makes new objects; each output may be NULL if not wanted; masks that were not saved come back NULL. Files are not trusted: everything
 * is validated as if it were added by calls. */
MLCP_API mlcp_status mlcp_snapshot_load(const char *path, const mlcp_allocator *allocator, mlcp_problem **problem,
                                        mlcp_solver **solver, mlcp_mask **enabled, mlcp_mask **start, char *message,
                                        size_t message_size);
MLCP_API mlcp_status mlcp_snapshot_read(const void *bytes, size_t size, const mlcp_allocator *allocator,
                                        mlcp_problem **problem, mlcp_solver **solver, mlcp_mask **enabled, mlcp_mask **start,
                                        char *message, size_t message_size);

/* From now on every solve that ends with another outcome than MLCP_SOLVED leaves a snapshot in `folder`, which must be there: files
 * failure-0000.mlcp, failure-0001.mlcp and so on, each whole or not there at all, never over another one, until `limit` (0 .. 10000) of them
 * are there, whoever made them. Replaying one gives the outcome again, to the same bits unless it hung on the clock or the progress callback.
 * folder NULL: no longer. A new solver begins with the folder in the environment variable MLCP_FAILURES and the limit in
 * MLCP_FAILURES_LIMIT (10), if set. A file that cannot be written is no failure of the solve; it costs what mlcp_snapshot_save does, memory
 * included. */
MLCP_API mlcp_status mlcp_solver_keep_failures(mlcp_solver *solver, const char *folder, int32_t limit);
/* The file that the last solve left so, "" if none; never NULL; lent until the next solve. */
MLCP_API const char *mlcp_solver_failure_file(const mlcp_solver *solver);

#ifdef __cplusplus
}
#endif

#endif
