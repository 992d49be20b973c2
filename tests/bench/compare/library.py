"""The shared library of tests/bench/native, through ctypes."""
import ctypes as c
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

COLD, KNOWN, WARM = 0, 1, 2
SOLVED = 0


class MatrixView(c.Structure):
    """mlcp_matrix_view"""
    _fields_ = [("struct_size", c.c_size_t), ("rows", c.c_int32), ("columns", c.c_int32), ("entries", c.c_int64),
                ("pointers", c.POINTER(c.c_int32)), ("indices", c.POINTER(c.c_int32)), ("values", c.POINTER(c.c_double))]


def _array(pointer, count, dtype):
    return np.ctypeslib.as_array(pointer, (count,)).astype(dtype) if count else np.empty(0, dtype)


def _doubles(array):
    return array.ctypes.data_as(c.POINTER(c.c_double))


class Library:
    """Loads libmlcp_bench.so. Everything that fails raises RuntimeError with the library's own text."""

    def __init__(self, path):
        self.path = path
        self._lib = lib = c.CDLL(str(path))
        handle, i32, text, doubles = c.c_void_p, c.c_int32, c.c_char_p, c.POINTER(c.c_double)
        for name, result, *arguments in (
                ("bench_error", text), ("mlcp_version", text), ("mlcp_method_text", text, i32),
                ("bench_scene", handle, text, i32), ("bench_read", handle, text),
                ("bench_record", c.c_int, text, i32, c.c_uint32, c.c_double, i32, i32, handle), ("bench_plain", handle, handle, i32),
                ("bench_join", handle, handle, i32),
                ("mlcp_problem_create", i32, handle, handle), ("mlcp_problem_error", text, handle),
                ("mlcp_problem_body_add_sparse", i32, handle, i32, handle, handle, handle, i32, handle),
                ("mlcp_problem_set_momentum", i32, handle, i32, i32, doubles),
                ("mlcp_problem_rows_add_csr", i32, handle, i32, handle, handle, handle, doubles, doubles, doubles, handle, handle, handle),
                ("mlcp_problem_destroy", None, handle), ("mlcp_problem_velocity_count", i32, handle),
                ("mlcp_problem_row_count", i32, handle), ("mlcp_problem_get_momentum", i32, handle, i32, doubles),
                ("mlcp_problem_get_rows", i32, handle, i32, doubles, doubles, doubles, doubles, handle),
                ("mlcp_matrix_view_init", None, handle, c.c_size_t), ("mlcp_problem_mass", i32, handle, handle),
                ("mlcp_problem_jacobian", i32, handle, handle), ("mlcp_problem_compliance", i32, handle, handle),
                ("bench_run_create", handle, handle, i32, c.c_double, i32), ("bench_run_destroy", None, handle),
                ("bench_run_time", c.c_int, handle, i32, i32, doubles),
                ("bench_run_result", c.c_int, handle, doubles, doubles, c.POINTER(i32), doubles),
                ("bench_oracle", c.c_int, handle, i32, doubles, doubles),
                ("bench_sequence", c.c_int, handle, i32, i32, c.c_double, i32, doubles, doubles, c.POINTER(i32), doubles),
                ("bench_candidate_rows", c.c_int, handle, i32, i32, i32, doubles, doubles), ("bench_allocations", c.c_int64, handle, i32),
                ("bench_dual_create", handle, handle), ("bench_dual_destroy", None, handle),
                ("bench_dual_time", c.c_int, handle, i32, doubles, doubles), ("bench_dual_view", None, handle, *5 * (handle,))):
            function = getattr(lib, name)
            function.restype, function.argtypes = result, list(arguments)

    def _check(self, failed):
        if failed:
            raise RuntimeError(self._lib.bench_error().decode())

    def methods(self):
        """Number and name of every method that this build knows."""
        names, number = {}, 0
        while (name := self._lib.mlcp_method_text(number).decode()) not in ("", "unknown"):
            names[number] = name
            number += 1
        return names

    def version(self):
        return self._lib.mlcp_version().decode()

    def rows(self, handle):
        return self._lib.mlcp_problem_row_count(handle)

    def clone(self, problem):
        """A problem of another Library's as one of this."""
        return self.assemble(problem.M, problem.J, problem.k, problem.r, problem.lo, problem.hi)

    def scene(self, family, size):
        return self._handle(self._lib.bench_scene(family.encode(), size))

    def read(self, path):
        return self._handle(self._lib.bench_read(str(path).encode()))

    def assemble(self, M, J, k, r, lo, hi):
        """A problem from matrices: one body, both of its triangles, and rows."""
        M, J = M.tocsc().astype(float), J.tocsr().astype(float)
        k, r, lo, hi = (np.ascontiguousarray(x, float) for x in (k, r, lo, hi))
        handle = c.c_void_p()
        pointers = [x.astype(t).ctypes for x, t in ((M.indptr, np.int32), (M.indices, np.int32), (M.data, float),
                                                    (J.indptr, np.int32), (J.indices, np.int32), (J.data, float))]
        n, m = M.shape[0], J.shape[0]
        failed = (self._lib.mlcp_problem_create(None, c.addressof(handle))
                  or self._lib.mlcp_problem_body_add_sparse(handle, n, *(p.data for p in pointers[:3]), 0, None)
                  or self._lib.mlcp_problem_set_momentum(handle, 0, n, _doubles(k))
                  or self._lib.mlcp_problem_rows_add_csr(handle, m, *(p.data for p in pointers[3:]), _doubles(r), _doubles(lo), _doubles(hi),
                                                         None, None, None))
        if failed:
            raise RuntimeError(self._lib.mlcp_problem_error(handle).decode())
        return handle.value

    def record(self, scene, size, seed, h, first, steps):
        """Handles of consecutive steps as the scene made them."""
        handles = (c.c_void_p * steps)()
        self._check(self._lib.bench_record(scene.encode(), size, seed, h, first, steps, handles))
        return list(handles)

    def plain(self, handle, facets):
        """Without contacts and prescribed bodies: a pyramid of so many facets for every friction cone, 0: frictionless."""
        return self._handle(self._lib.bench_plain(handle, facets))

    def join(self, handles):
        """Side by side."""
        return self._handle(self._lib.bench_join((c.c_void_p * len(handles))(*handles), len(handles)))

    def sequence(self, handles, method, tolerance, warm, oracle=False):
        """Seconds, errors, outcomes, and seconds of the oracle (None without), a number a step."""
        count = len(handles)
        steps = (c.c_void_p * count)(*handles)
        seconds, error, factorize = np.empty(count), np.empty(count), np.empty(count)
        outcome = np.empty(count, np.int32)
        self._check(self._lib.bench_sequence(steps, count, method, tolerance, warm, _doubles(seconds), _doubles(error),
                                             outcome.ctypes.data_as(c.POINTER(c.c_int32)), _doubles(factorize) if oracle else None))
        return seconds, error, outcome, factorize if oracle else None

    def candidate_rows(self, handle, stride, known, turns):
        """Seconds of a solve with every stride-th row enabled, and of one with only those rows."""
        masked, alone = np.empty(1), np.empty(1)
        self._check(self._lib.bench_candidate_rows(handle, stride, known, turns, _doubles(masked), _doubles(alone)))
        return float(masked[0]), float(alone[0])

    def allocations(self, handle, method=0):
        """Allocator calls of a step on a known pattern."""
        count = self._lib.bench_allocations(handle, method)
        self._check(count < 0)
        return count

    def _handle(self, handle):
        self._check(not handle)
        return handle

    def destroy(self, handle):
        self._lib.mlcp_problem_destroy(handle)

    def matrix(self, handle, which):
        """"mass" (compressed columns), "jacobian" (compressed rows) or "compliance" (compressed columns)."""
        view = MatrixView()
        self._lib.mlcp_matrix_view_init(c.byref(view), c.sizeof(view))
        self._check(getattr(self._lib, f"mlcp_problem_{which}")(handle, c.byref(view)))
        outer = view.rows if which == "jacobian" else view.columns
        kind = sp.csr_matrix if which == "jacobian" else sp.csc_matrix
        parts = (_array(view.values, view.entries, float), _array(view.indices, view.entries, np.int32),
                 _array(view.pointers, outer + 1, np.int32))
        matrix = kind(parts, shape=(view.rows, view.columns))
        matrix.sort_indices()
        return matrix

    def vectors(self, handle):
        """k, r, lo, hi"""
        n, m = self._lib.mlcp_problem_velocity_count(handle), self._lib.mlcp_problem_row_count(handle)
        k, r, lo, hi = np.empty(n), np.empty(m), np.empty(m), np.empty(m)
        self._check(self._lib.mlcp_problem_get_momentum(handle, n, _doubles(k)))
        self._check(self._lib.mlcp_problem_get_rows(handle, m, _doubles(r), _doubles(lo), _doubles(hi), None, None))
        return k, r, lo, hi


@dataclass
class Answer:
    v: np.ndarray
    gamma: np.ndarray
    outcome: int
    own_error: float


class Run:
    """The library on one problem with one setting."""

    def __init__(self, library, handle, n, m, method, tolerance, threads=1):
        self._lib, self._library, self._sizes = library._lib, library, (n, m)
        self._run = library._handle(self._lib.bench_run_create(handle, method, tolerance, threads))

    def time(self, how, repeats):
        seconds = np.empty(repeats)
        self._library._check(self._lib.bench_run_time(self._run, how, repeats, _doubles(seconds)))
        return seconds

    def answer(self):
        v, gamma = (np.empty(size) for size in self._sizes)
        outcome, own = c.c_int32(), c.c_double()
        self._library._check(self._lib.bench_run_result(self._run, _doubles(v), _doubles(gamma), c.byref(outcome), c.byref(own)))
        return Answer(v, gamma, outcome.value, own.value)

    def oracle(self, repeats):
        """Seconds of analysis and of factorization with solve, for the active set of the last solve."""
        analyze, factorize = np.empty(repeats), np.empty(repeats)
        self._library._check(self._lib.bench_oracle(self._run, repeats, _doubles(analyze), _doubles(factorize)))
        return analyze, factorize

    def __del__(self):
        if run := getattr(self, "_run", None):
            self._lib.bench_run_destroy(run)


class Dual:
    """A = J M⁻¹Jᵀ + Σ and b = J M⁻¹k − r, formed in C++."""

    def __init__(self, library, handle, m):
        self._lib, self._library, self._m = library._lib, library, m
        self._dual = library._handle(self._lib.bench_dual_create(handle))

    def time(self, repeats):
        """Seconds for the pattern and for the numbers."""
        analyze, form = np.empty(repeats), np.empty(repeats)
        self._library._check(self._lib.bench_dual_time(self._dual, repeats, _doubles(analyze), _doubles(form)))
        return analyze, form

    def view(self):
        entries = c.c_int64()
        ints, doubles = c.POINTER(c.c_int32), c.POINTER(c.c_double)
        pointers, indices, values, b = ints(), ints(), doubles(), doubles()
        self._lib.bench_dual_view(self._dual, c.addressof(entries), *(c.addressof(p) for p in (pointers, indices, values, b)))
        parts = (_array(values, entries.value, float), _array(indices, entries.value, np.int32), _array(pointers, self._m + 1, np.int32))
        return sp.csc_matrix(parts, shape=(self._m, self._m)), _array(b, self._m, float)

    def __del__(self):
        if dual := getattr(self, "_dual", None):
            self._lib.bench_dual_destroy(dual)
