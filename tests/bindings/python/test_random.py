"""Random problems satisfy the complementarity conditions, recomputed from the caller's own numbers."""

import numpy as np
from conftest import natural_residual
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import mlcp

numbers = st.integers(-4, 4)  # few different ones: ties, equal rows and zero rows come by themselves


@st.composite
def problems(draw):
    """Bodies of one to three velocities, rows of every kind that no choice of v makes infeasible."""
    problem = mlcp.Problem()
    for dimension in draw(st.lists(st.integers(1, 3), min_size=1, max_size=4)):
        root = np.array(draw(st.lists(numbers, min_size=dimension**2, max_size=dimension**2)), float).reshape(dimension, dimension)
        problem.add_bodies(root @ root.T + np.eye(dimension))
    n = problem.velocities
    vector = st.lists(numbers, min_size=n, max_size=n)
    problem.set_momentum(draw(vector))
    inside = np.array(draw(vector), float)  # satisfies every row
    for row in draw(st.lists(vector, max_size=8)):
        kind = draw(st.sampled_from(["contact", "joint", "box", "soft"]))
        reach = float(np.dot(row, inside))
        columns = np.flatnonzero(row)
        problem.add_row(columns, np.array(row)[columns], r=reach - (0 if kind == "joint" else draw(st.integers(0, 3))),
                        lo={"joint": -np.inf, "box": -draw(st.integers(0, 3))}.get(kind, 0),
                        hi=draw(st.integers(0, 3)) if kind == "box" else np.inf,
                        compliance=0.5 if kind == "soft" else 0)
    return problem


@settings(max_examples=200, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
@given(problems())
def test_random_problems_satisfy_the_conditions(problem):
    result = mlcp.Solver().solve(problem)
    assert result.solved
    assert max(natural_residual(problem, result)) < 1e-9
    warm = mlcp.Solver().solve(problem, result.mask)
    np.testing.assert_allclose(warm.v, result.v, atol=1e-9)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(st.integers(1, 6).flatmap(lambda m: st.tuples(st.lists(numbers, min_size=m * m, max_size=m * m), st.lists(numbers, min_size=m, max_size=m))))
def test_random_lcps(numbers_of_a_and_b):
    entries, b = numbers_of_a_and_b
    root = np.array(entries, float).reshape(len(b), len(b))
    a = root @ root.T
    result = mlcp.solve_lcp(a, b, full_output=True)
    if result.solved:
        z, w = result.gamma, a @ result.gamma + b
        assert max(-z.min(), -w.min(), np.abs(z * w).max()) < 1e-8
    else:
        (certificate,) = result.certificates[:1]  # A y = 0, y ≥ 0 and bᵀ y < 0 prove that there is no solution
        y = np.zeros(len(b))
        y[certificate.rows] = certificate.y
        assert (y >= 0).all() and b @ y < 0
        np.testing.assert_allclose(a @ y, 0, atol=1e-9)
