"""DAQP: a dual active-set method for small dense problems."""
import time

import numpy as np

from . import DUAL_DENSE, PRIMAL_DENSE, Outcome, Packaged

INFINITE = 1e30
EQUALITY = 5  # its code for a row that always holds


class Peer(Packaged):
    name = "DAQP"
    module, package = "daqp", "daqp"
    forms = (PRIMAL_DENSE, DUAL_DENSE)
    settings = {f"{tolerance:g}{', no prox' if prox == 0 else ''}": {"tolerance": tolerance, "prox": prox}
                for tolerance in (1e-6, 1e-9, 1e-12) for prox in (None, 0.0)}
    timer = "its own, as setup() returns it, + solve_time; ours around update"

    def __init__(self, problem, form, tolerance, prox):
        import daqp
        self._daqp, self._dual = daqp, form == DUAL_DENSE
        self._settings = {"primal_tol": tolerance, "dual_tol": tolerance, "iter_limit": 100 * (problem.m + problem.n + 10)}
        if prox is not None:
            self._settings["eps_prox"] = prox
        if self._dual:
            qp = problem.dual
            rows, lower, upper = np.zeros((0, problem.m)), qp.lo, qp.hi
            sense = np.zeros(problem.m, np.int32)
        else:
            qp = problem.primal
            rows, lower, upper = qp.dense_C, qp.l, qp.u
            sense = np.where(problem.bilateral, EQUALITY, 0).astype(np.int32)
        self._data = (qp.dense_H, qp.g, rows, np.minimum(upper, INFINITE), np.maximum(lower, -INFINITE), sense)
        self._model = None

    def cold(self):
        start = time.perf_counter()
        self._model = self._daqp.Model()
        self._model.settings = self._settings
        _, setup_time = self._model.setup(*self._data)
        return self._solve(start, setup_time)

    def known(self):
        if self._model is None:
            self.cold()
        H, f, rows, upper, lower, sense = self._data
        start = time.perf_counter()
        if self._dual:
            self._model.update(H=H, f=f, bupper=upper, blower=lower, sense=sense)
        else:
            self._model.update(H=H, f=f, A=rows, bupper=upper, blower=lower, sense=sense)
        return self._solve(start, time.perf_counter() - start)

    def _solve(self, start, prepared):
        # info["setup_time"] stays 0 with a Model
        x, _, flag, info = self._model.solve()
        around = time.perf_counter() - start
        gamma = x if self._dual else -np.asarray(info["lam"])
        return Outcome(prepared + info["solve_time"], around, flag > 0, None if self._dual else np.asarray(x), np.asarray(gamma))
