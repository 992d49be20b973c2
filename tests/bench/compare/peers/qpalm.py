"""QPALM: a proximal augmented Lagrangian method, sparse."""
import time

import numpy as np
import scipy.sparse as sp

from . import DUAL_SPARSE, PRIMAL_SPARSE, Outcome, Packaged

INFINITE = 1e20


class Peer(Packaged):
    name = "QPALM"
    module, package = "qpalm", "qpalm"
    forms = (PRIMAL_SPARSE, DUAL_SPARSE)
    settings = {f"{tolerance:g}": {"tolerance": tolerance} for tolerance in (1e-4, 1e-6, 1e-9, 1e-12)}
    timer = "its own (run_time)"

    def __init__(self, problem, form, tolerance):
        import qpalm
        self._qpalm, self._primal = qpalm, form == PRIMAL_SPARSE
        qp = problem.primal if self._primal else problem.dual
        rows = qp.C if self._primal else sp.identity(problem.m, format="csc")
        lower, upper = (qp.l, qp.u) if self._primal else (qp.lo, qp.hi)
        self._data = data = qpalm.Data(len(qp.g), rows.shape[0])
        data.Q, data.q, data.A = qp.H, qp.g, rows
        data.bmin, data.bmax = np.maximum(lower, -INFINITE), np.minimum(upper, INFINITE)
        self._settings = settings = qpalm.Settings()
        settings.eps_abs = settings.eps_rel = tolerance
        settings.max_iter = 100000
        settings.verbose = 0

    def cold(self):
        start = time.perf_counter()
        solver = self._qpalm.Solver(self._data, self._settings)
        solver.solve()
        around = time.perf_counter() - start
        info = solver.info
        x, y = np.array(solver.solution.x), np.array(solver.solution.y)
        return Outcome(info.run_time, around, info.status_val == self._qpalm.Info.SOLVED, *((x, -y) if self._primal else (None, x)))

    def known(self):
        return None  # update_Q_A takes values in the order of an inner copy that the package does not show
