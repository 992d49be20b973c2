"""The progress callback of the library: Ctrl-C, Solver.interrupt and the caller's own callback."""
from cpython.exc cimport PyErr_CheckSignals
from libcpp.atomic cimport atomic

# Holding the GIL costs the other threads; Ctrl-C is to end a solve within 0.1 s.
cdef double seconds_between_looks = 0.02

cdef struct Watch:
    atomic[int] *stop  # set by any thread
    bint holds_gil     # whether to look at what needs the GIL: signals, which only the main thread gets, and the callback
    double next_look   # s since the solve began
    void *solver       # a Solver, alive during the solve


cdef int32_t watch(void *context, const mlcp_progress *now) noexcept nogil:
    """What the library calls now and then: anything but 0 stops the solve."""
    cdef Watch *state = <Watch *>context
    if state.stop.load():
        return 1
    if not state.holds_gil or now.seconds < state.next_look:
        return 0
    state.next_look = now.seconds + seconds_between_looks
    with gil:
        return (<Solver>state.solver).look(now)
