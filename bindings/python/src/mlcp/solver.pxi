"""mlcp_solver."""

cdef class Solver:
    """Settings, ordering, factor and history. Reuse one over the steps of a simulation: it analyzes only when the pattern changes.

    Parameters
    ----------
    method : {"auto", "simplex", "newton", "pgs"}
        "auto": chosen island by island. "simplex": the paper's method, exact, finite, one row at a time. "newton": many rows at a
        time, exact, also for a positive semidefinite M where the solution is finite; falls back on the simplex. "pgs": projected
        Gauss-Seidel, for a `tolerance` that it can reach.
    pivot_rule : {"dual", "printed"}
        Which rows block: impulses alone, or as the paper's pseudocode prints it.
    refactorize : {"when_needed", "always"}
        Row toggles, or afresh at every pivot, to compare.
    trace : bool
        Record every pivot of the simplex in `Result.trace`.
    tolerance : float
        On the largest relative error of the report, > 0; 1e-9.
    max_iterations : int
        Pivots, Newton steps or sweeps an island; 0: 50 (rows + 10).
    max_work : int
        Entries touched an island, the same on every machine; 0: no limit.
    max_seconds : float
        0: no limit.
    impulses : {"any", "least_norm"}
        Which ones, where dependent rows leave a choice: those that the method ends with, or the least Σ aᵢ γᵢ², so that the legs of a
        table carry equal loads. v is the same.
    canonical : bool
        Compute the answer anew from its active set, so that warm and cold starts and all exact methods give the same bits where active
        rows are independent and none is at zero by accident.
    warm_start : bool
        Without a start mask, rows with keys start where the last solve left rows with the same key, and the elimination order of the last
        analysis is carried over to rows that came and went; True. False: bits do not depend on what was solved before.
    num_threads : int
        That solve islands, the caller's among them; 0: one a CPU; 1. The bits do not depend on it. A solver with threads of its own
        refuses to work in a process that was forked after it was made.
    facets : int
        Of the cones of contacts that do not say; 0: the circular cone, else at least 3.
    max_shifts : int
        Solves of the iteration for friction; 0: 300.
    parallel_for : concurrent.futures.Executor or callable, optional
        The caller's threads instead of the solver's own: an executor of threads, or ``share(work)``, which is called on the solving thread
        and calls ``work()`` on as many threads as it likes; each call takes islands until none is left. What it leaves, the solving
        thread does. The bits do not depend on it. While the solving thread waits for the others, Ctrl-C and `progress` wait for the
        islands that they have begun.
    progress : callable, optional
        Called on the solving thread with a `Progress` at the beginning and then about every 20 ms; a true value stops the solve
        with status "interrupted", an exception stops it and is raised.

    Raises
    ------
    ArgumentError, TypeError
        Naming the setting.

    Notes
    -----
    The GIL is released during a solve; one solver serves one thread at a time, else `StateError`. Ctrl-C stops a solve on the main
    thread: KeyboardInterrupt is raised, and `result` holds the last iterate. Pickling and `copy.deepcopy` keep the settings without
    `progress` and `parallel_for`; a snapshot (`mlcp.dumps`) also keeps the ordering.
    """
    cdef mlcp_solver *handle
    cdef Watch watch_state
    cdef atomic[int] stop
    cdef bint busy
    cdef bint threads  # it may have some of its own, which a fork does not copy
    cdef int maker     # the process that made them
    cdef mlcp_report report
    cdef object error  # what the callback or a signal handler raised
    cdef object __weakref__
    cdef readonly Result result  # of the last solve, None before the first one
    cdef object progress_
    cdef object parallel_for_
    cdef object share_among  # what becomes of parallel_for_: share(work), or None

    def __cinit__(self, *, progress=None, parallel_for=None, **settings):
        cdef mlcp_settings fields
        mlcp_settings_init(&fields, sizeof(mlcp_settings))
        write_settings(&fields, settings)
        cdef mlcp_status status = mlcp_solver_create(&fields, NULL, &self.handle)
        if status != MLCP_OK:
            self.refuse(&fields)
            check(status)
        mlcp_report_init(&self.report, sizeof(mlcp_report))
        self.maker = getpid()
        self.parallel_for = parallel_for
        self.progress = progress

    cdef int refuse(self, const mlcp_settings *fields) except -1:
        """mlcp_solver_create leaves no text, a solver that refuses the same settings does."""
        cdef mlcp_solver *plain = NULL
        check(mlcp_solver_create(NULL, NULL, &plain))
        try:
            check(mlcp_solver_set_settings(plain, fields), mlcp_solver_error(plain))
        finally:
            mlcp_solver_destroy(plain)
        return 0

    def __dealloc__(self):
        if not self.forked():  # it would wait for threads that are not there
            mlcp_solver_destroy(self.handle)

    cdef bint forked(self) noexcept:
        return self.threads and getpid() != self.maker

    cdef int done(self, mlcp_status status) except -1:
        return check(status, mlcp_solver_error(self.handle))

    cdef int idle(self) except -1:
        if self.busy:
            raise errors.StateError("this Solver is running in another thread, or calls itself from its progress callback")
        if self.forked():
            raise errors.StateError("this Solver has threads of its own, and the process was forked after they were made: make a new one")
        return 0

    @property
    def settings(self):
        """All settings but `progress` and `parallel_for`, by name."""
        cdef mlcp_settings fields
        mlcp_settings_init(&fields, sizeof(mlcp_settings))
        check(mlcp_solver_get_settings(self.handle, &fields))
        return read_settings(&fields)

    def configure(self, **settings):
        """Changes settings by name; the analysis and the results stay."""
        self.idle()
        if "progress" in settings:
            self.progress = settings.pop("progress")
        if "parallel_for" in settings:
            self.parallel_for = settings.pop("parallel_for")
        self.write(settings)

    cdef int write(self, dict settings) except -1:
        """Present settings with these over them, `watch` and `share` in place."""
        cdef mlcp_settings fields
        mlcp_settings_init(&fields, sizeof(mlcp_settings))
        check(mlcp_solver_get_settings(self.handle, &fields))
        write_settings(&fields, settings)
        self.threads = self.threads or fields.num_threads != 1
        fields.progress = watch
        fields.progress_context = &self.watch_state
        fields.parallel_for = share
        if self.share_among is None:
            fields.parallel_for = NULL
        fields.parallel_context = <void *>self
        return self.done(mlcp_solver_set_settings(self.handle, &fields))

    @property
    def progress(self):
        """The callback, or None."""
        return self.progress_

    @progress.setter
    def progress(self, callback):
        if callback is not None and not callable(callback):
            raise errors.ArgumentError(f"progress = {callback!r} cannot be called")
        self.idle()
        self.progress_ = callback
        self.write({})

    @property
    def parallel_for(self):
        """The executor or callable, or None."""
        return self.parallel_for_

    @parallel_for.setter
    def parallel_for(self, parallel_for):
        share_among = threads.sharing(parallel_for)
        self.idle()
        self.parallel_for_, self.share_among = parallel_for, share_among
        self.write({})

    # ------------------------------------------------------------------------------------------------------- solving

    cdef void share(self, int32_t count, mlcp_task task, void *data) noexcept:
        """Exceptions stop the solve and wait until it has ended."""
        cdef Work work = Work.__new__(Work)
        work.count, work.task, work.data = count, task, data
        try:
            self.share_among(work)
        except BaseException as error:
            self.fail(error)
        try:
            work.finish()
        except BaseException as error:
            self.fail(error)

    cdef void fail(self, object error) noexcept:
        self.error = error if self.error is None else self.error
        self.stop.store(1)

    cdef int32_t look(self, const mlcp_progress *now) noexcept:
        """Signals and the caller's callback, with the GIL. Exceptions wait until the solve has ended."""
        try:
            PyErr_CheckSignals()
            if self.progress_ is None:
                return 0
            return bool(self.progress_(records.Progress(now.seconds, now.pivots, now.work, now.island, now.islands, now.violation)))
        except BaseException as error:
            self.fail(error)
            return 1

    cdef int run(self, Problem problem, const mlcp_mask *enabled, const mlcp_mask *start, bint only_analyze) except -1:
        """before: masks are held by the caller.        after: self.report, self.error."""
        self.idle()
        cdef Watch *state = &self.watch_state
        cdef mlcp_status status
        state.stop = &self.stop
        state.solver = <void *>self
        state.holds_gil = self.progress_ is not None or threading.get_ident() == threading.main_thread().ident
        state.next_look = 0 if self.progress_ is not None else seconds_between_looks
        self.error = None
        self.busy = True
        problem.in_use += 1
        with nogil:
            if only_analyze:
                status = mlcp_analyze(self.handle, problem.handle, enabled)
            else:
                status = mlcp_solve(self.handle, problem.handle, enabled, start, &self.report)
        problem.in_use -= 1
        self.busy = False
        self.stop.store(0)
        return self.done(status)

    cdef int run_with(self, Problem problem, Mask enabled, Mask start, bint only_analyze) except -1:
        try:
            if enabled is not None:
                enabled.in_use += 1
            if start is not None:
                start.in_use += 1
            return self.run(problem, handle_of(enabled), handle_of(start), only_analyze)
        finally:
            if enabled is not None:
                enabled.in_use -= 1
            if start is not None:
                start.in_use -= 1

    cdef int raise_pending(self) except -1:
        error, self.error = self.error, None
        if error is not None:
            raise error
        return 0

    def analyze(self, Problem problem not None, *, Mask enabled=None):
        """Orders and analyzes the pattern of the enabled rows (None: all), so that a solve need not."""
        self.run_with(problem, enabled, None, True)

    def solve(self, Problem problem not None, Mask start=None, *, Mask enabled=None):
        """Solves.

        Parameters
        ----------
        problem : Problem
        start : Mask, optional
            The active set to start from, e.g. ``Mask.carry(problem, result.mask)`` of the last step; any will do. None: what
            `warm_start` finds by the rows' keys, else bilateral rows only.
        enabled : Mask, optional
            Rows in state DISABLED are left out. None: all rows count.

        Returns
        -------
        Result
            Also when it is not solved: see `Result.status`.

        Raises
        ------
        RangeError
            A mask of another length than m.
        StateError
            The solver is running in another thread.
        KeyboardInterrupt
            Ctrl-C; `Solver.result` then holds the last iterate.
        """
        self.run_with(problem, enabled, start, False)
        self.result = Result.of(self.handle, &self.report)
        self.raise_pending()
        return self.result

    def interrupt(self):
        """Stops the solve that is running, or else the next one, with status "interrupted". From any thread."""
        self.stop.store(1)

    def bind(self, Problem problem not None, *, momentum=None, r=None, lo=None, hi=None, v=None, gamma=None, w=None):
        """Ties arrays to a problem, for many solves with little overhead; see `BoundProblem`."""
        return BoundProblem(self, problem, momentum, r, lo, hi, v, gamma, w)

    def reaction(self, Problem problem not None, int32_t body):
        """The impulse that a prescribed body needs to keep its velocity, M v − k − Jᵀ γ on its velocities, (d,)."""
        self.idle()
        span = problem.body_slice(body)
        cdef cnp.ndarray impulse = np.empty(span.stop - span.start)
        cdef mlcp_status status = mlcp_solver_reaction(self.handle, problem.handle, body, impulse.shape[0], f64(impulse))
        check(status, b"there are no results before a solve, or they are of another problem" if status == MLCP_ERROR_STATE else b"")
        return impulse

    def factor(self):
        """Pattern of L of the last analysis, as a `Factor`."""
        self.idle()
        cdef mlcp_factor_view view
        mlcp_factor_view_init(&view, sizeof(mlcp_factor_view))
        check(mlcp_solver_factor(self.handle, &view), b"nothing has been analyzed")
        return records.Factor(copied(view.nodes, view.size, cnp.NPY_INT32), copied(view.pointers, view.size + 1, cnp.NPY_INT64),
                              copied(view.rows, view.entries, cnp.NPY_INT32))

    def trim(self):
        """Gives memory back; the ordering is kept, so that the next solve gives the same bits."""
        self.idle()
        self.done(mlcp_solver_trim(self.handle))

    def keep_failures(self, folder, int32_t limit=10):
        """From now on a solve whose status is not "solved" leaves a snapshot in `folder`, which must be there, until `limit` of them are;
        None: no longer. `failure_file` names it, and `mlcp.load` brings it back. A new solver begins with the folder and limit in the
        environment variables MLCP_FAILURES and MLCP_FAILURES_LIMIT."""
        cdef bytes name = os.fsencode(folder) if folder is not None else b""
        cdef const char *path = NULL
        if folder is not None:
            path = name
        self.idle()
        self.done(mlcp_solver_keep_failures(self.handle, path, limit))

    @property
    def failure_file(self):
        """The file that the last solve left for `keep_failures`, or None."""
        self.idle()
        return os.fsdecode(<bytes>mlcp_solver_failure_file(self.handle)) or None

    def __copy__(self):
        return type(self)(progress=self.progress_, parallel_for=self.parallel_for_, **self.settings)

    def __deepcopy__(self, memo):
        return type(self)(**self.settings)

    def __reduce__(self):
        return _solver_of_settings, (type(self), self.settings)

    def __repr__(self):
        return f"<mlcp.Solver: {', '.join(f'{name} = {value!r}' for name, value in self.settings.items())}>"


cdef inline const mlcp_solver *solver_handle(Solver solver) noexcept:
    if solver is None:
        return NULL
    return solver.handle


def _solver_of_settings(cls, settings):
    return cls(**settings)
