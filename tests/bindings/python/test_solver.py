"""Solver and Result: settings, starts, what is told of a solve."""

import numpy as np
import pytest
import scipy.sparse as sp
from conftest import ball_and_joint, natural_residual, pile, squeezed

import mlcp
from mlcp import Outcome, RowState


def test_ball_and_joint(ball):
    result = mlcp.Solver().solve(ball)
    assert result.solved and result.status is Outcome.SOLVED and result.status == "solved" and result.method == "newton"
    np.testing.assert_allclose(result.v, [0, 0.5], atol=1e-15)
    np.testing.assert_allclose(result.gamma, [6, 4 * 0.5 - 8], atol=1e-14)
    np.testing.assert_allclose(result.w, [0, 0], atol=1e-15)
    np.testing.assert_array_equal(result.active, [True, True])
    np.testing.assert_array_equal(result.redundant, [False, False])
    assert sorted(result.row_islands) == [0, 1] and result.island_status == [Outcome.SOLVED] * 2
    assert result.certificates == () and len(result.trace) == 0
    assert result.errors.largest < 1e-14 and result.errors.worst_body == -1
    assert result.counts.islands == 2 and result.counts.active_rows == 2 and result.counts.analyzed
    assert 0 < result.times.total < 10
    assert repr(result).startswith("<mlcp.Result: solved, 2 of 2 rows active")
    with pytest.raises(TypeError):
        mlcp.Result()


def test_settings_are_kept_and_bad_ones_named():
    changed = {"method": "simplex", "pivot_rule": "printed", "refactorize": "always", "trace": True, "tolerance": 1e-7,
               "max_iterations": 5, "max_work": 10**12, "max_seconds": 2.5, "impulses": "least_norm",
               "canonical": True, "warm_start": False, "num_threads": 2, "facets": 6, "max_shifts": 40}
    solver = mlcp.Solver(**changed)
    assert changed.items() <= solver.settings.items()
    solver.configure(tolerance=1e-8)
    assert solver.settings == {**solver.settings, **changed, "tolerance": 1e-8}
    assert "tolerance = 1e-08" in repr(solver)
    for bad, error, text in (({"method": "magic"}, mlcp.ArgumentError, "method = 'magic'"), ({"tolerance": 0}, mlcp.ArgumentError, "tolerance"),
                             ({"max_seconds": -1}, mlcp.ArgumentError, "max_seconds"), ({"speed": 1}, TypeError, "speed"),
                             ({"max_iterations": -1}, mlcp.ArgumentError, "max_iterations"),
                             ({"num_threads": -1}, mlcp.ArgumentError, "num_threads"), ({"facets": 2}, mlcp.ArgumentError, "facets"),
                             ({"max_shifts": -1}, mlcp.ArgumentError, "max_shifts"), ({"impulses": "most"}, mlcp.ArgumentError, "impulses"), ({"tolerance": "x"}, TypeError, None),
                             ({"progress": 3}, mlcp.ArgumentError, "progress = 3")):
        with pytest.raises(error, match=text):
            mlcp.Solver(**bad)
        with pytest.raises(error, match=text):
            solver.configure(**bad)
    assert solver.settings == {**solver.settings, **changed, "tolerance": 1e-8}


def test_warm_starts_need_no_pivots():
    problem, solver = pile(120), mlcp.Solver(method="simplex")
    cold = solver.solve(problem)
    warm = solver.solve(problem, cold.mask)
    assert cold.counts.pivots > 20 and warm.counts.pivots == 0 and not warm.counts.analyzed
    assert warm.counts.warm and not cold.counts.warm
    np.testing.assert_allclose(warm.v, cold.v, atol=1e-12)


def test_disabled_rows_constrain_nothing(ball):
    result = mlcp.Solver().solve(ball, enabled=mlcp.Mask([RowState.DISABLED, RowState.ACTIVE]))
    np.testing.assert_allclose(result.v, [-3, 0.5])
    assert result.gamma[0] == 0 and result.mask[0] is RowState.DISABLED and result.row_islands[0] == -1


def test_masks_of_another_length_are_refused(ball):
    solver = mlcp.Solver()
    for call in (lambda: solver.solve(ball, mlcp.Mask(3)), lambda: solver.solve(ball, enabled=mlcp.Mask(1)),
                 lambda: solver.analyze(ball, enabled=mlcp.Mask(5))):
        with pytest.raises(mlcp.RangeError):
            call()
    for call in (lambda: solver.solve(None), lambda: solver.solve(ball, "mask"), lambda: solver.analyze(None)):
        with pytest.raises(TypeError):
            call()
    assert solver.result is None


def test_analyze_first_then_solve(ball):
    solver = mlcp.Solver()
    with pytest.raises(mlcp.StateError):
        solver.factor()
    solver.analyze(ball)
    assert not solver.solve(ball).counts.analyzed
    solver.trim()
    assert solver.solve(ball).solved


def test_infeasible_rows_are_named_and_the_rest_is_solved():
    problem = squeezed()
    result = mlcp.Solver().solve(problem)
    assert result.status is Outcome.INFEASIBLE and not result.solved
    assert sorted(result.island_status) == [Outcome.INFEASIBLE, Outcome.SOLVED]
    (certificate,) = result.certificates
    np.testing.assert_array_equal(sorted(certificate.rows), [0, 1])
    y = np.zeros(3)
    y[certificate.rows] = certificate.y
    assert (certificate.y > 0).all() and problem.r @ y > 0
    np.testing.assert_allclose(problem.jacobian().T @ y, 0, atol=1e-15)
    np.testing.assert_allclose(result.v, [0, 0], atol=1e-12)  # the least violation, and the ball that rests
    assert result.row_islands[certificate.rows[0]] == certificate.island


def test_indefinite_mass_is_named():
    result = mlcp.solve(np.array([[1.0, 2], [2, 1]]), [1, 1])
    assert result.status is Outcome.NOT_POSITIVE_DEFINITE and result.errors.worst_body == 0 and result.errors.worst_velocity in (0, 1)


def test_limits_end_a_solve():
    problem = pile(200)
    assert mlcp.Solver(max_iterations=3).solve(problem).status is Outcome.ITERATION_LIMIT
    assert mlcp.Solver(max_work=1).solve(problem).status is Outcome.WORK_LIMIT
    assert mlcp.Solver(max_seconds=1e-9).solve(problem).status is Outcome.TIME_LIMIT


def test_redundant_rows_are_marked():
    problem = mlcp.Problem.from_matrices(np.eye(1), [-1.0], np.ones((3, 1)))
    result = mlcp.Solver().solve(problem)
    assert result.redundant.sum() == 2 and result.counts.redundant_rows == 2 and result.gamma.sum() == pytest.approx(1)


def test_trace_replays_to_the_final_active_set():
    problem = pile(90)
    result = mlcp.Solver(method="simplex", trace=True).solve(problem)
    assert len(result.trace) == result.counts.pivots
    states = np.ones(problem.rows, int)  # contacts alone: all begin at rest
    for pivot in result.trace:
        states[pivot["blocking"]] = pivot["to"]
    np.testing.assert_array_equal(states, result.mask.states)


def test_factor_is_that_of_the_kkt_matrix():
    problem, solver = pile(30), mlcp.Solver(method="simplex")  # auto needs no factor for islands as small as these
    result = solver.solve(problem)
    factor = solver.factor()
    assert len(factor.rows) == result.counts.factor_entries == factor.pointers[-1]
    n, size = problem.velocities, len(factor.nodes)
    jacobian = problem.jacobian()
    kkt = sp.block_array([[problem.mass(), jacobian.T], [jacobian, problem.compliance_matrix()]], format="csr")
    kkt.data[:] = 1  # stored zeros count
    assert (factor.nodes < n + problem.rows).all() and len(set(factor.nodes)) == size
    # dense symbolic elimination as the oracle
    filled = kkt.toarray()[np.ix_(factor.nodes, factor.nodes)] != 0
    for p in range(size):
        below = p + 1 + np.flatnonzero(filled[p + 1:, p])
        filled[np.ix_(below, below)] = True
    for p in range(size):
        np.testing.assert_array_equal(factor.rows[factor.pointers[p]:factor.pointers[p + 1]], p + 1 + np.flatnonzero(filled[p + 1:, p]))


def test_results_before_a_solve_and_of_another_problem(ball):
    solver = mlcp.Solver()
    assert solver.result is None
    with pytest.raises(mlcp.StateError, match="before a solve"):
        solver.reaction(ball, 0)
    result = solver.solve(ball)
    assert solver.result is result
    with pytest.raises(mlcp.RangeError):
        solver.reaction(ball, 7)


def test_printed_pivot_rule_and_refactorization_agree():
    problem = pile(90)
    v = mlcp.Solver().solve(problem).v
    for settings in ({"pivot_rule": "printed"}, {"refactorize": "always"}):
        result = mlcp.Solver(**settings).solve(problem)
        assert result.solved
        np.testing.assert_allclose(result.v, v, atol=1e-10)


def test_boxed_and_compliant_rows():
    problem = mlcp.Problem.from_matrices(np.eye(2), [10.0, 10.0], np.eye(2), 0.0, -1.0, 1.0, compliance=[0.0, 0.5])
    result = mlcp.Solver().solve(problem)
    np.testing.assert_array_equal(result.mask.states, [RowState.AT_LOWER, RowState.AT_LOWER])
    np.testing.assert_allclose(result.v, [9, 9])
    assert max(natural_residual(problem, result)) < 1e-14


def test_progress_is_told_and_can_stop():
    seen = []
    solver = mlcp.Solver(progress=seen.append, method="simplex")
    assert solver.solve(pile(2000)).solved  # long enough for several looks
    assert len(seen) > 1 and isinstance(seen[0], mlcp.Progress) and seen[0].islands >= 1
    assert max(progress.work for progress in seen) > 0 and max(progress.pivots for progress in seen) > 0
    solver.progress = lambda progress: True
    result = solver.solve(pile(200))
    assert result.status is Outcome.INTERRUPTED and np.isfinite(result.v).all()
    solver.configure(progress=None)
    assert solver.progress is None and solver.solve(pile(200)).solved


def test_exceptions_of_the_callback_reach_the_caller():
    def fail(progress):
        raise LookupError("no more")

    solver = mlcp.Solver(progress=fail)
    with pytest.raises(LookupError, match="no more"):
        solver.solve(pile(200))
    assert solver.result.status is Outcome.INTERRUPTED
    with pytest.raises(LookupError, match="no more"):
        solver.bind(pile(200)).solve()
    solver.progress = None
    assert solver.solve(pile(200)).solved


def test_the_callback_cannot_call_its_solver_or_change_its_problem():
    problem, errors = pile(200), []
    start, enabled = mlcp.Mask(problem.rows), mlcp.Mask(problem.rows)

    def meddle(progress):
        for call in (lambda: solver.solve(problem), lambda: solver.configure(tolerance=1), lambda: problem.set_r(0), solver.factor,
                     lambda: mlcp.dumps(problem, solver), lambda: start.resize(0), lambda: enabled.__setitem__(0, 0)):
            try:
                call()
            except mlcp.StateError as error:
                errors.append(str(error))

    solver = mlcp.Solver(progress=meddle)
    assert solver.solve(problem, start, enabled=enabled).solved
    assert len(errors) >= 7 and len(errors) % 7 == 0


def test_an_interrupt_ends_the_next_solve_and_only_that():
    solver = mlcp.Solver()
    solver.interrupt()
    assert solver.solve(pile(200)).status is Outcome.INTERRUPTED
    assert solver.solve(pile(200)).solved


def test_bound_arrays():
    problem, solver = ball_and_joint(), mlcp.Solver()
    k, r, v = np.array([-6.0, 8.0]), np.zeros(2), np.empty(2)
    k.flags.writeable = False
    bound = solver.bind(problem, momentum=k, r=r, lo=np.array([0.0, -np.inf]), hi=np.full(2, np.inf), v=v)
    assert bound.solve() is Outcome.SOLVED
    assert bound.v is v and bound.solver is solver and bound.problem is problem
    np.testing.assert_allclose(v, [0, 0], atol=1e-15)
    r[:] = [1, 2]
    assert bound.solve(warm=True) == "solved"
    np.testing.assert_allclose(v, [1, 2])
    np.testing.assert_allclose(bound.gamma, [2 * 1 + 6, 4 * 2 - 8], atol=1e-14)
    np.testing.assert_allclose(bound.w, [0, 0], atol=1e-15)
    assert bound.result.counts.pivots == 2  # a step for each island, whose active set was right
    r[0] = np.nan
    with pytest.raises(mlcp.ArgumentError, match="r"):
        bound.solve()
    problem.add_row([0], [1])
    with pytest.raises(mlcp.StateError, match="other sizes"):
        bound.solve()


@pytest.mark.parametrize("bad", [{"v": np.zeros(3)}, {"v": [0.0, 0.0]}, {"gamma": np.zeros(2, np.float32)}, {"w": np.zeros(4)[::2]},
                                 {"momentum": np.zeros(1)}, {"r": np.zeros((2, 1))}, {"lo": np.zeros(2)}, {"momentum": [0.0, 0.0]},
                                 {"v": np.frombuffer(b"\0" * 16)}])
def test_arrays_that_would_need_a_copy_are_not_bound(ball, bad):
    with pytest.raises(mlcp.ArgumentError):
        mlcp.Solver().bind(ball, **bad)


def test_bound_without_rows_or_velocities():
    for problem in (mlcp.Problem(), mlcp.Problem.from_reduced([[2.0]], [-4.0])):
        bound = mlcp.Solver().bind(problem, momentum=np.zeros(problem.velocities), r=problem.r)
        assert bound.solve() is Outcome.SOLVED
    np.testing.assert_allclose(bound.gamma, [2])
