"""mlcp_snapshot_*. The functions of C tell the cause of a failure in a buffer of the caller's."""

cdef enum:
    message_size = 512


cdef int adopt(Problem problem, Solver solver, mlcp_problem *new_problem, mlcp_solver *new_solver) except -1:
    """Puts new handles where those of new objects are."""
    mlcp_problem_destroy(problem.handle)
    problem.handle = new_problem
    if solver is not None:
        mlcp_solver_destroy(solver.handle)
        solver.handle = new_solver
        solver.write({})
    return 0


cdef int read_snapshot(object data, Problem problem, Solver solver, mlcp_mask **enabled, mlcp_mask **start) except -1:
    cdef const uint8_t[::1] view = memoryview(data).cast("B")
    cdef char message[message_size]
    cdef mlcp_problem *new_problem = NULL
    cdef mlcp_solver *new_solver = NULL
    cdef mlcp_solver **wanted = NULL
    if solver is not None:
        wanted = &new_solver
    cdef const uint8_t *bytes = &view[0] if view.shape[0] else <const uint8_t *>b""
    check(mlcp_snapshot_read(bytes, view.shape[0], NULL, &new_problem, wanted, enabled,
                             start, message, message_size), message)
    return adopt(problem, solver, new_problem, new_solver)


cdef int read_snapshot_file(object path, Problem problem, Solver solver, mlcp_mask **enabled, mlcp_mask **start) except -1:
    cdef bytes name = os.fsencode(path)
    cdef char message[message_size]
    cdef mlcp_problem *new_problem = NULL
    cdef mlcp_solver *new_solver = NULL
    cdef mlcp_solver **wanted = NULL
    if solver is not None:
        wanted = &new_solver
    check(mlcp_snapshot_load(name, NULL, &new_problem, wanted, enabled, start, message,
                             message_size), message)
    return adopt(problem, solver, new_problem, new_solver)


cdef bytes write_snapshot(Problem problem, Solver solver, Mask enabled, Mask start):
    cdef char message[message_size]
    cdef size_t size = 0
    if solver is not None:
        solver.idle()
    check(mlcp_snapshot_write(problem.handle, solver_handle(solver), handle_of(enabled), handle_of(start), 0, NULL, &size, message, message_size), message)
    cdef bytes data = PyBytes_FromStringAndSize(NULL, size)
    check(mlcp_snapshot_write(problem.handle, solver_handle(solver), handle_of(enabled), handle_of(start), size, PyBytes_AS_STRING(data), &size, message,
                              message_size), message)
    return data


cdef object mask_or_none(mlcp_mask *handle):
    """Takes over a mask of the library."""
    if handle is NULL:
        return None
    cdef Mask mask = Mask.__new__(Mask)
    mlcp_mask_destroy(mask.handle)
    mask.handle = handle
    return mask


def dumps(Problem problem not None, Solver solver=None, *, Mask enabled=None, Mask start=None):
    """A snapshot as bytes: all that a solve depends on, so that a replay by the same build gives the same bits.

    Parameters
    ----------
    problem : Problem
    solver : Solver, optional
        Gives settings and ordering; None: the defaults.
    enabled, start : Mask, optional
        What will be given to `Solver.solve`.
    """
    return write_snapshot(problem, solver, enabled, start)


def loads(data):
    """A `Snapshot` of bytes-like data, which is not trusted.

    Raises
    ------
    FormatError
        The data is damaged or of an unknown version.
    """
    cdef Problem problem = Problem()
    cdef Solver solver = Solver()
    cdef mlcp_mask *enabled = NULL
    cdef mlcp_mask *start = NULL
    read_snapshot(data, problem, solver, &enabled, &start)
    return records.Snapshot(problem, solver, mask_or_none(enabled), mask_or_none(start))


def save(path, Problem problem not None, Solver solver=None, *, Mask enabled=None, Mask start=None):
    """A snapshot as a file, which `mlcp solve` reads too; as `dumps`. An old file stays as it was unless all went well."""
    cdef bytes name = os.fsencode(path)
    cdef char message[message_size]
    if solver is not None:
        solver.idle()
    check(mlcp_snapshot_save(name, problem.handle, solver_handle(solver), handle_of(enabled), handle_of(start), message, message_size), message)


def load(path):
    """A `Snapshot` of a file, which is not trusted; as `loads`."""
    cdef Problem problem = Problem()
    cdef Solver solver = Solver()
    cdef mlcp_mask *enabled = NULL
    cdef mlcp_mask *start = NULL
    read_snapshot_file(path, problem, solver, &enabled, &start)
    return records.Snapshot(problem, solver, mask_or_none(enabled), mask_or_none(start))
