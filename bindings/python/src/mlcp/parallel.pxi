"""parallel_for of the library on the caller's threads."""
from libcpp.atomic cimport atomic
from posix.unistd cimport usleep


cdef class Work:
    """The islands of one solve, to be shared among threads: each call, on any thread, takes islands until none is left, without the GIL.

    Attributes
    ----------
    count : int
        Tasks at the beginning, each one or more islands: as many calls can be of use at a time.
    """
    cdef readonly int32_t count
    cdef mlcp_task task
    cdef void *data
    cdef atomic[int32_t] next
    cdef int32_t workers  # calls so far, as the library numbers threads; this one and the next under the GIL
    cdef int32_t inside   # calls that have not returned

    def __init__(self):
        raise TypeError("a Work comes from a solve")

    def __call__(self):
        self.take()

    cdef void take(self) noexcept:
        cdef int32_t index, worker = self.workers
        if self.next.load() >= self.count:  # also when the solve, and `data` with it, has gone
            return
        self.workers += 1
        self.inside += 1
        with nogil:
            while True:
                index = self.next.fetch_add(1)
                if index >= self.count:
                    break
                self.task(self.data, index, worker)
        self.inside -= 1

    cdef int finish(self) except -1:
        """What is left, on this thread; then waits for calls that `share` did not wait for."""
        self.take()
        while self.inside:
            with nogil:
                usleep(1000)
        return PyErr_CheckSignals()


cdef void share(void *context, int32_t count, mlcp_task task, void *data) noexcept nogil:
    """What the library calls as parallel_for."""
    with gil:
        (<Solver>context).share(count, task, data)
