"""ProxQP (proxsuite): a primal-dual proximal augmented Lagrangian method, sparse and dense."""
import time

import numpy as np
import scipy.sparse as sp

from . import DUAL_DENSE, FORMS, PRIMAL_DENSE, PRIMAL_SPARSE, Outcome, Packaged


class Peer(Packaged):
    name = "ProxQP"
    module, package = "proxsuite", "proxsuite"
    forms = FORMS
    settings = {f"{tolerance:g}": {"tolerance": tolerance} for tolerance in (1e-4, 1e-6, 1e-9, 1e-12)}
    timer = "its own (setup_time + solve_time)"

    def __init__(self, problem, form, tolerance):
        import proxsuite
        self._proxqp, self._tolerance = proxsuite.proxqp, tolerance
        self._dense, self._primal = form in (PRIMAL_DENSE, DUAL_DENSE), form in (PRIMAL_SPARSE, PRIMAL_DENSE)
        self._bilateral = equal = problem.bilateral
        if self._primal:
            qp = problem.primal
            rows = qp.dense_C if self._dense else qp.C.tocsr()
            A, C = (rows[which] if self._dense else rows[which].tocsc() for which in (equal, ~equal))
            self._data = {"g": qp.g, "A": A, "b": qp.l[equal], "C": C, "l": qp.l[~equal], "u": qp.u[~equal]}
            self._box = False
        else:
            qp = problem.dual
            self._box = self._dense
            if self._dense:
                self._data = {"g": qp.g, "l_box": qp.lo, "u_box": qp.hi}
            else:
                self._data = {"g": qp.g, "C": sp.identity(problem.m, format="csc"), "l": qp.lo, "u": qp.hi}
        self._data["H"] = qp.dense_H if self._dense else qp.H
        self._qp = None

    def cold(self):
        start = time.perf_counter()
        n = len(self._data["g"])
        equal, unequal = len(self._data.get("b", ())), len(self._data.get("l", ()))
        self._qp = qp = self._proxqp.dense.QP(n, equal, unequal, self._box) if self._dense else self._proxqp.sparse.QP(n, equal, unequal)
        qp.settings.eps_abs = self._tolerance
        qp.settings.eps_rel = 0
        qp.settings.compute_timings = True
        qp.settings.verbose = False
        qp.settings.max_iter = 100000
        qp.init(**self._data)
        return self._solve(start)

    def known(self):
        if self._qp is None:
            self.cold()
        start = time.perf_counter()
        self._qp.update(**self._data, update_preconditioner=True)
        return self._solve(start)

    def _solve(self, start):
        self._qp.solve()
        around = time.perf_counter() - start
        results = self._qp.results
        seconds = 1e-6 * (results.info.setup_time + results.info.solve_time)
        claimed = results.info.status == self._proxqp.PROXQP_SOLVED
        if not self._primal:
            return Outcome(seconds, around, claimed, None, np.array(results.x))
        gamma = np.empty(len(self._bilateral))
        gamma[self._bilateral], gamma[~self._bilateral] = -np.array(results.y), -np.array(results.z)
        return Outcome(seconds, around, claimed, np.array(results.x), gamma)
