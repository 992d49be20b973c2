"""What a solve leaves, in arrays of its own."""

cdef list outcomes = [records.Outcome(mlcp_outcome_text(i).decode()) for i in range(len(records.Outcome))]

pivot_dtype = np.dtype([("island", "i4"), ("entering", "i4"), ("blocking", "i4"), ("to", "u1"), ("dependent", "?"),
                        ("step", "f8"), ("violation", "f8"), ("schur", "f8")], align=True)
assert pivot_dtype.itemsize == sizeof(mlcp_pivot)


cdef class Result:
    """What one solve found. The arrays are its own: they stay as they are when the solver goes on or goes away. Pickles.

    Attributes
    ----------
    v : (n,) array
        Velocities; prescribed bodies have their given one. In a reduced problem n = 0.
    gamma : (m,) array
        Impulses, N·s; 0 for disabled rows.
    w : (m,) array
        Slacks J v + Σ γ − r, m/s.
    mask : Mask
        States and keys of the rows: the start of the next step.
    redundant : (m,) bool array
        Rows found dependent on active ones: their impulse is at a bound or 0, or they share the load.
    row_islands : (m,) int32 array
        The island of each row, −1 for disabled rows.
    certificates : tuple of Certificate
        One for each island that is infeasible.
    trace : structured array
        One record a pivot: island, entering, blocking, to, dependent, step, violation, schur; empty without
        ``trace=True``. Steps of other methods than the simplex are not in it.
    contact_states : (contacts,) uint8 array
        A `ContactState` for each contact, in order of adding.
    contact_facets : (contacts,) int32 array
        Generators of each contact's cone that were tried, 0 where it has none.
    """
    cdef mlcp_report report
    cdef readonly object v, gamma, w, redundant, row_islands, trace, contact_states, contact_facets
    cdef readonly Mask mask
    cdef readonly tuple certificates
    cdef object islands  # their outcomes, int32

    def __init__(self):
        raise TypeError("a Result comes from a solve")

    @staticmethod
    cdef Result of(const mlcp_solver *solver, const mlcp_report *report):
        cdef Result self = Result.__new__(Result)
        cdef const double *data = NULL
        cdef const uint8_t *redundant = NULL
        cdef const int32_t *islands = NULL
        cdef const int32_t *facets = NULL
        cdef const mlcp_contact_state *states = NULL
        cdef const mlcp_mask *mask = NULL
        cdef const mlcp_pivot *pivots = NULL
        cdef int32_t count = 0
        cdef int64_t steps = 0
        self.report = report[0]
        check(mlcp_solver_velocities(solver, &data, &count))
        self.v = copied(data, count, cnp.NPY_DOUBLE)
        check(mlcp_solver_impulses(solver, &data, &count))
        self.gamma = copied(data, count, cnp.NPY_DOUBLE)
        check(mlcp_solver_slacks(solver, &data, &count))
        self.w = copied(data, count, cnp.NPY_DOUBLE)
        check(mlcp_solver_mask(solver, &mask))
        self.mask = Mask.take(mask)
        check(mlcp_solver_redundant(solver, &redundant, &count))
        self.redundant = copied(redundant, count, cnp.NPY_BOOL)
        check(mlcp_solver_row_islands(solver, &islands, &count))
        self.row_islands = copied(islands, count, cnp.NPY_INT32)
        check(mlcp_solver_island_outcomes(solver, &islands, &count))
        self.islands = copied(islands, count, cnp.NPY_INT32)
        self.certificates = Result.read_certificates(solver, islands, count) if report.islands_failed else ()
        check(mlcp_solver_trace(solver, &pivots, &steps))
        cdef cnp.ndarray trace = np.empty(steps, pivot_dtype)
        if steps:
            memcpy(cnp.PyArray_DATA(trace), pivots, steps * sizeof(mlcp_pivot))
        self.trace = trace
        check(mlcp_solver_contact_states(solver, &states, &count))
        self.contact_states = copied(states, count, cnp.NPY_UINT8)
        check(mlcp_solver_contact_facets(solver, &facets, &count))
        self.contact_facets = copied(facets, count, cnp.NPY_INT32)
        return self

    @staticmethod
    cdef tuple read_certificates(const mlcp_solver *solver, const int32_t *outcome, int32_t islands):
        cdef const int32_t *rows = NULL
        cdef const double *y = NULL
        cdef int32_t island, count = 0
        found = []
        for island in range(islands):
            if outcome[island] == MLCP_INFEASIBLE and mlcp_solver_certificate(solver, island, &rows, &y, &count) == MLCP_OK:
                found.append(records.Certificate(island, copied(rows, count, cnp.NPY_INT32), copied(y, count, cnp.NPY_DOUBLE)))
        return tuple(found)

    @property
    def status(self):
        """How the solve ended, the worst over the islands: an `Outcome`, which is a string."""
        return outcomes[self.report.outcome]

    @property
    def solved(self):
        """Whether every recomputed error is within the tolerance."""
        return self.report.outcome == MLCP_SOLVED

    @property
    def method(self):
        """Name of the method that ran; "auto": several did."""
        return mlcp_method_text(self.report.method).decode()

    @property
    def active(self):
        """Rows with w = 0 and an impulse between its bounds, (m,) bool array."""
        return self.mask.active

    @property
    def island_status(self):
        """The `Outcome` of every island."""
        return [outcomes[i] for i in self.islands]

    @property
    def errors(self):
        """`Errors`, recomputed from the problem's own numbers, rows that were not enabled excepted."""
        cdef mlcp_report *r = &self.report
        return records.Errors(r.momentum_error, r.constraint_error, r.largest_error, r.momentum_residual, r.constraint_residual,
                              r.worst_velocity, r.worst_row, r.worst_body, r.cone_error, r.cone_residual, r.worst_contact)

    @property
    def counts(self):
        """`Counts`: what was done."""
        cdef mlcp_report *r = &self.report
        return records.Counts(r.islands, r.islands_failed, r.enabled_rows, r.active_rows, r.redundant_rows, r.pivots, r.toggles,
                              r.factorizations, r.refinements, r.work, r.factor_entries, r.analyzed != 0,
                              r.refactorized_for_drift, r.warm != 0, r.fallbacks, r.contacts_open, r.contacts_sticking,
                              r.contacts_sliding, r.generators, r.facets, r.shift_iterations, r.islands_by_lemke)

    @property
    def times(self):
        """`Times`: where the time went, s."""
        cdef mlcp_report *r = &self.report
        return records.Times(r.seconds, r.seconds_analyze, r.seconds_factorize, r.seconds_solve, r.seconds_report)

    def __reduce__(self):
        return _result_of_parts, (self.report, self.v, self.gamma, self.w, self.mask, self.redundant, self.row_islands,
                                  self.islands, self.certificates, self.trace, self.contact_states, self.contact_facets)

    def __repr__(self):
        cdef mlcp_report *r = &self.report
        return (f"<mlcp.Result: {self.status.value}, {r.active_rows} of {r.enabled_rows} rows active, {r.pivots} pivots, "
                f"error {r.largest_error:.0e}, {1e3 * r.seconds:.3g} ms>")


def _result_of_parts(report, v, gamma, w, mask, redundant, row_islands, islands, certificates, trace, contact_states,
                     contact_facets):
    cdef Result result = Result.__new__(Result)
    result.report = report
    result.v, result.gamma, result.w, result.mask, result.redundant = v, gamma, w, mask, redundant
    result.row_islands, result.islands, result.certificates, result.trace = row_islands, islands, certificates, trace
    result.contact_states, result.contact_facets = contact_states, contact_facets
    return result
