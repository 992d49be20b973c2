"""A test set of qpbenchmark: programs of the Maros-Meszaros set by formula, and those that stand in a folder of problems.

    qpbenchmark maros_meszaros.py run          # qpbenchmark's own way; compare.py prints one table instead
    MLCP_PROBLEMS=FOLDER                       # with mm_* folders of Matrix Market files, in the form of Problem.from_folder
"""
import os
from pathlib import Path

import numpy as np
import programs
import scipy.sparse as sp
from qpbenchmark.problem import Problem
from qpbenchmark.solver_settings import SolverSettings
from qpbenchmark.test_set import TestSet

import mlcp
import mlcp.qpsolvers  # registers the solver

SolverSettings.IMPLEMENTED_SOLVERS.add("mlcp")


def from_folder(folder):
    """M v = k + Cᵀλ + Dᵀz, C v + c = 0, 0 ≤ D v + d: the program min ½ vᵀM v − kᵀv. Rows of D with one entry ±1 are bounds."""
    problem = mlcp.Problem.from_folder(folder)
    jacobian, r, joint = problem.jacobian(), problem.r, problem.lo == -np.inf
    single = ~joint & (np.diff(jacobian.indptr) == 1)
    single[single] = np.abs(jacobian.data[jacobian.indptr[:-1][single]]) == 1
    column, sign = jacobian.indices[jacobian.indptr[:-1][single]], jacobian.data[jacobian.indptr[:-1][single]]
    lb, ub = np.full(problem.velocities, -np.inf), np.full(problem.velocities, np.inf)
    np.maximum.at(lb, column[sign > 0], r[single][sign > 0])
    np.minimum.at(ub, column[sign < 0], -r[single][sign < 0])
    rows = ~joint & ~single

    def part(which, factor):
        return (sp.csc_matrix(factor * jacobian[which]), factor * r[which]) if which.any() else (None, None)

    return Problem(sp.csc_matrix(problem.mass()), -problem.momentum, *part(rows, -1), *part(joint, 1), lb, ub, folder.name.removeprefix("mm_").upper())


class MarosMeszaros(TestSet):
    """The programs, at qpbenchmark's own settings and tolerances, which are absolute."""

    title = "Maros-Meszaros subset"
    description = "Programs of the Maros-Meszaros set that are made by formula or are at hand"
    sparse_only = True

    def __init__(self, names=None):
        self.names = names
        super().__init__()

    def __iter__(self):
        formulas = list(programs.by_formula())
        known = {program.name for program in formulas} | {"CVXQP1M"}
        folder = Path(os.environ.get("MLCP_PROBLEMS", Path(__file__).resolve().parents[4] / "shared" / "problems"))
        for program in formulas + [program for path in sorted(folder.glob("mm_*")) if (program := from_folder(path)).name not in known]:
            if self.names is None or program.name in self.names:
                yield program

    def define_tolerances(self, runtime=20.0):
        super().define_tolerances(runtime)
        self.known_solver_timeouts = {("STCQP1", "proxqp", "*"): 30.0}  # s; it looks at no clock

    def define_solver_settings(self):
        super().define_solver_settings()
        for name, settings in self.solver_settings.items():
            settings.set_param("mlcp", "max_seconds", self.tolerances[name].runtime)
