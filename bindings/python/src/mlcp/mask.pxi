"""mlcp_mask."""

cdef int row_state(object state, str name) except -1:
    if not 0 <= state <= MLCP_ROW_AT_UPPER:
        raise errors.ArgumentError(f"{name} = {state!r} is not a RowState")
    return state


cdef class Mask(Lender):
    """One `RowState` a row: which rows are enabled, active, at which bound; and the keys of the rows it was made for.

    Parameters
    ----------
    states : int or (count,) array of RowState
        A length, whose rows all get `state`; or the states.
    state : RowState
        For a length.

    Masks compare by their states, keys do not matter. Pickling and `copy.deepcopy` keep both.
    """
    cdef mlcp_mask *handle
    cdef object __weakref__
    __hash__ = None

    def __cinit__(self, states=0, state=MLCP_ROW_AT_LOWER):
        cdef int which = row_state(state, "state")
        if np.ndim(states) == 0:
            check(mlcp_mask_create(NULL, size32(states, "states"), which, &self.handle))
            return
        cdef cnp.ndarray array = self.checked(states)
        check(mlcp_mask_create(NULL, size32(array.shape[0], "length of states"), MLCP_ROW_AT_LOWER, &self.handle))
        self.done(mlcp_mask_set(self.handle, 0, array.shape[0], <const mlcp_row_state *>cnp.PyArray_DATA(array)))

    def __dealloc__(self):
        mlcp_mask_destroy(self.handle)

    cdef int done(self, mlcp_status status) except -1:
        return check(status, mlcp_mask_error(self.handle))

    cdef cnp.ndarray checked(self, object states):
        array = np.asarray(states)
        if array.ndim != 1:
            raise errors.RangeError(f"states has shape {array.shape}, not that of a vector")
        if array.size and array.dtype.kind not in "iu":
            raise errors.ArgumentError(f"states has dtype {array.dtype}, which is not one of integers")
        wrong = np.flatnonzero((array < 0) | (array > MLCP_ROW_AT_UPPER))
        if len(wrong):
            raise errors.ArgumentError(f"states[{wrong[0]}] = {array[wrong[0]]} is not a RowState")
        return np.require(array, np.uint8, ["C", "A"])

    @classmethod
    def carry(cls, Problem problem not None, Mask previous not None, otherwise=MLCP_ROW_AT_LOWER):
        """The start of the next step: rows of `problem` get the states that rows with the same key had in `previous`.

        Rows with a new key or none get `otherwise`; equal keys match in order of adding. Expected O(m).
        """
        cdef Mask mask = cls()
        mask.done(mlcp_mask_carry(mask.handle, problem.handle, previous.handle, row_state(otherwise, "otherwise")))
        return mask

    @staticmethod
    cdef Mask take(const mlcp_mask *other):
        """A copy of a mask that the library lends."""
        cdef Mask mask = Mask.__new__(Mask)
        cdef mlcp_mask *handle = NULL
        check(mlcp_mask_clone(NULL, other, &handle))
        mlcp_mask_destroy(mask.handle)
        mask.handle = handle
        return mask

    @property
    def states(self):
        """The states, (count,) uint8, read-only, without a copy: they follow ``mask[…] = …``. While that array is alive `resize` raises
        BufferError."""
        return lend(self, mlcp_mask_states(self.handle), mlcp_mask_size(self.handle), "u1")

    @property
    def active(self):
        """Whether each row is active, (count,) bool."""
        return self.states == MLCP_ROW_ACTIVE

    def __array__(self, dtype=None, copy=None):
        return np.array(self.states, dtype=dtype)

    def __len__(self):
        return mlcp_mask_size(self.handle)

    def __getitem__(self, index):
        found = self.states[index]
        return records.RowState(found) if np.ndim(found) == 0 else found.copy()

    def __setitem__(self, index, value):
        self.idle()
        states = np.array(self.states)
        states[index] = self.checked(np.atleast_1d(value)) if np.ndim(value) else row_state(value, "value")
        cdef cnp.ndarray array = states
        self.done(mlcp_mask_set(self.handle, 0, array.shape[0], <const mlcp_row_state *>cnp.PyArray_DATA(array)))

    def __eq__(self, other):
        if not isinstance(other, Mask):
            return NotImplemented
        return mlcp_mask_equal(self.handle, (<Mask>other).handle) != 0

    def count(self, state):
        """How many rows are in `state`."""
        return mlcp_mask_count(self.handle, row_state(state, "state"))

    def resize(self, count, state=MLCP_ROW_AT_LOWER):
        """Makes the mask `count` rows long; new rows get `state` and no key."""
        self.editable()
        self.done(mlcp_mask_resize(self.handle, size32(count, "count"), row_state(state, "state")))

    @property
    def impulses(self):
        """Impulses that go with the states, (count,), N·s, a copy; None where there are none. A mask that a solve returned has them;
        `carry` carries them too, and an iterative method starts there. May be assigned."""
        cdef cnp.ndarray values = np.empty(mlcp_mask_size(self.handle))
        cdef mlcp_status status = mlcp_mask_get_impulses(self.handle, 0, values.shape[0], f64(values))
        if status == MLCP_ERROR_STATE:
            return None
        self.done(status)
        return values

    @impulses.setter
    def impulses(self, values):
        self.idle()
        cdef cnp.ndarray array = doubles(values, "impulses", mlcp_mask_size(self.handle))
        self.done(mlcp_mask_set_impulses(self.handle, 0, array.shape[0], f64(array)))

    def take_keys(self, Problem problem not None):
        """Takes the keys of the problem's rows; the lengths must match."""
        self.idle()
        self.done(mlcp_mask_take_keys(self.handle, problem.handle))

    def copy(self):
        """A deep copy."""
        return Mask.take(self.handle)

    def __copy__(self):
        return self.copy()

    def __deepcopy__(self, memo):
        return self.copy()

    def __reduce__(self):
        # a snapshot holds masks beside a problem of their length: one of rows without entries will do
        cdef Problem rows = Problem()
        if len(self):
            rows.add_rows(r=np.zeros(len(self)))
        return _mask_of_bytes, (write_snapshot(rows, None, None, self),)

    def __repr__(self):
        return (f"<mlcp.Mask: {len(self)} rows, {self.count(MLCP_ROW_ACTIVE)} active, {self.count(MLCP_ROW_AT_LOWER)} at lower, "
                f"{self.count(MLCP_ROW_AT_UPPER)} at upper, {self.count(MLCP_ROW_DISABLED)} disabled>")


cdef inline const mlcp_mask *handle_of(Mask mask) noexcept:
    if mask is None:
        return NULL
    return mask.handle


def _mask_of_bytes(data):
    return loads(data).start
