"""Memory that an object of the library lends, as an array without a copy."""

cdef class Lender:
    """Counts the arrays that look into its memory and the calls that are using it; with one of either it must not change, as a
    bytearray must not be resized. That is checked, not hoped for."""
    cdef int lent      # arrays that are alive
    cdef int in_use    # calls that run without the GIL

    cdef int editable(self) except -1:
        if self.lent:
            raise BufferError(f"this {type(self).__name__} cannot change: arrays look into its memory; copy them or let go of them")
        return self.idle()

    cdef int idle(self) except -1:
        if self.in_use:
            raise errors.StateError(f"this {type(self).__name__} is being used by a solve that is running")
        return 0


cdef class Lent:
    """A one-dimensional read-only buffer inside `owner`, which it keeps alive."""
    cdef Lender owner
    cdef const void *data
    cdef Py_ssize_t count, width
    cdef bytes format

    def __dealloc__(self):
        if self.owner is not None:
            self.owner.lent -= 1

    def __getbuffer__(self, Py_buffer *buffer, int flags):
        if flags & PyBUF_WRITABLE:
            raise BufferError("memory that the library lends is read-only")
        buffer.buf = <void *>self.data
        buffer.format = PyBytes_AS_STRING(self.format)
        buffer.internal = NULL
        buffer.itemsize = self.width
        buffer.len = self.count * self.width
        buffer.ndim = 1
        buffer.obj = self
        buffer.readonly = 1
        buffer.shape = &self.count
        buffer.strides = &self.width
        buffer.suboffsets = NULL


cdef object lend(Lender owner, const void *data, Py_ssize_t count, str dtype):
    """A read-only array over memory of `owner`; an empty one is nobody's."""
    kind = np.dtype(dtype)
    if count == 0:
        empty = np.zeros(0, kind)
        empty.flags.writeable = False
        return empty
    cdef Lent lent = Lent.__new__(Lent)
    lent.data, lent.count, lent.width, lent.format = data, count, kind.itemsize, kind.char.encode()
    owner.lent += 1
    lent.owner = owner
    return np.asarray(lent)
