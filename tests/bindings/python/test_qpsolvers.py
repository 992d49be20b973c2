"""solve_problem(problem, solver="mlcp"), judged by qpsolvers' own measures on its own problems."""

import subprocess
import sys

import numpy as np
import pytest
import qpsolvers
import scipy.sparse as sp
from qpsolvers import problems
from qpsolvers.exceptions import ProblemError

import mlcp
import mlcp.qpsolvers


@pytest.mark.parametrize("name", ["qpsut01", "qpsut02", "qpsut03", "qpsut04", "qpsut05", "qpgurdu", "qpgurabs", "qpgureq", "qptest"])
@pytest.mark.parametrize("sparse", [False, True])
def test_its_own_problems(name, sparse):
    found = getattr(problems, "get_" + name)()
    problem, known = found if isinstance(found, tuple) else (found, None)
    if sparse:
        problem = qpsolvers.Problem(*(sp.csc_matrix(part) if part is not None and np.ndim(part) == 2 else part for part in problem.unpack()))
    solution = qpsolvers.solve_problem(problem, solver="mlcp")
    assert solution.found and solution.is_optimal(1e-9)
    assert solution.extras["result"].solved and solution.solve_time > 0 and solution.build_time > 0
    assert solution.obj == pytest.approx(0.5 * solution.x @ (problem.P @ solution.x) + problem.q @ solution.x)
    if known is not None and known.x is not None:
        np.testing.assert_allclose(solution.x, known.x, atol=1e-4)  # as few digits as they are given with
    np.testing.assert_array_equal(qpsolvers.solve_qp(*problem.unpack(), solver="mlcp"), solution.x)
    np.testing.assert_array_equal(mlcp.solve_qp(*problem.unpack()), solution.x)


def test_it_stands_among_the_solvers_once():
    for known in (qpsolvers.available_solvers, qpsolvers.dense_solvers, qpsolvers.sparse_solvers):
        assert known.count("mlcp") == 1
    script = "import qpsolvers, mlcp; print('mlcp' in qpsolvers.available_solvers); import mlcp.qpsolvers; print('mlcp' in qpsolvers.available_solvers)"
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", script], capture_output=True, text=True)
    assert done.stdout.split() == ["False", "True"], done.stderr


def random_program(seed, n=40):
    random = np.random.default_rng(seed)
    root = random.normal(size=(n, n))
    inside = random.normal(size=n)
    G = random.normal(size=(n, n))
    return qpsolvers.Problem(root @ root.T + np.eye(n), 10 * random.normal(size=n), G, G @ inside + random.uniform(0, 1, n),
                             lb=inside - 1, ub=np.where(np.arange(n) % 2, inside + 1, np.inf))


@pytest.mark.parametrize("seed", range(5))
def test_random_programs_and_starts(seed):
    problem = random_program(seed)
    cold = qpsolvers.solve_problem(problem, solver="mlcp", method="simplex")
    assert cold.found and cold.is_optimal(1e-9)
    warm = qpsolvers.solve_problem(problem, solver="mlcp", initvals=cold.x, method="simplex")
    assert cold.extras["result"].counts.pivots > 0 == warm.extras["result"].counts.pivots
    np.testing.assert_allclose(warm.x, cold.x, atol=1e-10)
    far = qpsolvers.solve_problem(problem, solver="mlcp", initvals=np.zeros(len(problem.q)))
    np.testing.assert_allclose(far.x, cold.x, atol=1e-9)


def test_what_is_not_solved_and_what_is_no_program(capsys):
    contradiction = qpsolvers.Problem(np.eye(1), np.zeros(1), np.array([[1.0], [-1.0]]), np.array([-1.0, -1.0]))
    solution = qpsolvers.solve_problem(contradiction, solver="mlcp", verbose=True)
    assert not solution.found and solution.extras["result"].status == "infeasible"
    assert "infeasible" in capsys.readouterr().out
    assert qpsolvers.solve_qp(*contradiction.unpack(), solver="mlcp") is None
    assert not qpsolvers.solve_problem(random_program(1), solver="mlcp", method="simplex", max_iterations=1).found
    indefinite = qpsolvers.solve_problem(qpsolvers.Problem(np.array([[1.0, 2], [2, 1]]), np.ones(2)), solver="mlcp")
    assert not indefinite.found and indefinite.extras["result"].status == "not_positive_definite"
    with pytest.raises(ProblemError, match="symmetric"):
        qpsolvers.solve_qp(np.array([[1.0, 2], [0, 1]]), np.ones(2), solver="mlcp")
    with pytest.raises(ProblemError, match="q|momentum|k"):
        qpsolvers.solve_qp(np.eye(2), np.array([np.nan, 0]), solver="mlcp")
    with pytest.raises(TypeError, match="speed"):
        qpsolvers.solve_qp(np.eye(1), np.zeros(1), solver="mlcp", speed=3)
    with pytest.raises(mlcp.ArgumentError, match="initvals has shape"):
        mlcp.solve_qp(np.eye(2), np.zeros(2), initvals=[1.0])
