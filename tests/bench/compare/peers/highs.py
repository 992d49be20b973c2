"""HiGHS: its active-set method for convex quadratic programs."""
import time

import numpy as np
import scipy.sparse as sp

from . import DUAL_SPARSE, PRIMAL_SPARSE, Outcome, Packaged


class Peer(Packaged):
    name = "HiGHS"
    module, package = "highspy", "highspy"
    forms = (PRIMAL_SPARSE, DUAL_SPARSE)
    settings = {f"{tolerance:g}": {"tolerance": tolerance} for tolerance in (1e-7, 1e-10)}
    timer = "ours around passModel and run"

    def __init__(self, problem, form, tolerance):
        import highspy
        self._highspy, self._tolerance, self._primal = highspy, tolerance, form == PRIMAL_SPARSE
        qp = problem.primal if self._primal else problem.dual
        size = len(qp.g)
        self._model = model = highspy.HighsModel()
        lp, hessian = model.lp_, model.hessian_
        infinite = highspy.kHighsInf
        lp.num_col_ = size
        lp.col_cost_ = qp.g
        lp.col_lower_ = np.full(size, -infinite) if self._primal else qp.lo
        lp.col_upper_ = np.full(size, infinite) if self._primal else qp.hi
        lp.num_row_ = qp.C.shape[0] if self._primal else 0
        if self._primal:
            lp.row_lower_, lp.row_upper_ = qp.l, qp.u
            lp.a_matrix_.format_ = highspy.MatrixFormat.kColwise
            lp.a_matrix_.start_, lp.a_matrix_.index_, lp.a_matrix_.value_ = qp.C.indptr, qp.C.indices, qp.C.data
        else:
            lp.a_matrix_.start_ = np.zeros(size + 1, np.int32)
        lower = sp.tril(qp.H, format="csc")
        hessian.dim_ = size
        hessian.format_ = highspy.HessianFormat.kTriangular
        hessian.start_, hessian.index_, hessian.value_ = lower.indptr, lower.indices, lower.data

    def cold(self):
        start = time.perf_counter()
        solver = self._highspy.Highs()
        solver.setOptionValue("output_flag", False)
        solver.setOptionValue("threads", 1)
        for name in ("primal_feasibility_tolerance", "dual_feasibility_tolerance"):
            solver.setOptionValue(name, self._tolerance)
        solver.passModel(self._model)
        solver.run()
        around = time.perf_counter() - start
        claimed = solver.getModelStatus() == self._highspy.HighsModelStatus.kOptimal
        solution = solver.getSolution()
        x, dual = np.array(solution.col_value), np.array(solution.row_dual)
        return Outcome(around, around, claimed, *((x, dual) if self._primal else (None, x)))

    def known(self):
        return None
