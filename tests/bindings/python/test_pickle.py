"""Pickling, copies, snapshots; also to and from other processes."""

import copy
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
from conftest import ball_and_joint, pile, squeezed

import mlcp


def solve(problem):
    return mlcp.Solver(trace=True).solve(problem)


def same(a, b):
    for name in ("v", "gamma", "w", "redundant", "row_islands", "trace"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))
    assert a.mask == b.mask and a.status is b.status and a.island_status == b.island_status
    assert [(c.island, c.rows.tolist(), c.y.tolist()) for c in a.certificates] == [(c.island, c.rows.tolist(), c.y.tolist()) for c in b.certificates]


twins = [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy, copy.copy]


@pytest.mark.parametrize("twin", twins)
def test_problems(twin):
    problem = ball_and_joint()
    problem.set_prescribed(0, 2.0)
    other = twin(problem)
    assert other.to_bytes() == problem.to_bytes() and type(other) is mlcp.Problem
    other.set_r(3)
    np.testing.assert_array_equal(problem.r, [0, 0.5])


class Named(mlcp.Problem):
    """A subclass keeps its class."""


@pytest.mark.parametrize("twin", twins)
def test_subclasses(twin):
    assert type(twin(Named.from_matrices(np.eye(1), 1.0))) is Named


@pytest.mark.parametrize("twin", twins)
def test_masks_keep_their_keys(twin):
    problem = ball_and_joint()
    mask = mlcp.Mask([2, 3])
    mask.take_keys(problem)
    other = twin(mask)
    assert other == mask
    problem.remove_rows([0])
    np.testing.assert_array_equal(mlcp.Mask.carry(problem, other).states, [3])
    assert len(twin(mlcp.Mask())) == 0


@pytest.mark.parametrize("twin", twins)
def test_solvers_keep_their_settings(twin):
    solver = mlcp.Solver(tolerance=1e-7, max_iterations=7, pivot_rule="printed")
    assert twin(solver).settings == solver.settings


@pytest.mark.parametrize("make", [lambda: pile(60), squeezed])
def test_results(make):
    result = solve(make())
    other = pickle.loads(pickle.dumps(result))
    same(result, other)
    assert (other.errors, other.counts, other.times, other.method) == (result.errors, result.counts, result.times, result.method)
    same(result, copy.deepcopy(result))


def test_exceptions():
    with pytest.raises(mlcp.NotSolved) as caught:
        mlcp.solve_lcp([[0.0]], [-1.0])
    other = pickle.loads(pickle.dumps(caught.value))
    assert str(other) == str(caught.value)
    same(other.result, caught.value.result)


@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_other_processes_get_the_same_bits(method):
    problems = [pile(60), squeezed()]
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(method)) as pool:
        for problem, result in zip(problems, pool.map(solve, problems)):
            same(result, solve(problem))


def test_snapshots_replay_to_the_same_bits(tmp_path):
    scene = mlcp.Scene("pile", 40)
    for _ in range(3):
        scene.step()
    scene.prepare()
    problem, start, enabled = scene.problem, scene.start, mlcp.Mask(scene.problem.rows, mlcp.RowState.ACTIVE)
    enabled[3] = mlcp.RowState.DISABLED
    solver = mlcp.Solver(tolerance=1e-8)
    solver.analyze(problem)
    data = mlcp.dumps(problem, solver, enabled=enabled, start=start)
    mlcp.save(tmp_path / "step.mlcp", problem, solver, enabled=enabled, start=start)
    result = solver.solve(problem, start, enabled=enabled)
    for snapshot in (mlcp.loads(data), mlcp.loads(memoryview(data)), mlcp.load(tmp_path / "step.mlcp")):
        assert snapshot.solver.settings == solver.settings and snapshot.start == start and snapshot.enabled == enabled
        replay = snapshot.solver.solve(snapshot.problem, snapshot.start, enabled=snapshot.enabled)
        np.testing.assert_array_equal(replay.v, result.v)
        np.testing.assert_array_equal(replay.gamma, result.gamma)
    alone = mlcp.loads(mlcp.dumps(problem))
    assert alone.enabled is None and alone.start is None
    assert mlcp.Problem.from_file(tmp_path / "step.mlcp").to_bytes() == problem.to_bytes()


def test_damaged_snapshots_are_refused(tmp_path):
    data = bytearray(ball_and_joint().to_bytes())
    for damage in (b"", b"nonsense", bytes(data[:-1]), bytes(data[:40]) + b"\xff" + bytes(data[41:])):
        for read in (mlcp.loads, mlcp.Problem.from_bytes):
            with pytest.raises(mlcp.FormatError):
                read(damage)
    (tmp_path / "bad.mlcp").write_bytes(b"nonsense")
    with pytest.raises(mlcp.FormatError):
        mlcp.load(tmp_path / "bad.mlcp")
    with pytest.raises(mlcp.FileError, match="none.mlcp"):
        mlcp.load(tmp_path / "none.mlcp")
    with pytest.raises(mlcp.FileError, match="none.mlcp"):
        mlcp.Problem.from_file(tmp_path / "none.mlcp")
    with pytest.raises(mlcp.FileError):
        mlcp.save(tmp_path / "no" / "folder.mlcp", ball_and_joint())
    with pytest.raises(mlcp.RangeError):
        mlcp.dumps(ball_and_joint(), start=mlcp.Mask(7))
    with pytest.raises(TypeError):
        mlcp.loads("text")


def test_a_solve_that_fails_leaves_a_snapshot_that_fails_again(tmp_path):
    solver = mlcp.Solver()
    solver.keep_failures(tmp_path, 2)
    assert solver.solve(ball_and_joint()).status is mlcp.Outcome.SOLVED and solver.failure_file is None
    failed = solver.solve(squeezed())
    snapshot = mlcp.load(solver.failure_file)
    same(snapshot.solver.solve(snapshot.problem, snapshot.start, enabled=snapshot.enabled), failed)
    with pytest.raises(mlcp.ArgumentError, match="limit = -1"):
        solver.keep_failures(tmp_path, -1)
    solver.keep_failures(None)
    solver.solve(squeezed())
    assert solver.failure_file is None
