"""Solves in a loop on arrays that are looked at once."""

cdef double[::1] bound_vector(object array, str name, Py_ssize_t count, bint writes) except *:
    """A view of the caller's array itself: anything that would need a copy is refused."""
    if not isinstance(array, np.ndarray) or array.dtype != np.float64 or array.shape != (count,) or not array.flags.c_contiguous \
            or not array.flags.aligned:
        raise errors.ArgumentError(f"{name} is not a contiguous float64 array of shape ({count},)")
    if writes and not array.flags.writeable:
        raise errors.ArgumentError(f"{name} is read-only")
    return array


cdef class BoundProblem:
    """A problem, a solver, and arrays that were checked once: made by `Solver.bind`.

    Each `solve` reads the arrays that were given for ``momentum``, ``r``, and ``lo`` with ``hi``, solves, and writes `v`, `gamma` and
    `w`, which are the caller's arrays where given. All are contiguous float64 of length n or m; inputs may be read-only. Rows and
    velocities must stay as many as they were.

    Attributes
    ----------
    v, gamma, w : array
        Velocities (n), impulses (m) and slacks (m) of the last solve.
    """
    cdef readonly Solver solver
    cdef readonly Problem problem
    cdef readonly object v, gamma, w
    cdef const double[::1] momentum, r, lo, hi
    cdef double[::1] v_, gamma_, w_
    cdef bint has_momentum, has_r, has_bounds, has_start
    cdef int32_t n, m

    def __init__(self, Solver solver not None, Problem problem not None, momentum, r, lo, hi, v, gamma, w):
        self.solver, self.problem = solver, problem
        self.n, self.m = problem.velocities, problem.rows
        self.v = np.zeros(self.n) if v is None else v
        self.gamma = np.zeros(self.m) if gamma is None else gamma
        self.w = np.zeros(self.m) if w is None else w
        self.v_ = bound_vector(self.v, "v", self.n, True)
        self.gamma_ = bound_vector(self.gamma, "gamma", self.m, True)
        self.w_ = bound_vector(self.w, "w", self.m, True)
        self.has_momentum = momentum is not None
        self.has_r = r is not None
        self.has_bounds = lo is not None
        if (lo is None) != (hi is None):
            raise errors.ArgumentError("lo and hi are bound together or not at all")
        if self.has_momentum:
            self.momentum = self.input(momentum, "momentum", self.n)
        if self.has_r:
            self.r = self.input(r, "r", self.m)
        if self.has_bounds:
            self.lo, self.hi = self.input(lo, "lo", self.m), self.input(hi, "hi", self.m)

    cdef object input(self, object array, str name, Py_ssize_t count):
        if not isinstance(array, np.ndarray) or array.dtype != np.float64 or array.shape != (count,) or not array.flags.c_contiguous:
            raise errors.ArgumentError(f"{name} is not a contiguous float64 array of shape ({count},)")
        return array

    cdef int push(self) except -1:
        cdef mlcp_problem *problem = self.problem.handle
        if self.has_momentum or self.has_r or self.has_bounds:
            self.problem.editable()
        if mlcp_problem_velocity_count(problem) != self.n or mlcp_problem_row_count(problem) != self.m:
            raise errors.StateError("the problem has got other sizes since it was bound")
        if self.has_momentum and self.n:
            self.problem.done(mlcp_problem_set_momentum(problem, 0, self.n, &self.momentum[0]))
        if self.has_r and self.m:
            self.problem.done(mlcp_problem_rows_set_r(problem, 0, self.m, &self.r[0]))
        if self.has_bounds and self.m:
            self.problem.done(mlcp_problem_rows_set_bounds(problem, 0, self.m, &self.lo[0], &self.hi[0]))
        return 0

    cdef int pull(self) except -1:
        cdef const double *data = NULL
        cdef int32_t count = 0
        cdef mlcp_solver *solver = self.solver.handle
        check(mlcp_solver_velocities(solver, &data, &count))
        if count:
            memcpy(&self.v_[0], data, count * sizeof(double))
        check(mlcp_solver_impulses(solver, &data, &count))
        if count:
            memcpy(&self.gamma_[0], data, count * sizeof(double))
        check(mlcp_solver_slacks(solver, &data, &count))
        if count:
            memcpy(&self.w_[0], data, count * sizeof(double))
        return 0

    def solve(self, bint warm=False):
        """Reads the inputs, solves, writes the outputs.

        Parameters
        ----------
        warm : bool
            Start from the active set of this solver's last solve; False, or if that had another number of rows or there
            was none: as `Solver.solve` without a start, which keys may still make warm.

        Returns
        -------
        Outcome
        """
        cdef const mlcp_mask *start = NULL
        self.solver.idle()
        self.push()
        if warm and mlcp_solver_mask(self.solver.handle, &start) == MLCP_OK and mlcp_mask_size(start) != self.m:
            start = NULL
        self.solver.run(self.problem, NULL, start, False)
        self.pull()
        self.solver.raise_pending()
        return outcomes[self.solver.report.outcome]

    @property
    def result(self):
        """The whole `Result` of the solver's last solve, in arrays of its own."""
        self.solver.idle()
        return Result.of(self.solver.handle, &self.solver.report)
