"""What the extension uses of mlcp.h."""
from libc.stddef cimport ptrdiff_t
from libc.stdint cimport int32_t, int64_t, uint8_t, uint64_t

cdef extern from "mlcp.h" nogil:
    enum:
        MLCP_ABI_VERSION
        MLCP_WORLD
    int32_t mlcp_abi_version()
    const char *mlcp_version()

    ctypedef int32_t mlcp_status
    enum:
        MLCP_OK
        MLCP_ERROR_NULL
        MLCP_ERROR_ARGUMENT
        MLCP_ERROR_RANGE
        MLCP_ERROR_STATE
        MLCP_ERROR_OUT_OF_MEMORY
        MLCP_ERROR_IO
        MLCP_ERROR_FORMAT
        MLCP_ERROR_UNSUPPORTED
        MLCP_ERROR_INTERNAL
    const char *mlcp_status_text(mlcp_status)

    ctypedef int32_t mlcp_outcome
    enum:
        MLCP_SOLVED
        MLCP_INFEASIBLE
    const char *mlcp_outcome_text(mlcp_outcome)

    ctypedef struct mlcp_problem:
        pass
    ctypedef struct mlcp_mask:
        pass
    ctypedef struct mlcp_solver:
        pass
    ctypedef struct mlcp_allocator:
        pass

    # problem
    mlcp_status mlcp_problem_create(const mlcp_allocator *, mlcp_problem **)
    void mlcp_problem_destroy(mlcp_problem *)
    mlcp_status mlcp_problem_clone(const mlcp_problem *, mlcp_problem **)
    const char *mlcp_problem_error(const mlcp_problem *)
    int32_t mlcp_problem_velocity_count(const mlcp_problem *)
    int32_t mlcp_problem_row_count(const mlcp_problem *)
    int32_t mlcp_problem_body_count(const mlcp_problem *)
    int64_t mlcp_problem_entry_count(const mlcp_problem *)
    mlcp_status mlcp_problem_reserve(mlcp_problem *, int32_t, int32_t, int32_t, int64_t)
    mlcp_status mlcp_problem_trim(mlcp_problem *)
    mlcp_status mlcp_problem_clear(mlcp_problem *)

    ctypedef int32_t mlcp_triangle
    enum:
        MLCP_FULL
        MLCP_LOWER
        MLCP_UPPER
    mlcp_status mlcp_problem_bodies_add(mlcp_problem *, int32_t, int32_t, const double *, ptrdiff_t, int32_t *)
    mlcp_status mlcp_problem_body_add_sparse(mlcp_problem *, int32_t, const int32_t *, const int32_t *, const double *,
                                             mlcp_triangle, int32_t *)
    mlcp_status mlcp_problem_body_set_mass(mlcp_problem *, int32_t, const double *, int64_t)
    mlcp_status mlcp_problem_body_remove(mlcp_problem *, int32_t)
    mlcp_status mlcp_problem_body_range(const mlcp_problem *, int32_t, int32_t *, int32_t *)
    mlcp_status mlcp_problem_bodies(const mlcp_problem *, int32_t, int32_t *, int32_t *)
    mlcp_status mlcp_problem_body_set_prescribed(mlcp_problem *, int32_t, const double *, int32_t)
    mlcp_status mlcp_problem_body_set_dynamic(mlcp_problem *, int32_t)
    mlcp_status mlcp_problem_body_state(const mlcp_problem *, int32_t, int32_t *, int32_t, double *)
    mlcp_status mlcp_problem_set_momentum(mlcp_problem *, int32_t, int32_t, const double *)

    ctypedef struct mlcp_rows:
        size_t struct_size
        int32_t count
        const int32_t *body_a
        const int32_t *body_b
        const double *jacobian_a
        const double *jacobian_b
        ptrdiff_t jacobian_a_stride
        ptrdiff_t jacobian_b_stride
        const double *r
        const double *lo
        const double *hi
        const double *compliance
        const uint64_t *key
    void mlcp_rows_init(mlcp_rows *, size_t)
    mlcp_status mlcp_problem_rows_add(mlcp_problem *, const mlcp_rows *, int32_t *)
    mlcp_status mlcp_problem_row_add(mlcp_problem *, int32_t, const int32_t *, const double *, double, double, double, double,
                                     uint64_t, int32_t *)
    mlcp_status mlcp_problem_rows_add_csr(mlcp_problem *, int32_t, const int32_t *, const int32_t *, const double *,
                                          const double *, const double *, const double *, const double *, const uint64_t *,
                                          int32_t *)
    mlcp_status mlcp_problem_rows_add_csc(mlcp_problem *, int32_t, const int32_t *, const int32_t *, const double *,
                                          const double *, const double *, const double *, const double *, const uint64_t *,
                                          int32_t *)
    mlcp_status mlcp_problem_set_compliance_matrix(mlcp_problem *, int32_t, const int32_t *, const int32_t *, const double *,
                                                   mlcp_triangle)
    mlcp_status mlcp_problem_rows_set_r(mlcp_problem *, int32_t, int32_t, const double *)
    mlcp_status mlcp_problem_rows_set_bounds(mlcp_problem *, int32_t, int32_t, const double *, const double *)
    mlcp_status mlcp_problem_rows_set_compliance(mlcp_problem *, int32_t, int32_t, const double *)
    mlcp_status mlcp_problem_rows_set_keys(mlcp_problem *, int32_t, int32_t, const uint64_t *)
    mlcp_status mlcp_problem_row_set_jacobian(mlcp_problem *, int32_t, const double *, int32_t)
    mlcp_status mlcp_problem_rows_remove(mlcp_problem *, int32_t, const int32_t *)
    mlcp_status mlcp_problem_rows_clear(mlcp_problem *)
    # contacts
    ctypedef int32_t mlcp_friction
    enum:
        MLCP_FRICTION_NONE
        MLCP_FRICTION_CONVEX
        MLCP_FRICTION_COULOMB
        MLCP_FRICTION_BOX
        MLCP_FRICTION_FINDEX
    ctypedef struct mlcp_contacts:
        size_t struct_size
        int32_t count
        int32_t dimension
        const int32_t *body_a
        const int32_t *body_b
        const double *jacobian_a
        const double *jacobian_b
        ptrdiff_t jacobian_a_stride
        ptrdiff_t jacobian_b_stride
        const double *r
        const double *compliance
        const double *mu
        const double *bound
        const mlcp_friction *model
        const int32_t *facets
        const uint64_t *key
    void mlcp_contacts_init(mlcp_contacts *, size_t)
    mlcp_status mlcp_problem_contacts_add(mlcp_problem *, const mlcp_contacts *, int32_t *)
    mlcp_status mlcp_problem_contacts_declare(mlcp_problem *, int32_t, int32_t, const int32_t *, const mlcp_friction *,
                                              const double *, const double *, const int32_t *)
    mlcp_status mlcp_problem_contacts_set_friction(mlcp_problem *, int32_t, int32_t, const mlcp_friction *, const double *,
                                                   const double *, const int32_t *)
    int32_t mlcp_problem_contact_count(const mlcp_problem *)
    mlcp_status mlcp_problem_get_contacts(const mlcp_problem *, int32_t, int32_t *, int32_t *, mlcp_friction *, double *, int32_t *)
    mlcp_status mlcp_problem_rows_set_findex(mlcp_problem *, int32_t, int32_t, const int32_t *)
    mlcp_status mlcp_problem_get_findex(const mlcp_problem *, int32_t, int32_t *)

    mlcp_status mlcp_problem_get_momentum(const mlcp_problem *, int32_t, double *)
    mlcp_status mlcp_problem_get_rows(const mlcp_problem *, int32_t, double *, double *, double *, double *, uint64_t *)

    ctypedef struct mlcp_matrix_view:
        size_t struct_size
        int32_t rows
        int32_t columns
        int64_t entries
        const int32_t *pointers
        const int32_t *indices
        const double *values
    void mlcp_matrix_view_init(mlcp_matrix_view *, size_t)
    mlcp_status mlcp_problem_mass(const mlcp_problem *, mlcp_matrix_view *)
    mlcp_status mlcp_problem_jacobian(const mlcp_problem *, mlcp_matrix_view *)
    mlcp_status mlcp_problem_compliance(const mlcp_problem *, mlcp_matrix_view *)

    # time stepping
    mlcp_status mlcp_timestep_momentum(mlcp_problem *, double, int32_t, const double *, const double *)
    mlcp_status mlcp_timestep_rows(double, double, int32_t, int32_t, const double *, const double *, double *)
    mlcp_status mlcp_timestep_restitution(double, double, int32_t, const double *, const double *, const double *, const double *, double *)
    mlcp_status mlcp_timestep_spring(double, double, double, double, double *, double *)
    mlcp_status mlcp_timestep_erp_cfm(double, double, double, double, double *, double *)

    # mask
    ctypedef uint8_t mlcp_row_state
    enum:
        MLCP_ROW_DISABLED
        MLCP_ROW_AT_LOWER
        MLCP_ROW_ACTIVE
        MLCP_ROW_AT_UPPER
    mlcp_status mlcp_mask_create(const mlcp_allocator *, int32_t, mlcp_row_state, mlcp_mask **)
    void mlcp_mask_destroy(mlcp_mask *)
    mlcp_status mlcp_mask_clone(const mlcp_allocator *, const mlcp_mask *, mlcp_mask **)
    const char *mlcp_mask_error(const mlcp_mask *)
    int32_t mlcp_mask_size(const mlcp_mask *)
    mlcp_status mlcp_mask_resize(mlcp_mask *, int32_t, mlcp_row_state)
    mlcp_status mlcp_mask_set(mlcp_mask *, int32_t, int32_t, const mlcp_row_state *)
    const mlcp_row_state *mlcp_mask_states(const mlcp_mask *)
    int32_t mlcp_mask_count(const mlcp_mask *, mlcp_row_state)
    int32_t mlcp_mask_equal(const mlcp_mask *, const mlcp_mask *)
    mlcp_status mlcp_mask_set_impulses(mlcp_mask *, int32_t, int32_t, const double *)
    mlcp_status mlcp_mask_get_impulses(const mlcp_mask *, int32_t, int32_t, double *)
    mlcp_status mlcp_mask_take_keys(mlcp_mask *, const mlcp_problem *)
    mlcp_status mlcp_mask_carry(mlcp_mask *, const mlcp_problem *, const mlcp_mask *, mlcp_row_state)

    # solver
    ctypedef int32_t mlcp_method
    enum:
        MLCP_METHOD_AUTO
        MLCP_METHOD_SIMPLEX
        MLCP_METHOD_NEWTON
        MLCP_METHOD_PGS
    const char *mlcp_method_text(mlcp_method)
    ctypedef int32_t mlcp_pivot_rule
    enum:
        MLCP_PIVOT_DUAL
        MLCP_PIVOT_PRINTED
    ctypedef int32_t mlcp_refactorize
    enum:
        MLCP_REFACTORIZE_WHEN_NEEDED
        MLCP_REFACTORIZE_ALWAYS
    ctypedef int32_t mlcp_impulses
    enum:
        MLCP_IMPULSES_ANY
        MLCP_IMPULSES_LEAST_NORM

    ctypedef struct mlcp_progress:
        double seconds
        int64_t pivots
        int64_t work
        int32_t island
        int32_t islands
        double violation
    ctypedef int32_t (*mlcp_progress_callback)(void *, const mlcp_progress *) noexcept
    ctypedef void (*mlcp_task)(void *, int32_t, int32_t) noexcept
    ctypedef void (*mlcp_parallel_for)(void *, int32_t, mlcp_task, void *) noexcept
    ctypedef struct mlcp_settings:
        size_t struct_size
        mlcp_method method
        mlcp_pivot_rule pivot_rule
        mlcp_refactorize refactorize
        int32_t trace
        double tolerance
        int64_t max_iterations
        int64_t max_work
        double max_seconds
        mlcp_progress_callback progress
        void *progress_context
        mlcp_impulses impulses
        int32_t canonical
        int32_t warm_start
        int32_t num_threads
        mlcp_parallel_for parallel_for
        void *parallel_context
        int32_t facets
        int32_t max_shifts
    void mlcp_settings_init(mlcp_settings *, size_t)
    mlcp_status mlcp_solver_create(const mlcp_settings *, const mlcp_allocator *, mlcp_solver **)
    void mlcp_solver_destroy(mlcp_solver *)
    mlcp_status mlcp_solver_set_settings(mlcp_solver *, const mlcp_settings *)
    mlcp_status mlcp_solver_get_settings(const mlcp_solver *, mlcp_settings *)
    const char *mlcp_solver_error(const mlcp_solver *)
    mlcp_status mlcp_solver_trim(mlcp_solver *)
    mlcp_status mlcp_solver_keep_failures(mlcp_solver *, const char *, int32_t)
    const char *mlcp_solver_failure_file(const mlcp_solver *)

    ctypedef struct mlcp_report:
        size_t struct_size
        mlcp_outcome outcome
        mlcp_method method
        double momentum_error
        double constraint_error
        double largest_error
        double momentum_residual
        double constraint_residual
        int32_t worst_velocity
        int32_t worst_row
        int32_t worst_body
        int32_t islands
        int32_t islands_failed
        int32_t enabled_rows
        int32_t active_rows
        int32_t redundant_rows
        int64_t pivots
        int64_t toggles
        int64_t factorizations
        int64_t refinements
        int64_t work
        int64_t factor_entries
        double seconds
        double seconds_analyze
        double seconds_factorize
        double seconds_solve
        double seconds_report
        int32_t analyzed
        int32_t refactorized_for_drift
        int32_t warm
        int32_t fallbacks
        double cone_error
        double cone_residual
        int32_t worst_contact
        int32_t contacts_open
        int32_t contacts_sticking
        int32_t contacts_sliding
        int32_t generators
        int32_t facets
        int32_t shift_iterations
        int32_t islands_by_lemke
    void mlcp_report_init(mlcp_report *, size_t)
    mlcp_status mlcp_analyze(mlcp_solver *, const mlcp_problem *, const mlcp_mask *)
    mlcp_status mlcp_solve(mlcp_solver *, const mlcp_problem *, const mlcp_mask *, const mlcp_mask *, mlcp_report *)
    mlcp_status mlcp_solver_velocities(const mlcp_solver *, const double **, int32_t *)
    mlcp_status mlcp_solver_impulses(const mlcp_solver *, const double **, int32_t *)
    mlcp_status mlcp_solver_slacks(const mlcp_solver *, const double **, int32_t *)
    mlcp_status mlcp_solver_mask(const mlcp_solver *, const mlcp_mask **)
    mlcp_status mlcp_solver_redundant(const mlcp_solver *, const uint8_t **, int32_t *)
    ctypedef uint8_t mlcp_contact_state
    mlcp_status mlcp_solver_contact_states(const mlcp_solver *, const mlcp_contact_state **, int32_t *)
    mlcp_status mlcp_solver_contact_facets(const mlcp_solver *, const int32_t **, int32_t *)
    mlcp_status mlcp_solver_reaction(const mlcp_solver *, const mlcp_problem *, int32_t, int32_t, double *)
    mlcp_status mlcp_solver_row_islands(const mlcp_solver *, const int32_t **, int32_t *)
    mlcp_status mlcp_solver_island_outcomes(const mlcp_solver *, const mlcp_outcome **, int32_t *)
    mlcp_status mlcp_solver_certificate(const mlcp_solver *, int32_t, const int32_t **, const double **, int32_t *)
    ctypedef struct mlcp_factor_view:
        size_t struct_size
        int32_t size
        int64_t entries
        const int32_t *nodes
        const int64_t *pointers
        const int32_t *rows
    void mlcp_factor_view_init(mlcp_factor_view *, size_t)
    mlcp_status mlcp_solver_factor(const mlcp_solver *, mlcp_factor_view *)
    ctypedef struct mlcp_pivot:
        int32_t island
        int32_t entering
        int32_t blocking
        mlcp_row_state to
        uint8_t dependent
        double step
        double violation
        double schur
    mlcp_status mlcp_solver_trace(const mlcp_solver *, const mlcp_pivot **, int64_t *)

    # snapshot
    mlcp_status mlcp_snapshot_save(const char *, const mlcp_problem *, const mlcp_solver *, const mlcp_mask *,
                                   const mlcp_mask *, char *, size_t)
    mlcp_status mlcp_snapshot_write(const mlcp_problem *, const mlcp_solver *, const mlcp_mask *, const mlcp_mask *, size_t,
                                    void *, size_t *, char *, size_t)
    mlcp_status mlcp_snapshot_load(const char *, const mlcp_allocator *, mlcp_problem **, mlcp_solver **, mlcp_mask **,
                                   mlcp_mask **, char *, size_t)
    mlcp_status mlcp_snapshot_read(const void *, size_t, const mlcp_allocator *, mlcp_problem **, mlcp_solver **, mlcp_mask **,
                                   mlcp_mask **, char *, size_t)
