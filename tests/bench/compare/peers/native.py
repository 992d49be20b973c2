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


def help_with_ties(nudge, softness):
    """Dantzig's method as ODE has it gives up where a slack that is 0 comes out as −1e-19, and with redundant rows: a little of either
    leaves an error of that size and lets it go on."""
    return {"as given": {"nudge": 0.0, "softness": 0.0}, "ties broken": {"nudge": nudge, "softness": 0.0},
            "ties broken, soft": {"nudge": nudge, "softness": softness}}


class NativePeer:
    """nudge: b is made larger by up to so much of its largest entry, at random. softness: A's diagonal is made larger by so much of
    itself, as engines do (their CFM). See help_with_ties."""
    forms = (DUAL_DENSE,)
    settings = {"as given": {"nudge": 0.0, "softness": 0.0}}
    timer = "ours, in C++, around its solve alone"

    @classmethod
    def available(cls):
        return _path(cls.library) is not None and _path(cls.library).exists()

    def __init__(self, problem, _, nudge, softness):
        doubles = c.POINTER(c.c_double)
        self._solve = c.CDLL(str(_path(self.library))).bench_dense_solve
        self._solve.argtypes = [c.c_int32, c.c_int32, *6 * (doubles,)]
        # rows that push both ways come first
        self._order = order = np.argsort(~problem.bilateral, kind="stable")
        qp = problem.dual
        A = np.ascontiguousarray(qp.dense_H[np.ix_(order, order)])
        A[np.diag_indices(len(order))] *= 1 + softness
        b = qp.g[order]
        b += nudge * np.max(np.abs(b), initial=0) * np.random.default_rng(0).random(len(b))
        self._arrays = [A, b, qp.lo[order], qp.hi[order]]
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
