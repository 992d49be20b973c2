"""mlcp as a solver of qpsolvers, ``pip install mlcp[qpsolvers]``. Importing this module registers it.

::

    import mlcp.qpsolvers
    import qpsolvers

    solution = qpsolvers.solve_problem(problem, solver="mlcp")
    x = qpsolvers.solve_qp(P, q, G, h, A, b, lb, ub, solver="mlcp")
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np
import qpsolvers
from numpy.typing import NDArray
from qpsolvers.exceptions import ProblemError
from qpsolvers.solvers import dense_solvers, solve_function

from .one_line import solve_qp

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._core import SolverSettings

__all__ = ["mlcp_solve_problem"]


def mlcp_solve_problem(problem: qpsolvers.Problem, initvals: NDArray[np.float64] | None = None, verbose: bool = False,
                       **settings: Unpack[SolverSettings]) -> qpsolvers.Solution:
    """Solve a quadratic program using mlcp, for dense and for sparse matrices.

    Parameters
    ----------
    problem : qpsolvers.Problem
        P may be semidefinite where the solution is finite.
    initvals : (n,) array, optional
        A guess of x: the solve starts from the constraints that it meets with equality.
    verbose : bool
        Print a line of what was done.
    **settings
        Keywords of `mlcp.Solver`.

    Returns
    -------
    qpsolvers.Solution
        ``extras["result"]`` is the `mlcp.Result`. Where nothing was found its ``status`` says why, and x
        and the multipliers are what the solve left.

    Raises
    ------
    qpsolvers.ProblemError
        The problem is not a quadratic program: numbers that are not finite, an asymmetric P.
    """
    begin = time.perf_counter()
    try:
        found = solve_qp(*problem.unpack(), initvals=initvals, full_output=True, **settings)
    except ValueError as error:
        raise ProblemError(str(error)) from error
    if verbose:
        print(found.result)
    boxed = problem.lb is not None or problem.ub is not None
    solving = found.result.times.total
    return qpsolvers.Solution(problem, extras={"result": found.result}, found=found.result.solved, obj=found.objective, x=found.x, y=found.y,
                              z=found.z, z_box=found.z_box if boxed else np.empty(0),
                              build_time=time.perf_counter() - begin - solving, solve_time=solving)


if "mlcp" not in solve_function:
    solve_function["mlcp"] = mlcp_solve_problem
    for known in (qpsolvers.available_solvers, dense_solvers, qpsolvers.sparse_solvers):
        known.append("mlcp")
