"""solve, solve_lcp, solve_qp."""

import numpy as np
import pytest
import scipy.sparse as sp

import mlcp
from mlcp import Outcome

# a block on a table with two corners
block = {"mass": np.diag([2.0, 2.0, 0.1])[np.newaxis], "momentum": [0, -0.1962, 0], "jacobian": [[0, 1, -0.2], [0, 1, 0.2]]}


def test_solve():
    result = mlcp.solve(**block)
    assert result.solved
    np.testing.assert_allclose(result.gamma, [0.0981, 0.0981], rtol=1e-14)
    assert mlcp.solve(**block, trace=True, max_iterations=1).status is Outcome.ITERATION_LIMIT


def test_solve_lcp_returns_the_array():
    a, b = np.array([[2.0, 1], [1, 2]]), np.array([-5.0, -6])
    for form in (a, sp.csr_array(a), sp.csc_matrix(a), a.tolist()):
        np.testing.assert_allclose(mlcp.solve_lcp(form, b), [4 / 3, 7 / 3])
    np.testing.assert_allclose(mlcp.solve_lcp(a, b, -np.inf), np.linalg.solve(a, -b))
    np.testing.assert_allclose(mlcp.solve_lcp(a, b, 0.0, [1.0, np.inf]), [1, 2.5])
    assert mlcp.solve_lcp(a, b, full_output=True).solved


def test_no_solution_is_an_exception_or_a_status():
    infeasible = ([[1, 0], [0, 0]], [-1, -1])
    with pytest.raises(mlcp.NotSolved, match="infeasible") as caught:
        mlcp.solve_lcp(*infeasible)
    np.testing.assert_array_equal(caught.value.result.certificates[0].rows, [1])
    assert mlcp.solve_lcp(*infeasible, full_output=True).status is Outcome.INFEASIBLE
    with pytest.raises(mlcp.NotSolved, match="not_positive_definite"):
        mlcp.solve_qp([[1.0, 2.0], [2.0, 1.0]], [1.0, 1.0])
    assert mlcp.solve_qp([[1.0]], [0.0], A=[[1.0], [1.0]], b=[0.0, 1.0], full_output=True).result.status is Outcome.INFEASIBLE


def qp_residuals(P, q, G, h, A, b, lb, ub, solution):
    """Stationarity, primal and dual violation, complementarity, with the signs of qpsolvers."""
    x, z, y, z_box = solution[:4]
    inside, outside = np.isfinite(lb), np.isfinite(ub)
    return (np.abs(P @ x + q + G.T @ z + A.T @ y + z_box).max(), np.maximum(G @ x - h, 0).max(), np.abs(A @ x - b).max(),
            np.maximum(lb - x, 0).max(), np.maximum(x - ub, 0).max(), np.maximum(-z, 0).max(), np.abs(z * (G @ x - h)).max(),
            np.abs(np.maximum(z_box, 0)[outside] * (x - ub)[outside]).max(initial=0),
            np.abs(np.minimum(z_box, 0)[inside] * (x - lb)[inside]).max(initial=0),
            np.maximum(z_box, 0)[~outside].max(initial=0), np.maximum(-z_box, 0)[~inside].max(initial=0))


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("form", [np.asarray, sp.csc_matrix, sp.csr_array])
def test_quadratic_programs(seed, form):
    random = np.random.default_rng(seed)
    n, inequalities, equalities = 12, 9, 3
    root = random.normal(size=(n, n))
    P, q = root @ root.T + np.eye(n), random.normal(size=n)
    P = (P + P.T) / 2
    G, A = random.normal(size=(inequalities, n)), random.normal(size=(equalities, n))
    x0 = random.normal(size=n)
    h, b = G @ x0 + random.uniform(0, 0.5, inequalities), A @ x0
    lb, ub = x0 - random.uniform(0, 1, n), x0 + random.uniform(0, 1, n)
    lb[:3], ub[2:5], lb[6] = -np.inf, np.inf, ub[6]
    b += A[:, 6] * (ub[6] - x0[6])
    h += np.abs(G[:, 6] * (ub[6] - x0[6]))
    solution = mlcp.solve_qp(form(P), q, form(G), h, form(A), b, lb, ub, full_output=True)
    assert solution.result.solved
    assert max(qp_residuals(P, q, G, h, A, b, lb, ub, solution)) < 1e-10
    assert solution.objective == pytest.approx(0.5 * solution.x @ P @ solution.x + q @ solution.x)
    np.testing.assert_array_equal(mlcp.solve_qp(P, q, G, h, A, b, lb, ub), solution.x)


def test_quadratic_program_without_constraints_and_with_infinite_ones():
    np.testing.assert_allclose(mlcp.solve_qp(2 * np.eye(2), [-2, 4]), [1, -2])
    free = mlcp.solve_qp(np.eye(2), [-1, -1], [[1, 0], [0, 1]], [np.inf, 0.5], lb=-np.inf, ub=np.inf, full_output=True)
    np.testing.assert_allclose(free.x, [1, 0.5])
    np.testing.assert_allclose(free.z, [0, 0.5])
    # a row of G as a vector, as qpsolvers takes it
    np.testing.assert_allclose(mlcp.solve_qp(np.eye(2), [0, 0], [-1.0, -1.0], [-2.0]), [1, 1])


@pytest.mark.parametrize("arguments, text", [
    ({"G": [[1, 0]]}, "G and h"), ({"b": [1]}, "A and b"), ({"G": [[1, 0, 0]], "h": [1]}, r"G has shape \(1, 3\)"),
    ({"A": [[1, 0]], "b": [1, 2]}, r"b \(2,\)"), ({"lb": [0, 0, 0]}, r"lb has shape \(3,\)"), ({"ub": [np.nan, 0]}, "r"),
    ({"G": [[np.nan, 0]], "h": [1]}, None)])
def test_bad_quadratic_programs(arguments, text):
    with pytest.raises(mlcp.ArgumentError, match=text):
        mlcp.solve_qp(np.eye(2), [0, 0], **arguments)
