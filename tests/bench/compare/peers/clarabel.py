"""Clarabel: a primal-dual interior-point method, sparse; with each of its own factorizations."""
import time

import numpy as np
import scipy.sparse as sp

from . import DUAL_SPARSE, PRIMAL_SPARSE, Outcome, Packaged


class Peer(Packaged):
    name = "Clarabel"
    module, package = "clarabel", "clarabel"
    forms = (PRIMAL_SPARSE, DUAL_SPARSE)
    settings = {f"{tolerance:g}, {factor}": {"tolerance": tolerance, "factor": factor}
                for tolerance in (1e-4, 1e-8, 1e-12) for factor in ("qdldl", "faer")}
    timer = "ours around set-up and solve"

    def __init__(self, problem, form, tolerance, factor):
        import clarabel
        self._clarabel, self._primal = clarabel, form == PRIMAL_SPARSE
        self._settings = settings = clarabel.DefaultSettings()
        settings.verbose = False
        settings.max_threads = 1
        settings.direct_solve_method = factor
        settings.presolve_enable = False  # else its values cannot be updated
        settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
        if self._primal:
            qp, equal = problem.primal, problem.bilateral
            order = np.concatenate([np.flatnonzero(equal), np.flatnonzero(~equal)])
            self._order = order
            self._data = (sp.triu(qp.H, format="csc"), qp.g, -qp.C.tocsr()[order].tocsc(), -qp.l[order])
            counts = np.count_nonzero(equal), np.count_nonzero(~equal)
            kinds = clarabel.ZeroConeT, clarabel.NonnegativeConeT
            self._cones = [kind(int(count)) for kind, count in zip(kinds, counts) if count]
        else:
            qp = problem.dual
            low, high = np.isfinite(qp.lo), np.isfinite(qp.hi)
            unit = sp.identity(problem.m, format="csr")
            rows, sides = sp.vstack([-unit[low], unit[high]]).tocsc(), np.concatenate([-qp.lo[low], qp.hi[high]])
            self._data = (sp.triu(qp.H, format="csc"), qp.g, rows, sides)
            self._cones = [clarabel.NonnegativeConeT(int(np.count_nonzero(low) + np.count_nonzero(high)))]
        self._solver = None

    def cold(self):
        start = time.perf_counter()
        self._solver = self._clarabel.DefaultSolver(*self._data, self._cones, self._settings)
        return self._solve(start)

    def known(self):
        if self._solver is None:
            self.cold()
        P, q, A, b = self._data
        start = time.perf_counter()
        self._solver.update(P=P, q=q, A=A, b=b)
        return self._solve(start)

    def _solve(self, start):
        solution = self._solver.solve()
        around = time.perf_counter() - start
        claimed = solution.status == self._clarabel.SolverStatus.Solved
        x = np.array(solution.x)
        if not self._primal:
            return Outcome(around, around, claimed, None, x)
        gamma = np.empty(len(self._order))
        gamma[self._order] = solution.z
        return Outcome(around, around, claimed, x, gamma)
