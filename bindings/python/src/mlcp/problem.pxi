"""mlcp_problem."""

cdef dict friction_models = {"none": MLCP_FRICTION_NONE, "convex": MLCP_FRICTION_CONVEX, "coulomb": MLCP_FRICTION_COULOMB,
                             "box": MLCP_FRICTION_BOX, "findex": MLCP_FRICTION_FINDEX}

cdef class Problem(Lender):
    """Bodies, rows and their numbers.

    ::

        M v − Jᵀ γ = k                          momentum
        J v + Σ γ − r = w                       constraint rows
        lo ≤ γ ≤ hi,   wᵢ > 0 ⇒ γᵢ = lo,   wᵢ < 0 ⇒ γᵢ = hi,   else wᵢ = 0

    `Problem()` is empty; `from_matrices`, `from_reduced`, `from_folder`, `from_fclib`, `from_file` and `from_bytes` make whole ones.
    Arrays that are passed in are copied by the library before a call returns; they may be read-only, and are never changed. float64 and
    int32 arrays in C order are read in place; other real dtypes, layouts and 64-bit indices cost a copy, and indices that do not fit
    into 32 bits are an error. A call that fails changes nothing.

    Any number of solvers in any number of threads may solve one problem at a time; while they do, and while an array that
    `mass`, `jacobian` or `compliance_matrix` lent without a copy is alive, calls that change it raise `StateError` or `BufferError`.

    Pickling and `copy.deepcopy` keep everything.
    """
    cdef mlcp_problem *handle
    cdef object __weakref__

    def __cinit__(self):
        check(mlcp_problem_create(NULL, &self.handle))

    def __dealloc__(self):
        mlcp_problem_destroy(self.handle)

    cdef int done(self, mlcp_status status) except -1:
        return check(status, mlcp_problem_error(self.handle))

    # ------------------------------------------------------------------------------------------------ whole problems

    @classmethod
    def from_matrices(cls, mass, momentum, jacobian=None, r=0.0, lo=0.0, hi=np.inf, *, compliance=0.0, keys=None):
        """A problem from its matrices.

        Parameters
        ----------
        mass : (n, n) sparse or dense, or (bodies, d, d) dense
            M, kg, both triangles. A stack of blocks makes a body of dimension d of each; a matrix makes one body of all
            velocities, whose dense form is stored by its nonzeros.
        momentum : (n,) array or number
            k, N·s.
        jacobian : (m, n) sparse or dense, optional
            J. None: no rows.
        r, lo, hi : (m,) array or number
            Right-hand side, m/s, and bounds on the impulses, N·s. lo = −inf, hi = inf: bilateral; the default: unilateral.
        compliance : (m,) array, number, or (m, m) sparse or dense
            Σ, m/(N·s): its diagonal or all of it.
        keys : (m,) array of integers ≥ 0, optional
            Identity of the rows over time steps; 0: none.

        Raises
        ------
        ArgumentError, RangeError
            Naming argument and index.
        """
        cdef Problem problem = cls()
        if scipy.sparse.issparse(mass):
            problem.add_sparse_body(mass)
        else:
            blocks = np.asarray(mass)
            if blocks.ndim == 3:
                problem.add_bodies(blocks)
            else:
                problem.add_sparse_body(blocks)
        problem.set_momentum(doubles(momentum, "momentum", problem.velocities))
        if jacobian is None:
            return problem
        if np.ndim(compliance) == 2 or scipy.sparse.issparse(compliance):
            problem.add_matrix_rows(jacobian, r, lo, hi, keys=keys)
            problem.set_compliance_matrix(compliance)
        else:
            problem.add_matrix_rows(jacobian, r, lo, hi, compliance=compliance, keys=keys)
        return problem

    @classmethod
    def from_reduced(cls, a, b, lo=0.0, hi=np.inf, *, keys=None):
        """A reduced problem, w = A z + b: n = 0, Σ = A, r = −b, and z is the impulse γ.

        Parameters
        ----------
        a : (m, m) sparse or dense
            Symmetric, both triangles.
        b : (m,) array or number
        lo, hi : (m,) array or number
            lo ≤ z ≤ hi; the default is 0 ≤ z, −inf and inf make a row free (w = 0).
        keys : (m,) array of integers ≥ 0, optional
        """
        cdef Problem problem = cls()
        cdef Compressed matrix = Compressed(a, "a")
        matrix.square("a")
        no_velocities = scipy.sparse.csr_array((matrix.rows, 0))
        problem.add_matrix_rows(no_velocities, np.negative(doubles(b, "b", matrix.rows)), lo, hi, keys=keys)
        problem.set_compliance_matrix(a)
        return problem

    @classmethod
    def from_folder(cls, path, *, friction=None):
        """The problem in a folder of Matrix Market files, without friction or with this model of it (see `add_contacts`);
        `mlcp.read_folder` also tells where its rows stand in the files.

        Raises
        ------
        FileError, FormatError, ArgumentError, RangeError
        """
        from mlcp.folder import read_folder
        return read_folder(path, cls, friction=friction).problem

    @classmethod
    def from_fclib(cls, path, *, friction=None):
        """The problem in an FCLIB file (HDF5), without friction or with this model of it; `mlcp.read_fclib` also tells where its rows
        stand in the file. Needs h5py, ``pip install mlcp[fclib]``.

        Raises
        ------
        ImportError, FileError, FormatError, ArgumentError, RangeError
        """
        from mlcp.fclib import read_fclib
        return read_fclib(path, cls, friction=friction).problem

    @classmethod
    def from_file(cls, path):
        """The problem in a snapshot file, a folder of Matrix Market files or an FCLIB file, without friction in the latter two."""
        if os.path.isdir(path):
            return cls.from_folder(path)
        if begins_as_hdf5(path):
            return cls.from_fclib(path)
        cdef Problem problem = cls.__new__(cls)
        read_snapshot_file(path, problem, None, NULL, NULL)
        return problem

    @classmethod
    def from_bytes(cls, data):
        """The problem in the bytes of a snapshot; they are not trusted, everything in them is checked."""
        cdef Problem problem = cls.__new__(cls)
        read_snapshot(data, problem, None, NULL, NULL)
        return problem

    def to_fclib(self, path):
        """Writes bilateral rows and contacts as a new FCLIB file; see `mlcp.write_fclib`."""
        from mlcp.fclib import write_fclib
        write_fclib(path, self)

    def to_bytes(self):
        """Snapshot of the problem alone; `mlcp.dumps` adds solver and masks."""
        return write_snapshot(self, None, None, None)

    def copy(self):
        """A deep copy."""
        cdef Problem twin = type(self).__new__(type(self))
        cdef mlcp_problem *handle = NULL
        check(mlcp_problem_clone(self.handle, &handle))
        mlcp_problem_destroy(twin.handle)
        twin.handle = handle
        return twin

    def __copy__(self):
        return self.copy()

    def __deepcopy__(self, memo):
        return self.copy()

    def __reduce__(self):
        return type(self).from_bytes, (self.to_bytes(),)

    def __repr__(self):
        return f"<mlcp.Problem: {self.velocities} velocities in {self.body_count} bodies, {self.rows} rows>"

    # -------------------------------------------------------------------------------------------------------- sizes

    @property
    def velocities(self):
        """Number n of velocities, the length of v and k."""
        return mlcp_problem_velocity_count(self.handle)

    @property
    def rows(self):
        """Number m of rows, the length of γ, w, r, lo and hi."""
        return mlcp_problem_row_count(self.handle)

    @property
    def body_count(self):
        """Number of bodies."""
        return mlcp_problem_body_count(self.handle)

    @property
    def entries(self):
        """Stored entries of J."""
        return mlcp_problem_entry_count(self.handle)

    def reserve(self, bodies=0, velocities=0, rows=0, entries=0):
        """Makes room, so that adding that much allocates nothing."""
        self.editable()
        self.done(mlcp_problem_reserve(self.handle, size32(bodies, "bodies"), size32(velocities, "velocities"),
                                       size32(rows, "rows"), entries))

    def trim(self):
        """Gives unused memory back."""
        self.editable()
        self.done(mlcp_problem_trim(self.handle))

    def clear(self):
        """Back to empty; memory is kept."""
        self.editable()
        self.done(mlcp_problem_clear(self.handle))

    # ------------------------------------------------------------------------------------------------------- bodies

    def add_bodies(self, masses):
        """Adds bodies of one dimension.

        Parameters
        ----------
        masses : (count, d, d) array, or (d, d) for one body
            Symmetric positive definite blocks, kg and kg·m².

        Returns
        -------
        (count,) int32 array
            Their ids, stable until they are removed.
        """
        self.editable()
        cdef cnp.ndarray blocks = real(np.asarray(masses), "masses")
        if blocks.ndim == 2:
            blocks = blocks[np.newaxis]
        if blocks.ndim != 3 or blocks.shape[1] != blocks.shape[2]:
            raise errors.RangeError(f"masses has shape {np.shape(masses)}, not (count, d, d)")
        cdef cnp.ndarray ids = np.empty(blocks.shape[0], np.int32)
        self.done(mlcp_problem_bodies_add(self.handle, size32(blocks.shape[0], "count"), size32(blocks.shape[1], "d"), f64(blocks), 0,
                                          i32(ids)))
        return ids

    def add_sparse_body(self, mass, triangle="full"):
        """Adds one body whose mass is sparse (articulated, flexible), or all bodies of a problem as one.

        Parameters
        ----------
        mass : (d, d) sparse or dense
            CSR and CSC are read in place, in any order of entries, without duplicates. Definiteness is judged in the solve.
        triangle : {"full", "lower", "upper"}
            What is stored of it.

        Returns
        -------
        int
            Its id.
        """
        self.editable()
        cdef Compressed matrix = Compressed(mass, "mass")
        matrix.square("mass")
        cdef int32_t id = -1
        if matrix.rows == 0:
            raise errors.RangeError("mass has no rows: a body has at least one velocity")
        self.done(mlcp_problem_body_add_sparse(self.handle, size32(matrix.rows, "rows of mass"), i32(matrix.pointers),
                                               i32(matrix.indices), f64(matrix.values), matrix.triangle(triangle), &id))
        return id

    def set_mass(self, int32_t body, mass):
        """New mass of a body: (d, d), or for a sparse body its values in the order in which they were given."""
        self.editable()
        cdef cnp.ndarray values = real(np.asarray(mass), "mass").reshape(-1)
        self.done(mlcp_problem_body_set_mass(self.handle, body, f64(values), values.shape[0]))

    def remove_body(self, int32_t body):
        """Removes a body to which no row refers. The velocities behind it move up; its id is given out again."""
        self.editable()
        self.done(mlcp_problem_body_remove(self.handle, body))

    @property
    def bodies(self):
        """Ids of the bodies, ascending, int32: the order of their velocities in v and k."""
        cdef int32_t count = mlcp_problem_body_count(self.handle)
        cdef cnp.ndarray ids = np.empty(count, np.int32)
        check(mlcp_problem_bodies(self.handle, count, i32(ids), &count))
        return ids

    def body_slice(self, int32_t body):
        """Where the velocities of a body stand in v and k."""
        cdef int32_t first = 0, dimension = 0
        if mlcp_problem_body_range(self.handle, body, &first, &dimension) != MLCP_OK:
            raise errors.RangeError(f"body = {body}: there is no such body")
        return slice(first, first + dimension)

    def set_prescribed(self, int32_t body, velocity=0.0):
        """Makes a body prescribed (static, kinematic, asleep): its velocity is given, (d,) or a number."""
        self.editable()
        span = self.body_slice(body)
        cdef cnp.ndarray values = doubles(velocity, "velocity", span.stop - span.start)
        self.done(mlcp_problem_body_set_prescribed(self.handle, body, f64(values), values.shape[0]))

    def set_dynamic(self, int32_t body):
        """Makes a body dynamic, as it is when added."""
        self.editable()
        self.done(mlcp_problem_body_set_dynamic(self.handle, body))

    def given_velocity(self, int32_t body):
        """The velocity of a prescribed body, (d,); None for a dynamic one."""
        span = self.body_slice(body)
        cdef cnp.ndarray velocity = np.empty(span.stop - span.start)
        cdef int32_t prescribed = 0
        check(mlcp_problem_body_state(self.handle, body, &prescribed, velocity.shape[0], f64(velocity)))
        return velocity if prescribed else None

    @property
    def momentum(self):
        """k, N·s, a copy."""
        cdef cnp.ndarray k = np.empty(mlcp_problem_velocity_count(self.handle))
        check(mlcp_problem_get_momentum(self.handle, k.shape[0], f64(k)))
        return k

    def set_momentum(self, k, int32_t first=0):
        """k of the velocities from `first` on, N·s."""
        self.editable()
        cdef cnp.ndarray values = doubles(k, "k", -1)
        self.done(mlcp_problem_set_momentum(self.handle, first, size32(values.shape[0], "length of k"), f64(values)))

    def set_timestep_momentum(self, double h, v, q):
        """k = M v + h q of every body.

        Parameters
        ----------
        h : float
            Step, s, > 0.
        v, q : (n,) array or number
            Velocities and generalised forces at the start of the step, the gyroscopic ones included.
        """
        self.editable()
        cdef int32_t n = mlcp_problem_velocity_count(self.handle)
        cdef cnp.ndarray velocity = doubles(v, "v", n), force = doubles(q, "q", n)
        self.done(mlcp_timestep_momentum(self.handle, h, n, f64(velocity), f64(force)))

    # --------------------------------------------------------------------------------------------------------- rows

    def add_rows(self, body_a=None, body_b=None, jacobian_a=None, jacobian_b=None, *, r=0.0, lo=0.0, hi=np.inf, compliance=0.0,
                 keys=None):
        """Adds rows between bodies.

        Parameters
        ----------
        body_a, body_b : (count,) array of ids, or one id for all, optional
            None, or −1 in the array: the world.
        jacobian_a, jacobian_b : (count, d) array, optional
            The row's entries for that body; what stands there for the world does not matter. float64 rows may lie any distance
            apart, they are read in place.
        r, lo, hi, compliance : (count,) array or number
        keys : (count,) array of integers ≥ 0, optional

        Returns
        -------
        range
            Indices of the rows.
        """
        self.editable()
        cdef mlcp_rows rows
        mlcp_rows_init(&rows, sizeof(mlcp_rows))
        given = [np.asarray(x) for x in (jacobian_b, jacobian_a, body_b, body_a, r, lo, hi, compliance, keys) if x is not None]
        cdef Py_ssize_t count = next((x.shape[0] for x in given if x.ndim), 1)
        rows.count = size32(count, "count")
        cdef cnp.ndarray a = self.row_bodies(body_a, "body_a", count), b = self.row_bodies(body_b, "body_b", count)
        cdef cnp.ndarray ja = self.row_blocks(jacobian_a, "jacobian_a", count, 1, a)
        cdef cnp.ndarray jb = self.row_blocks(jacobian_b, "jacobian_b", count, 1, b)
        cdef cnp.ndarray r_ = doubles(r, "r", count), lo_ = doubles(lo, "lo", count), hi_ = doubles(hi, "hi", count)
        cdef cnp.ndarray compliance_ = doubles(compliance, "compliance", count)
        cdef cnp.ndarray keys_ = None if keys is None else keys_of(keys, "keys", count)
        rows.body_a, rows.body_b, rows.jacobian_a, rows.jacobian_b = i32(a), i32(b), f64(ja), f64(jb)
        rows.jacobian_a_stride = 0 if ja is None else ja.strides[0]
        rows.jacobian_b_stride = 0 if jb is None else jb.strides[0]
        rows.r, rows.lo, rows.hi, rows.compliance, rows.key = f64(r_), f64(lo_), f64(hi_), f64(compliance_), u64(keys_)
        cdef int32_t first = 0
        self.done(mlcp_problem_rows_add(self.handle, &rows, &first))
        return range(first, first + count)

    cdef cnp.ndarray row_bodies(self, object ids, str name, Py_ssize_t count):
        return None if ids is None else indices_or_one(ids, name, count)

    cdef cnp.ndarray row_blocks(self, object blocks, str name, Py_ssize_t count, Py_ssize_t each, cnp.ndarray ids):
        """(count, each d) with every row contiguous; the rows may lie apart. Every body that is not the world has dimension d."""
        if blocks is None or ids is None:
            if blocks is not None:
                raise errors.ArgumentError(f"{name} is given, but all of body_{name[len(name) - 1:]} are the world")
            return None
        cdef cnp.ndarray array = np.asarray(blocks)
        if array.ndim != 2 or array.shape[0] != count:
            raise errors.RangeError(f"{name} has shape {np.shape(blocks)}, not ({count}, d)")
        if array.dtype != np.float64 or not array.flags.aligned or array.strides[0] <= 0 or (
                array.shape[1] > 1 and array.strides[1] != sizeof(double)):
            array = real(array, name)
        cdef int32_t dimension = 0
        cdef int32_t *id = i32(ids)
        cdef Py_ssize_t i
        for i in range(count):
            if id[i] != MLCP_WORLD and mlcp_problem_body_range(self.handle, id[i], NULL, &dimension) == MLCP_OK \
                    and each * dimension != array.shape[1]:
                raise errors.RangeError(f"{name} has {array.shape[1] // each} columns, but body {id[i]} of {'row' if each == 1 else 'contact'} "
                                        f"{i} has {dimension} velocities")
        return array

    def add_row(self, columns, values, double r=0.0, double lo=0.0, double hi=np.inf, double compliance=0.0, uint64_t key=0):
        """Adds one row with the entries values[i] at the velocities columns[i]; returns its index."""
        self.editable()
        cdef cnp.ndarray at = indices(columns, "columns", -1)
        cdef cnp.ndarray entries = doubles(values, "values", at.shape[0])
        cdef int32_t index = -1
        self.done(mlcp_problem_row_add(self.handle, size32(at.shape[0], "length of columns"), i32(at), f64(entries), r, lo, hi,
                                       compliance, key, &index))
        return index

    def add_matrix_rows(self, jacobian, r=0.0, lo=0.0, hi=np.inf, *, compliance=0.0, keys=None):
        """Adds the rows of a matrix over all velocities.

        Parameters
        ----------
        jacobian : (count, n) sparse or dense
            CSR and CSC are read in place, in any order of entries, without duplicates; other forms are converted. Zeros of
            a dense matrix are no entries.
        r, lo, hi, compliance : (count,) array or number
        keys : (count,) array of integers ≥ 0, optional

        Returns
        -------
        range
            Indices of the rows.
        """
        self.editable()
        cdef Compressed matrix = Compressed(jacobian, "jacobian")
        cdef Py_ssize_t count = matrix.rows
        if matrix.columns != self.velocities:
            raise errors.RangeError(f"jacobian has {matrix.columns} columns, the problem {self.velocities} velocities")
        cdef cnp.ndarray r_ = doubles(r, "r", count), lo_ = doubles(lo, "lo", count), hi_ = doubles(hi, "hi", count)
        cdef cnp.ndarray compliance_ = doubles(compliance, "compliance", count)
        cdef cnp.ndarray keys_ = None if keys is None else keys_of(keys, "keys", count)
        cdef int32_t first = 0, rows = size32(count, "rows of jacobian")
        if matrix.by_rows:
            self.done(mlcp_problem_rows_add_csr(self.handle, rows, i32(matrix.pointers), i32(matrix.indices), f64(matrix.values),
                                                f64(r_), f64(lo_), f64(hi_), f64(compliance_), u64(keys_), &first))
        else:
            self.done(mlcp_problem_rows_add_csc(self.handle, rows, i32(matrix.pointers), i32(matrix.indices), f64(matrix.values),
                                                f64(r_), f64(lo_), f64(hi_), f64(compliance_), u64(keys_), &first))
        return range(first, first + count)

    def set_compliance_matrix(self, compliance, triangle="full"):
        """Σ as a whole, (m, m) sparse or dense, symmetric, m/(N·s); rows that are added later have only their diagonal."""
        self.editable()
        cdef Compressed matrix = Compressed(compliance, "compliance")
        if matrix.rows != self.rows or matrix.columns != self.rows:
            raise errors.RangeError(f"compliance has shape ({matrix.rows}, {matrix.columns}), the problem {self.rows} rows")
        self.done(mlcp_problem_set_compliance_matrix(self.handle, matrix.rows, i32(matrix.pointers), i32(matrix.indices),
                                                     f64(matrix.values), matrix.triangle(triangle)))

    cdef Py_ssize_t rest(self, object values, int32_t first):
        """How many rows a value stands for: its length, or all from `first` on if it is a number."""
        return -1 if np.ndim(values) else max(0, self.rows - first)

    def set_r(self, r, int32_t first=0):
        """r of the rows from `first` on, m/s; a number stands for all of them."""
        self.editable()
        cdef cnp.ndarray values = doubles(r, "r", self.rest(r, first))
        self.done(mlcp_problem_rows_set_r(self.handle, first, size32(values.shape[0], "length of r"), f64(values)))

    def set_bounds(self, lo, hi, int32_t first=0):
        """Bounds of the rows from `first` on, N·s; a number stands for all of them, or for as many as the other one has."""
        self.editable()
        cdef cnp.ndarray lower = doubles(lo, "lo", len(hi) if np.ndim(hi) and not np.ndim(lo) else self.rest(lo, first))
        cdef cnp.ndarray upper = doubles(hi, "hi", lower.shape[0])
        self.done(mlcp_problem_rows_set_bounds(self.handle, first, size32(lower.shape[0], "length of lo"), f64(lower), f64(upper)))

    def set_compliance(self, compliance, int32_t first=0):
        """Diagonal of Σ of the rows from `first` on, m/(N·s)."""
        self.editable()
        cdef cnp.ndarray values = doubles(compliance, "compliance", self.rest(compliance, first))
        self.done(mlcp_problem_rows_set_compliance(self.handle, first, size32(values.shape[0], "length of compliance"), f64(values)))

    def set_keys(self, keys, int32_t first=0):
        """Keys of the rows from `first` on."""
        self.editable()
        cdef cnp.ndarray values = keys_of(keys, "keys", len(keys))
        self.done(mlcp_problem_rows_set_keys(self.handle, first, size32(values.shape[0], "length of keys"), u64(values)))

    def set_jacobian(self, int32_t row, values):
        """Entries of one row, in the order in which they were added (body_a's block, then body_b's); the pattern stays."""
        self.editable()
        cdef cnp.ndarray entries = doubles(values, "values", -1)
        self.done(mlcp_problem_row_set_jacobian(self.handle, row, f64(entries), size32(entries.shape[0], "length of values")))

    def remove_rows(self, rows):
        """Removes different rows; those behind move up, their order stays."""
        self.editable()
        cdef cnp.ndarray which = indices(rows, "rows", -1)
        self.done(mlcp_problem_rows_remove(self.handle, size32(which.shape[0], "length of rows"), i32(which)))

    def clear_rows(self):
        """Removes all rows; bodies stay. O(1)."""
        self.editable()
        self.done(mlcp_problem_rows_clear(self.handle))

    cdef object row_values(self, int which):
        """r, lo, hi, diagonal of Σ by number."""
        cdef cnp.ndarray values = np.empty(mlcp_problem_row_count(self.handle))
        cdef double *at[4]
        at[0] = at[1] = at[2] = at[3] = NULL
        at[which] = f64(values)
        check(mlcp_problem_get_rows(self.handle, values.shape[0], at[0], at[1], at[2], at[3], NULL))
        return values

    @property
    def r(self):
        """Right-hand side, (m,), m/s, a copy."""
        return self.row_values(0)

    @property
    def lo(self):
        """Lower bounds of the impulses, (m,), N·s, a copy."""
        return self.row_values(1)

    @property
    def hi(self):
        """Upper bounds of the impulses, (m,), N·s, a copy."""
        return self.row_values(2)

    @property
    def compliance(self):
        """Diagonal of Σ, (m,), m/(N·s), a copy."""
        return self.row_values(3)

    @property
    def keys(self):
        """Keys of the rows, (m,) uint64, a copy."""
        cdef cnp.ndarray keys = np.empty(mlcp_problem_row_count(self.handle), np.uint64)
        check(mlcp_problem_get_rows(self.handle, keys.shape[0], NULL, NULL, NULL, NULL, u64(keys)))
        return keys

    # ----------------------------------------------------------------------------------------------------- contacts

    def add_contacts(self, body_a=None, body_b=None, jacobian_a=None, jacobian_b=None, *, mu=0.0, model="coulomb", bound=np.inf, r=0.0,
                     compliance=0.0, facets=0, keys=None):
        """Adds contacts with friction: each a normal row, 0 ≤ γ, and right behind it its tangent rows, one in the plane, two in space.

        Parameters
        ----------
        body_a, body_b : (count,) array of ids, or one id for all, optional
            None, or −1 in the array: the world.
        jacobian_a, jacobian_b : (count, dimension, d) array, optional
            The rows for that body, the normal first; dimension 2 in the plane, 3 in space. float64 contacts may lie any distance apart,
            they are read in place.
        mu : (count,) array or number
            Coefficient of friction, ≥ 0.
        model : str or (count,) sequence of str
            "none": the tangent rows are left out. "convex": the impulse in the cone, the slack in its dual; a sliding contact opens by μ
            times its slip. "coulomb": Coulomb's law. "box": −bound ≤ γ_T ≤ bound. "findex": −μ γ_n ≤ γ_T ≤ μ γ_n.
        bound : (count,) array or number
            Of model "box", N·s.
        r, compliance : (count, dimension) array or number
            A number stands for all rows, the tangents included.
        facets : (count,) array of integers or int
            0: as the solver's `facets` says; else the generators of a pyramid in the cone, at least 3 in space.
        keys : (count,) array of integers ≥ 0, optional
            One a contact, for all its rows.

        Returns
        -------
        range
            Indices of the rows, `dimension` a contact.
        """
        self.editable()
        shape = next((np.shape(x) for x in (jacobian_b, jacobian_a) if x is not None), None)
        if shape is None or len(shape) != 3:
            raise errors.RangeError("contacts need jacobian_a or jacobian_b of shape (count, dimension, d)")
        cdef mlcp_contacts contacts
        mlcp_contacts_init(&contacts, sizeof(mlcp_contacts))
        cdef Py_ssize_t count = shape[0], dimension = shape[1]
        contacts.count, contacts.dimension = size32(count, "count"), size32(dimension, "dimension")
        cdef cnp.ndarray a = self.row_bodies(body_a, "body_a", count), b = self.row_bodies(body_b, "body_b", count)
        cdef cnp.ndarray ja = self.contact_blocks(jacobian_a, "jacobian_a", count, dimension, a)
        cdef cnp.ndarray jb = self.contact_blocks(jacobian_b, "jacobian_b", count, dimension, b)
        cdef cnp.ndarray r_ = contact_vectors(r, "r", count, dimension)
        cdef cnp.ndarray compliance_ = contact_vectors(compliance, "compliance", count, dimension)
        cdef cnp.ndarray mu_ = doubles(mu, "mu", count), bound_ = doubles(bound, "bound", count)
        cdef cnp.ndarray model_ = friction_numbers(model, count), facets_ = indices_or_one(facets, "facets", count)
        cdef cnp.ndarray keys_ = None if keys is None else keys_of(keys, "keys", count)
        contacts.body_a, contacts.body_b, contacts.jacobian_a, contacts.jacobian_b = i32(a), i32(b), f64(ja), f64(jb)
        contacts.jacobian_a_stride = 0 if ja is None else ja.strides[0]
        contacts.jacobian_b_stride = 0 if jb is None else jb.strides[0]
        contacts.r, contacts.compliance, contacts.mu, contacts.bound = f64(r_), f64(compliance_), f64(mu_), f64(bound_)
        contacts.model, contacts.facets, contacts.key = i32(model_), i32(facets_), u64(keys_)
        cdef int32_t first = 0
        self.done(mlcp_problem_contacts_add(self.handle, &contacts, &first))
        return range(first, first + count * dimension)

    cdef cnp.ndarray contact_blocks(self, object blocks, str name, Py_ssize_t count, Py_ssize_t dimension, cnp.ndarray ids):
        if blocks is None:
            return self.row_blocks(None, name, count, dimension, ids)
        array = np.asarray(blocks)
        if array.ndim != 3 or array.shape[:2] != (count, dimension):
            raise errors.RangeError(f"{name} has shape {array.shape}, not ({count}, {dimension}, d)")
        # a view where the rows of a contact lie one behind the other
        return self.row_blocks(array.reshape(count, dimension * array.shape[2]), name, count, dimension, ids)

    def declare_contacts(self, rows, int32_t dimension=3, *, mu=0.0, model="coulomb", bound=np.inf, facets=0):
        """Makes contacts of rows that are there: rows[c] is a normal, the dimension − 1 rows behind it are its tangents.

        For rows of a matrix, and for reduced problems, whose A is the Delassus matrix. The bounds of a normal must be 0 and inf, those
        of the tangents are set as the model has them. Other parameters as in `add_contacts`.
        """
        self.editable()
        cdef cnp.ndarray at = indices(rows, "rows", -1)
        cdef Py_ssize_t count = at.shape[0]
        cdef cnp.ndarray mu_ = doubles(mu, "mu", count), bound_ = doubles(bound, "bound", count)
        cdef cnp.ndarray model_ = friction_numbers(model, count), facets_ = indices_or_one(facets, "facets", count)
        self.done(mlcp_problem_contacts_declare(self.handle, size32(count, "length of rows"), dimension, i32(at), i32(model_), f64(mu_),
                                                f64(bound_), i32(facets_)))

    def set_friction(self, int32_t first=0, count=None, *, mu=None, model=None, bound=None, facets=None):
        """New friction of `count` contacts from `first` on (None: all of them), in order of adding; None leaves what there is."""
        self.editable()
        cdef int32_t many = size32(max(0, self.contact_count - first) if count is None else count, "count")
        cdef cnp.ndarray mu_ = None if mu is None else doubles(mu, "mu", many)
        cdef cnp.ndarray bound_ = None if bound is None else doubles(bound, "bound", many)
        cdef cnp.ndarray model_ = None if model is None else friction_numbers(model, many)
        cdef cnp.ndarray facets_ = None if facets is None else indices_or_one(facets, "facets", many)
        self.done(mlcp_problem_contacts_set_friction(self.handle, first, many, i32(model_), f64(mu_), f64(bound_), i32(facets_)))

    @property
    def contact_count(self):
        """Number of contacts."""
        return mlcp_problem_contact_count(self.handle)

    @property
    def contacts(self):
        """The contacts, as `Contacts`, copies."""
        cdef int32_t count = mlcp_problem_contact_count(self.handle)
        cdef cnp.ndarray row = np.empty(count, np.int32), dimension = np.empty(count, np.int32), model = np.empty(count, np.int32)
        cdef cnp.ndarray mu = np.empty(count), facets = np.empty(count, np.int32)
        check(mlcp_problem_get_contacts(self.handle, count, i32(row), i32(dimension), i32(model), f64(mu), i32(facets)))
        return records.Contacts(row, dimension, [chosen(number, friction_models) for number in model], mu, facets)

    def set_findex(self, findex, int32_t first=0):
        """The findex array of ODE, Bullet and DART for the rows from `first` on: findex[i] ≥ 0 makes lo and hi of the row factors of the
        impulse of row findex[i]; −1: plain bounds."""
        self.editable()
        cdef cnp.ndarray values = indices(findex, "findex", -1)
        self.done(mlcp_problem_rows_set_findex(self.handle, first, size32(values.shape[0], "length of findex"), i32(values)))

    @property
    def findex(self):
        """Of each row the one whose impulse its bounds follow, −1: none; (m,) int32, a copy."""
        cdef cnp.ndarray values = np.empty(mlcp_problem_row_count(self.handle), np.int32)
        check(mlcp_problem_get_findex(self.handle, values.shape[0], i32(values)))
        return values

    # ----------------------------------------------------------------------------------------------------- matrices

    cdef object matrix(self, const mlcp_matrix_view *view, bint by_rows, bint copy):
        parts = (lend(self, view.values, view.entries, "f8"), lend(self, view.indices, view.entries, "i4"),
                 lend(self, view.pointers, 1 + (view.rows if by_rows else view.columns), "i4"))
        make = scipy.sparse.csr_array if by_rows else scipy.sparse.csc_array
        return make(parts, shape=(view.rows, view.columns), copy=copy)

    def mass(self, copy=True):
        """M with both triangles, (n, n) csc_array.

        Parameters
        ----------
        copy : bool
            False: arrays that look into the problem, read-only. They keep it alive, and as long as they are alive it cannot change.
        """
        cdef mlcp_matrix_view view
        mlcp_matrix_view_init(&view, sizeof(mlcp_matrix_view))
        check(mlcp_problem_mass(self.handle, &view))
        return self.matrix(&view, False, copy)

    def jacobian(self, copy=True):
        """J, (m, n) csr_array, entries in no particular order; `copy` as in `mass`."""
        cdef mlcp_matrix_view view
        mlcp_matrix_view_init(&view, sizeof(mlcp_matrix_view))
        check(mlcp_problem_jacobian(self.handle, &view))
        return self.matrix(&view, True, copy)

    def compliance_matrix(self, copy=True):
        """Σ with both triangles, (m, m) csc_array; `copy` as in `mass`."""
        cdef mlcp_matrix_view view
        mlcp_matrix_view_init(&view, sizeof(mlcp_matrix_view))
        check(mlcp_problem_compliance(self.handle, &view))
        return self.matrix(&view, False, copy)


cdef bint begins_as_hdf5(object path) except -1:
    """A file that cannot be opened does not; whoever reads it says why."""
    try:
        with open(path, "rb") as file:
            return file.read(8) == b"\x89HDF\r\n\x1a\n"
    except OSError:
        return False


cdef cnp.ndarray friction_numbers(object model, Py_ssize_t count):
    """mlcp_friction of `count` contacts; one name stands for all."""
    if isinstance(model, str):
        return np.full(count, choice("model", model, friction_models), np.int32)
    return indices(np.array([choice(f"model[{i}]", name, friction_models) for i, name in enumerate(model)], np.int32), "model", count)


cdef cnp.ndarray indices_or_one(object values, str name, Py_ssize_t count):
    """int32, `count` long; a number stands for all."""
    return indices(np.full(count, values) if np.ndim(values) == 0 else values, name, count)


cdef cnp.ndarray contact_vectors(object values, str name, Py_ssize_t count, Py_ssize_t dimension):
    """float64, `dimension` a contact; a number stands for all."""
    if np.ndim(values) and np.shape(values) != (count, dimension):
        raise errors.RangeError(f"{name} has shape {np.shape(values)}, not ({count}, {dimension})")
    return doubles(np.ravel(values) if np.ndim(values) else values, name, count * dimension)
