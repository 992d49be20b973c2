"""OSQP: ADMM, with and without its polish."""
import time

import numpy as np
import scipy.sparse as sp

from . import DUAL_SPARSE, PRIMAL_SPARSE, Outcome, Packaged


class Peer(Packaged):
    name = "OSQP"
    module, package = "osqp", "osqp"
    forms = (PRIMAL_SPARSE, DUAL_SPARSE)
    settings = {f"{tolerance:g}{', polish' if polish else ''}": {"tolerance": tolerance, "polish": polish}
                for tolerance in (1e-3, 1e-5, 1e-7, 1e-9) for polish in (False, True)}
    timer = "its own (run_time)"

    def __init__(self, problem, form, tolerance, polish):
        import osqp
        self._osqp, self._primal = osqp, form == PRIMAL_SPARSE
        qp = problem.primal if self._primal else problem.dual
        rows = qp.C if self._primal else sp.identity(problem.m, format="csc")
        lower, upper = (qp.l, qp.u) if self._primal else (qp.lo, qp.hi)
        self._data = (sp.triu(qp.H, format="csc"), qp.g, rows, lower, upper)
        # a known pattern is not a warm start
        self._settings = {"eps_abs": tolerance, "eps_rel": tolerance, "polishing": polish, "max_iter": 200000, "verbose": False,
                          "warm_starting": False}
        self._solver = None

    def cold(self):
        start = time.perf_counter()
        self._solver = self._osqp.OSQP(algebra="builtin")
        self._solver.setup(*self._data, **self._settings)
        return self._solve(start)

    def known(self):
        if self._solver is None:
            self.cold()
        P, q, A, lower, upper = self._data
        start = time.perf_counter()
        self._solver.update(Px=P.data, Ax=A.data, q=q, l=lower, u=upper)
        return self._solve(start)

    def _solve(self, start):
        result = self._solver.solve(raise_error=False)
        around = time.perf_counter() - start
        claimed = result.info.status_val == self._osqp.SolverStatus.OSQP_SOLVED
        x, y = np.array(result.x, float), np.array(result.y, float)
        return Outcome(result.info.run_time, around, claimed, *((x, -y) if self._primal else (None, x)))
