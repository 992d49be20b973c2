"""NumPy arrays of the caller, made fit for C: used as they are where dtype and layout match, copied where they do not, refused where
a copy would change a value. Never written to."""

cdef cnp.ndarray doubles(object values, str name, Py_ssize_t count):
    """float64, `count` long; a number stands for all. count < 0: any length."""
    cdef cnp.ndarray array = np.asarray(values)
    if array.ndim == 0 and count >= 0:
        array = np.full(count, array)
    if array.ndim != 1 or (count >= 0 and array.shape[0] != count):
        raise errors.RangeError(f"{name} has shape {tuple(array.shape[i] for i in range(array.ndim))}, not "
                                + (f"({count},)" if count >= 0 else "that of a vector"))
    return real(array, name)


cdef cnp.ndarray real(cnp.ndarray array, str name):
    """float64 in C order, of the same shape."""
    if not np.can_cast(array.dtype, np.float64, "same_kind"):
        raise errors.ArgumentError(f"{name} has dtype {array.dtype}, which is not one of real numbers")
    return np.require(array, np.float64, ["C", "A"])


cdef cnp.ndarray indices(object values, str name, Py_ssize_t count):
    """int32, `count` long (< 0: any length). Wider integers are copied when every one fits, and refused otherwise."""
    cdef cnp.ndarray array = np.asarray(values)
    if array.ndim != 1 or (count >= 0 and array.shape[0] != count):
        raise errors.RangeError(f"{name} has shape {tuple(array.shape[i] for i in range(array.ndim))}, not "
                                + (f"({count},)" if count >= 0 else "that of a vector"))
    if array.shape[0] == 0:
        return np.zeros(0, np.int32)
    if array.dtype.kind not in "iu":
        raise errors.ArgumentError(f"{name} has dtype {array.dtype}, which is not one of integers")
    if array.dtype != np.int32:
        wrong = np.flatnonzero((array > INT32_MAX) | (array < -INT32_MAX - 1))
        if len(wrong):
            raise errors.RangeError(f"{name}[{wrong[0]}] = {array[wrong[0]]} does not fit into 32 bits")
    return np.require(array, np.int32, ["C", "A"])


cdef cnp.ndarray keys_of(object values, str name, Py_ssize_t count):
    """uint64, `count` long; negative ones are refused."""
    cdef cnp.ndarray array = np.asarray(values)
    if array.ndim != 1 or array.shape[0] != count:
        raise errors.RangeError(f"{name} has shape {tuple(array.shape[i] for i in range(array.ndim))}, not ({count},)")
    if count == 0:
        return np.zeros(0, np.uint64)
    if array.dtype.kind not in "iu":
        raise errors.ArgumentError(f"{name} has dtype {array.dtype}, which is not one of integers")
    if array.dtype.kind == "i":
        wrong = np.flatnonzero(array < 0)
        if len(wrong):
            raise errors.ArgumentError(f"{name}[{wrong[0]}] = {array[wrong[0]]} is negative")
    return np.require(array, np.uint64, ["C", "A"])


cdef inline double *f64(cnp.ndarray array) noexcept:
    if array is None:
        return NULL
    return <double *>cnp.PyArray_DATA(array)


cdef inline int32_t *i32(cnp.ndarray array) noexcept:
    if array is None:
        return NULL
    return <int32_t *>cnp.PyArray_DATA(array)


cdef inline uint64_t *u64(cnp.ndarray array) noexcept:
    if array is None:
        return NULL
    return <uint64_t *>cnp.PyArray_DATA(array)


cdef cnp.ndarray copied(const void *data, Py_ssize_t count, int type):
    """A new array of what the library lends."""
    cdef cnp.npy_intp shape = count
    cdef cnp.ndarray array = cnp.PyArray_SimpleNew(1, &shape, type)
    if count:
        memcpy(cnp.PyArray_DATA(array), data, <size_t>cnp.PyArray_NBYTES(array))
    return array


cdef int32_t size32(object value, str name) except? -1:
    if not 0 <= value <= INT32_MAX:
        raise errors.RangeError(f"{name} = {value} is not in 0 .. 2^31 - 1")
    return value


cdef class Compressed:
    """A matrix as compressed rows or columns, in arrays that C can read."""
    cdef cnp.ndarray pointers, indices, values
    cdef Py_ssize_t rows, columns
    cdef bint by_rows

    def __init__(self, object matrix, str name):
        if not scipy.sparse.issparse(matrix):
            array = np.asarray(matrix)
            if array.ndim != 2:
                raise errors.RangeError(f"{name} has shape {array.shape}, not that of a matrix")
            matrix = scipy.sparse.csr_array(real(array, name))
        elif matrix.ndim != 2:
            raise errors.RangeError(f"{name} has shape {matrix.shape}, not that of a matrix")
        elif matrix.format not in ("csr", "csc"):
            matrix = matrix.tocsr()
        self.by_rows = matrix.format == "csr"
        self.rows, self.columns = matrix.shape
        self.pointers = indices(matrix.indptr, name + ".indptr", 1 + (self.rows if self.by_rows else self.columns))
        cdef Py_ssize_t entries = i32(self.pointers)[self.pointers.shape[0] - 1]
        if entries < 0 or entries > min(len(matrix.indices), len(matrix.data)):
            raise errors.RangeError(f"{name}.indptr ends with {entries}, but there are {len(matrix.data)} entries")
        self.indices = indices(matrix.indices[:entries], name + ".indices", entries)
        self.values = doubles(matrix.data[:entries], name + ".data", entries)

    cdef int square(self, str name) except -1:
        if self.rows != self.columns:
            raise errors.RangeError(f"{name} has shape ({self.rows}, {self.columns}), which is not square")
        return 0

    cdef int32_t triangle(self, str which) except -1:
        """Of compressed columns, which the library reads these arrays as: compressed rows are those of the transpose."""
        if which == "full":
            return MLCP_FULL
        if which not in ("lower", "upper"):
            raise errors.ArgumentError(f"triangle = {which!r} is not one of 'full', 'lower', 'upper'")
        return MLCP_LOWER if (which == "lower") != self.by_rows else MLCP_UPPER
