"""Peers that are C++ libraries: a shared library each, see tests/bench/native/dense_peer.h."""
import ctypes as c
import subprocess
import time

import numpy as np

from . import DUAL_DENSE, Outcome

folder = None  # where the shared libraries were built; set before the first use


def _path(name):
    return None if folder is None else folder / f"libmlcp_bench_{name}.so"


def debian_version(package):
    done = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True)
    return done.stdout or "unknown"


class NativePeer:
    forms = (DUAL_DENSE,)
    settings = {"": {}}
    timer = "ours, in C++, around its solve alone"

    @classmethod
    def available(cls):
        return _path(cls.library) is not None and _path(cls.library).exists()

    def __init__(self, problem, _):
        doubles = c.POINTER(c.c_double)
        self._solve = c.CDLL(str(_path(self.library))).bench_dense_solve
        self._solve.argtypes = [c.c_int32, c.c_int32, *6 * (doubles,)]
        # rows that push both ways come first
        self._order = order = np.argsort(~problem.bilateral, kind="stable")
        qp = problem.dual
        self._arrays = [np.ascontiguousarray(x) for x in (qp.dense_H[np.ix_(order, order)], qp.g[order], qp.lo[order], qp.hi[order])]
        self._bilateral = int(np.count_nonzero(problem.bilateral))

    def cold(self):
        start = time.perf_counter()
        sorted_gamma, seconds = np.zeros(len(self._order)), np.zeros(1)
        pointers = [x.ctypes.data_as(c.POINTER(c.c_double)) for x in (*self._arrays, sorted_gamma, seconds)]
        failed = self._solve(len(self._order), self._bilateral, *pointers)
        gamma = np.empty_like(sorted_gamma)
        gamma[self._order] = sorted_gamma
        return Outcome(float(seconds[0]), time.perf_counter() - start, failed == 0, None, gamma)

    known = cold  # nothing is kept from one solve to the next
