"""PIQP: a proximal interior-point method, sparse and dense."""
import time

import numpy as np

from . import DUAL_DENSE, DUAL_SPARSE, FORMS, PRIMAL_DENSE, PRIMAL_SPARSE, Outcome, Packaged


class Peer(Packaged):
    name = "PIQP"
    module, package = "piqp", "piqp"
    forms = FORMS
    settings = {f"{tolerance:g}": {"tolerance": tolerance} for tolerance in (1e-4, 1e-6, 1e-9, 1e-12)}
    timer = "its own (setup_time or update_time + solve_time)"

    def __init__(self, problem, form, tolerance):
        import piqp
        self._piqp, self._tolerance, self._dense = piqp, tolerance, form in (PRIMAL_DENSE, DUAL_DENSE)
        self._bilateral = problem.bilateral
        if form in (DUAL_SPARSE, DUAL_DENSE):
            qp = problem.dual
            self._data = {"P": qp.dense_H if self._dense else qp.H, "c": qp.g, "x_l": qp.lo, "x_u": qp.hi}
        else:
            qp = problem.primal
            C = qp.dense_C if self._dense else qp.C.tocsr()
            equal, unequal = (C[rows] if self._dense else C[rows].tocsc() for rows in (self._bilateral, ~self._bilateral))
            self._data = {"P": qp.dense_H if self._dense else qp.H, "c": qp.g, "A": equal, "b": qp.l[self._bilateral],
                          "G": unequal, "h_l": qp.l[~self._bilateral], "h_u": qp.u[~self._bilateral]}
        self._primal = form in (PRIMAL_SPARSE, PRIMAL_DENSE)
        self._solver = None

    def cold(self):
        start = time.perf_counter()
        self._solver = solver = self._piqp.DenseSolver() if self._dense else self._piqp.SparseSolver()
        solver.settings.compute_timings = True
        solver.settings.verbose = False
        solver.settings.max_iter = 1000
        for name in ("eps_abs", "eps_rel", "eps_duality_gap_abs", "eps_duality_gap_rel"):
            setattr(solver.settings, name, self._tolerance)
        solver.setup(**self._data)
        return self._solve(start, known=False)

    def known(self):
        if self._solver is None:
            self.cold()
        start = time.perf_counter()
        self._solver.update(**self._data)
        return self._solve(start, known=True)

    def _solve(self, start, known):
        status = self._solver.solve()
        around = time.perf_counter() - start
        result = self._solver.result
        seconds = result.info.solve_time + (result.info.update_time if known else result.info.setup_time)
        claimed = status == self._piqp.PIQP_SOLVED
        if not self._primal:
            return Outcome(seconds, around, claimed, None, np.array(result.x))
        gamma = np.empty(len(self._bilateral))
        gamma[self._bilateral] = -np.array(result.y)
        gamma[~self._bilateral] = np.array(result.z_l) - np.array(result.z_u)
        return Outcome(seconds, around, claimed, np.array(result.x), gamma)
