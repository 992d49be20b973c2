"""Problem: what goes in comes back, every edit, every refusal."""

import numpy as np
import pytest
import scipy.sparse as sp
from conftest import ball_and_joint

import mlcp

chain_mass = sp.csc_array(np.array([[4.0, 1, 0], [1, 3, 1], [0, 1, 2]]))


def test_what_goes_in_comes_back(ball):
    assert (ball.velocities, ball.rows, ball.body_count, ball.entries) == (2, 2, 2, 2)
    assert repr(ball) == "<mlcp.Problem: 2 velocities in 2 bodies, 2 rows>"
    np.testing.assert_array_equal(ball.bodies, [0, 1])
    np.testing.assert_array_equal(ball.momentum, [-6, 8])
    np.testing.assert_array_equal(ball.r, [0, 0.5])
    np.testing.assert_array_equal(ball.lo, [0, -np.inf])
    np.testing.assert_array_equal(ball.hi, [np.inf, np.inf])
    np.testing.assert_array_equal(ball.compliance, [0, 0])
    np.testing.assert_array_equal(ball.keys, [5, 6])
    np.testing.assert_array_equal(ball.mass().toarray(), np.diag([2.0, 4]))
    np.testing.assert_array_equal(ball.jacobian().toarray(), np.eye(2))
    np.testing.assert_array_equal(ball.compliance_matrix().toarray(), np.zeros((2, 2)))
    assert ball.body_slice(1) == slice(1, 2)


def test_from_matrices_takes_blocks_or_a_whole_mass():
    blocks = np.array([np.diag([2.0, 2, 0.1]), np.diag([1.0, 1, 0.2])])
    jacobian = np.arange(12.0).reshape(2, 6)
    a = mlcp.Problem.from_matrices(blocks, 1.0, jacobian, [1, 2], -np.inf, [3, np.inf], compliance=0.5, keys=[7, 8])
    b = mlcp.Problem.from_matrices(sp.block_diag(blocks), np.ones(6), sp.csc_matrix(jacobian), [1, 2], -np.inf, [3, np.inf],
                                   compliance=sp.diags([0.5, 0.5]), keys=[7, 8])
    c = mlcp.Problem.from_matrices(blocks, 1.0, jacobian, [1, 2], -np.inf, [3, np.inf], compliance=np.eye(2) / 2, keys=[7, 8])
    assert (a.body_count, b.body_count) == (2, 1)
    for problem in (a, b, c):
        np.testing.assert_array_equal(problem.mass().toarray(), sp.block_diag(blocks).toarray())
        np.testing.assert_array_equal(problem.jacobian().toarray(), jacobian)
        np.testing.assert_array_equal(problem.compliance, [0.5, 0.5])
        np.testing.assert_array_equal(problem.lo, [-np.inf, -np.inf])
        np.testing.assert_array_equal(problem.hi, [3, np.inf])
        np.testing.assert_array_equal(problem.keys, [7, 8])
    assert mlcp.Problem.from_matrices(np.eye(2), [1, 2]).rows == 0


def test_from_reduced():
    a = np.array([[2.0, 1], [1, 2]])
    problem = mlcp.Problem.from_reduced(a, [-5, -6], keys=[1, 2])
    assert (problem.velocities, problem.rows) == (0, 2)
    np.testing.assert_array_equal(problem.compliance_matrix().toarray(), a)
    np.testing.assert_array_equal(problem.r, [5, 6])
    with pytest.raises(mlcp.RangeError, match="not square"):
        mlcp.Problem.from_reduced(np.ones((2, 3)), 0)
    with pytest.raises(mlcp.ArgumentError, match="symmetric"):
        mlcp.Problem.from_reduced([[1, 2], [0, 1]], 0)


def test_rows_between_bodies():
    problem = mlcp.Problem()
    ids = problem.add_bodies([np.eye(2)] * 3)
    rows = problem.add_rows(ids[:2], ids[1:], [[1, 2], [3, 4]], [[5, 6], [7, 8]], r=[1, 2], lo=-1, hi=[1, 2], compliance=0.1,
                            keys=[9, 10])
    assert rows == range(0, 2)
    np.testing.assert_array_equal(problem.jacobian().toarray(), [[1, 2, 5, 6, 0, 0], [0, 0, 3, 4, 7, 8]])
    # the world takes no entries, a number is a body for all rows
    rows = problem.add_rows([-1, 0], 2, [[99, 99], [1, 1]], [[5, 6], [7, 8]])
    assert rows == range(2, 4)
    np.testing.assert_array_equal(problem.jacobian().toarray()[2:], [[0, 0, 0, 0, 5, 6], [1, 1, 0, 0, 7, 8]])
    assert problem.add_rows(r=[1.0, 2.0]) == range(4, 6)
    assert problem.add_rows(body_b=0, jacobian_b=[[1, 0]]) == range(6, 7)
    assert problem.rows == 7


@pytest.mark.parametrize("format", ["csr", "csc", "coo", "lil", "dense"])
def test_matrix_rows_of_any_form(format):
    jacobian = np.array([[1.0, 0, 2], [0, 0, 3]])
    problem = mlcp.Problem()
    problem.add_sparse_body(chain_mass)
    given = jacobian if format == "dense" else sp.csr_array(jacobian).asformat(format)
    assert problem.add_matrix_rows(given, r=[1, 2]) == range(2)
    np.testing.assert_array_equal(problem.jacobian().toarray(), jacobian)


@pytest.mark.parametrize("make", [sp.csr_array, sp.csc_array])
@pytest.mark.parametrize("triangle", ["full", "lower", "upper"])
def test_triangles(make, triangle):
    part = {"full": lambda m: m, "lower": sp.tril, "upper": sp.triu}[triangle]
    problem = mlcp.Problem()
    problem.add_sparse_body(make(part(chain_mass)), triangle=triangle)
    np.testing.assert_array_equal(problem.mass().toarray(), chain_mass.toarray())
    problem.add_rows(r=np.zeros(3))
    problem.set_compliance_matrix(make(part(chain_mass)), triangle)
    np.testing.assert_array_equal(problem.compliance_matrix().toarray(), chain_mass.toarray())
    with pytest.raises(mlcp.ArgumentError, match="triangle = 'left'"):
        problem.add_sparse_body(chain_mass, triangle="left")


def test_edits(ball):
    ball.set_momentum([3.0], first=1)
    ball.set_r(7)
    ball.set_r([8], first=1)
    ball.set_bounds(-1, [2, 3])
    ball.set_compliance(0.25)
    ball.set_keys([1, 2])
    ball.set_jacobian(0, [4])
    ball.set_mass(0, [[5]])
    np.testing.assert_array_equal(ball.momentum, [-6, 3])
    np.testing.assert_array_equal(ball.r, [7, 8])
    np.testing.assert_array_equal(ball.lo, [-1, -1])
    np.testing.assert_array_equal(ball.hi, [2, 3])
    np.testing.assert_array_equal(ball.compliance, [0.25, 0.25])
    np.testing.assert_array_equal(ball.keys, [1, 2])
    assert ball.jacobian()[0, 0] == 4 and ball.mass()[0, 0] == 5
    ball.set_bounds([-2, -3], np.inf)
    np.testing.assert_array_equal(ball.lo, [-2, -3])
    ball.remove_rows([0])
    np.testing.assert_array_equal(ball.keys, [2])
    ball.clear_rows()
    ball.remove_body(0)
    np.testing.assert_array_equal(ball.bodies, [1])
    ball.reserve(bodies=10, velocities=60, rows=100, entries=1000)
    ball.trim()
    ball.clear()
    assert (ball.velocities, ball.rows, ball.body_count) == (0, 0, 0)


def test_prescribed_bodies_move_as_given_and_need_an_impulse():
    problem = mlcp.Problem()
    floor, ball = problem.add_bodies([[[10.0]], [[2.0]]])
    problem.set_momentum([0.0, -6.0])
    problem.add_rows([floor], [ball], [[-1]], [[1]])
    problem.set_prescribed(floor, 0.5)
    assert problem.given_velocity(floor) == [0.5] and problem.given_velocity(ball) is None
    solver = mlcp.Solver()
    result = solver.solve(problem)
    np.testing.assert_allclose(result.v, [0.5, 0.5], rtol=1e-15)
    np.testing.assert_allclose(result.gamma, [7], rtol=1e-15)
    np.testing.assert_allclose(solver.reaction(problem, floor), [10 * 0.5 + 7], rtol=1e-15)
    problem.set_dynamic(floor)
    assert problem.given_velocity(floor) is None


def test_time_stepping():
    problem = mlcp.Problem()
    problem.add_bodies([[[2.0]]])
    problem.set_timestep_momentum(0.1, [3.0], -9.81)
    np.testing.assert_allclose(problem.momentum, [2 * 3 - 0.1 * 9.81])
    r = mlcp.timestep_rows(0.1, [0.5, -0.5], [1.0, 1.0], stabilisation=0.2)
    np.testing.assert_allclose(r, [-0.5 / 0.1 - 1, 0.2 * 0.5 / 0.1 - 1])
    np.testing.assert_allclose(mlcp.timestep_rows(0.1, [0.5], unilateral=False), [-0.2 * 0.5 / 0.1])
    r = [-5.0, -1.0, 0.0]
    np.testing.assert_allclose(mlcp.timestep_restitution(0.1, r, [0.5, 0.1, 0.0], [-4.0, -2.0, -0.1], 0.5, slowest=0.2), [-5, 1, 0])
    assert r == [-5, -1, 0]
    compliance, r = mlcp.timestep_spring(0.1, 100.0, 5.0, 0.01)
    assert compliance == pytest.approx(1 / (0.1 * (0.1 * 100 + 5))) and r == pytest.approx(-100 * 0.01 / (0.1 * 100 + 5))
    assert mlcp.timestep_erp_cfm(0.1, 0.2, 1e-5, 0.01) == pytest.approx((1e-4, -0.02))
    for refused in (lambda: mlcp.timestep_rows(0.0, [1.0]), lambda: mlcp.timestep_spring(0.1, 0.0, 0.0, 0.0),
                    lambda: mlcp.timestep_erp_cfm(0.1, 2.0, 0.0, 0.0),
                    lambda: mlcp.timestep_restitution(0.1, [0.0], [0.0], [-1.0], [1.5])):
        with pytest.raises(mlcp.ArgumentError):
            refused()


nan = float("nan")
refusals = [
    (lambda p: p.add_bodies([[[1.0, 2], [0, 1]]]), mlcp.ArgumentError, "symmetric"),
    (lambda p: p.add_bodies([[[-1.0]]]), mlcp.ArgumentError, "mass"),
    (lambda p: p.add_bodies([[1.0, 2.0]]), mlcp.RangeError, r"masses has shape \(1, 2\)"),
    (lambda p: p.add_bodies([[[1j]]]), mlcp.ArgumentError, "complex"),
    (lambda p: p.add_sparse_body(np.ones((2, 3))), mlcp.RangeError, "not square"),
    (lambda p: p.add_sparse_body(sp.csr_array((0, 0))), mlcp.RangeError, "no rows"),
    (lambda p: p.add_sparse_body(np.ones(3)), mlcp.RangeError, "not that of a matrix"),
    (lambda p: p.set_mass(7, [[1.0]]), mlcp.RangeError, "body"),
    (lambda p: p.remove_body(0), mlcp.StateError, "row"),
    (lambda p: p.body_slice(9), mlcp.RangeError, "body = 9"),
    (lambda p: p.set_prescribed(9), mlcp.RangeError, "body = 9"),
    (lambda p: p.set_prescribed(0, [1, 2]), mlcp.RangeError, r"velocity has shape \(2,\), not \(1,\)"),
    (lambda p: p.given_velocity(-3), mlcp.RangeError, "body = -3"),
    (lambda p: p.set_momentum([1, 2, 3]), mlcp.RangeError, "3"),
    (lambda p: p.set_momentum([nan, 0]), mlcp.ArgumentError, "k"),
    (lambda p: p.set_momentum([[1, 2]]), mlcp.RangeError, r"k has shape \(1, 2\)"),
    (lambda p: p.set_momentum(["a", "b"]), mlcp.ArgumentError, "k has dtype"),
    (lambda p: p.set_timestep_momentum(-1.0, 0, 0), mlcp.ArgumentError, "h"),
    (lambda p: p.add_rows([0], [0], [[1]], [[1]]), mlcp.ArgumentError, "body"),
    (lambda p: p.add_rows([5], None, [[1]]), mlcp.RangeError, "body_a"),
    (lambda p: p.add_rows([0], None, [[1, 2]]), mlcp.RangeError, "jacobian_a has 2 columns, but body 0 of row 0 has 1"),
    (lambda p: p.add_rows(None, [0], [[1]], [[1]]), mlcp.ArgumentError, "jacobian_a is given"),
    (lambda p: p.add_rows([0], None, [1.0]), mlcp.RangeError, "jacobian_a has shape"),
    (lambda p: p.add_rows([0], None, [[1]], lo=[2], hi=[1]), mlcp.ArgumentError, "lo"),
    (lambda p: p.add_rows([0], None, [[1]], r=[1, 2]), mlcp.RangeError, r"r has shape \(2,\), not \(1,\)"),
    (lambda p: p.add_rows([0.5], None, [[1]]), mlcp.ArgumentError, "body_a has dtype float64"),
    (lambda p: p.add_rows([0], None, [[1]], keys=[-1]), mlcp.ArgumentError, r"keys\[0\] = -1 is negative"),
    (lambda p: p.add_rows([0], None, [[1]], keys=[0.5]), mlcp.ArgumentError, "keys has dtype"),
    (lambda p: p.add_row([0, 0], [1, 1]), mlcp.ArgumentError, "column"),
    (lambda p: p.add_row([5], [1]), mlcp.RangeError, "5"),
    (lambda p: p.add_row([0], [1, 2]), mlcp.RangeError, "values has shape"),
    (lambda p: p.add_row([0], [1], key=-1), OverflowError, None),
    (lambda p: p.add_matrix_rows(np.ones((1, 5))), mlcp.RangeError, "5 columns, the problem 2"),
    (lambda p: p.add_matrix_rows(np.ones((1, 2)), r=[nan]), mlcp.ArgumentError, "r"),
    (lambda p: p.set_compliance_matrix(np.eye(3)), mlcp.RangeError, "2 rows"),
    (lambda p: p.set_r([1, 2, 3]), mlcp.RangeError, "3"),
    (lambda p: p.set_r([1], first=2), mlcp.RangeError, None),
    (lambda p: p.set_bounds([1, 1], [0, 0]), mlcp.ArgumentError, "lo"),
    (lambda p: p.set_bounds([1, 1], [3]), mlcp.RangeError, "hi has shape"),
    (lambda p: p.set_compliance([-1, 0]), mlcp.ArgumentError, "compliance"),
    (lambda p: p.set_keys([1, 2, 3]), mlcp.RangeError, None),
    (lambda p: p.set_jacobian(0, [1, 2]), mlcp.RangeError, None),
    (lambda p: p.remove_rows([0, 0]), mlcp.ArgumentError, None),
    (lambda p: p.remove_rows([2]), mlcp.RangeError, "2"),
    (lambda p: p.reserve(rows=2**40), mlcp.RangeError, "rows = "),
    (lambda p: p.reserve(bodies=-1), mlcp.RangeError, "bodies = -1"),
]


@pytest.mark.parametrize("number", range(len(refusals)))
def test_bad_input_is_refused_by_name_and_changes_nothing(ball, number):
    call, error, text = refusals[number]
    before = ball.to_bytes()
    with pytest.raises(error, match=text):
        call(ball)
    assert ball.to_bytes() == before


def test_errors_are_what_python_expects_too():
    assert issubclass(mlcp.ArgumentError, ValueError) and issubclass(mlcp.RangeError, (ValueError, IndexError))
    assert issubclass(mlcp.FileError, OSError) and issubclass(mlcp.StateError, RuntimeError)
    for name in ("ArgumentError", "RangeError", "FileError", "FormatError", "StateError", "UnsupportedError", "InternalError",
                 "NotSolved"):
        assert issubclass(getattr(mlcp, name), mlcp.Error)


def test_a_problem_of_nothing_and_one_without_rows():
    assert mlcp.Solver().solve(mlcp.Problem()).solved
    problem = ball_and_joint()
    problem.clear_rows()
    result = mlcp.Solver().solve(problem)
    np.testing.assert_allclose(result.v, [-3, 2])
    assert result.gamma.shape == (0,) and len(result.mask) == 0
