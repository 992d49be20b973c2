"""Several solvers at once, a solver that is busy, solve_many."""

import multiprocessing
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import ball_and_joint, pile, squeezed

import mlcp
from mlcp import Outcome


def test_many_solvers_on_one_problem_get_the_same_bits():
    problem = pile(150)
    expected = mlcp.Solver().solve(problem)
    with ThreadPoolExecutor(6) as pool:
        for result in pool.map(lambda _: mlcp.Solver().solve(problem), range(30)):
            np.testing.assert_array_equal(result.v, expected.v)
            np.testing.assert_array_equal(result.gamma, expected.gamma)


def test_the_gil_is_released_in_a_solve():
    """Python code runs on while a solve is under way, many times between its beginning and its end."""
    problem, running, ticks = pile(20000), threading.Event(), 0
    solver = mlcp.Solver(method="simplex")
    thread = threading.Thread(target=lambda: (running.set(), solver.solve(problem)))
    thread.start()
    running.wait()
    while thread.is_alive() and ticks < 50:
        time.sleep(0.001)
        ticks += 1
    solver.interrupt()
    thread.join()
    assert ticks == 50 and solver.result.status is Outcome.INTERRUPTED


def test_a_solver_serves_one_thread_at_a_time_and_a_problem_in_use_does_not_change():
    problem, inside, go_on = pile(200), threading.Event(), threading.Event()

    def wait(progress):
        inside.set()
        go_on.wait(10)

    solver = mlcp.Solver(progress=wait)
    thread = threading.Thread(target=solver.solve, args=(problem,))
    thread.start()
    assert inside.wait(10)
    for call in (lambda: solver.solve(problem), lambda: solver.configure(trace=True), lambda: problem.set_r(0), solver.trim,
                 lambda: solver.bind(problem).solve(), lambda: solver.reaction(problem, 0)):
        with pytest.raises(mlcp.StateError):
            call()
    other = mlcp.Solver().solve(problem)  # reading is fine
    go_on.set()
    thread.join()
    np.testing.assert_array_equal(solver.result.v, other.v)
    problem.set_r(0)


def use_after_fork(solver, problem, answers):
    try:
        solver.solve(problem)
    except mlcp.StateError as error:
        answers.put(str(error))
    answers.put(mlcp.Solver(num_threads=2).solve(problem).solved)


def test_a_solver_with_threads_refuses_to_work_after_a_fork_and_goes_away_quietly():
    problem, fork = pile(150), multiprocessing.get_context("fork")
    solver, answers = mlcp.Solver(num_threads=2), fork.SimpleQueue()
    solver.solve(problem)
    child = fork.Process(target=use_after_fork, args=(solver, problem, answers))
    child.start()
    assert "forked" in answers.get() and answers.get() is True
    child.join(10)
    assert child.exitcode == 0
    assert solver.solve(problem).solved


def test_solve_many_does_not_depend_on_the_workers():
    problems = [pile(60, seed) for seed in range(1, 9)] + [squeezed()]
    alone = [mlcp.Solver().solve(problem) for problem in problems]
    for workers in (1, 2, 5):
        together = mlcp.solve_many(problems, workers=workers)
        assert [result.status for result in together] == [result.status for result in alone]
        for a, b in zip(alone, together):
            np.testing.assert_array_equal(a.v, b.v)
            np.testing.assert_array_equal(a.gamma, b.gamma)
    warm = mlcp.solve_many(problems[:3], [result.mask for result in alone[:3]], tolerance=1e-8, method="simplex")
    assert [result.counts.pivots for result in warm] == [0, 0, 0]
    off = mlcp.solve_many([ball_and_joint()] * 2, enabled=[mlcp.Mask(2, 0), None])
    assert [result.counts.enabled_rows for result in off] == [0, 2]
    assert mlcp.solve_many(iter([])) == []


def test_solve_many_shows_a_bar_only_when_a_person_watches(capfd):
    mlcp.solve_many([ball_and_joint()] * 3)
    assert capfd.readouterr() == ("", "")  # stderr is no terminal here
    mlcp.solve_many([ball_and_joint()] * 3, bar=True)
    out, err = capfd.readouterr()
    assert out == "" and "3/3" in err


def test_solve_many_refuses_what_does_not_fit():
    with pytest.raises(ValueError, match="starts has 1 entries for 2"):
        mlcp.solve_many([ball_and_joint()] * 2, [None])
    with pytest.raises(ValueError, match="workers = 0"):
        mlcp.solve_many([ball_and_joint()], workers=0)
    with pytest.raises(TypeError, match="speed"):
        mlcp.solve_many([ball_and_joint()], speed=3)
    with pytest.raises(mlcp.RangeError):
        mlcp.solve_many([ball_and_joint()] * 4, [None, mlcp.Mask(1), None, None])


def test_solve_many_stops_the_others_when_one_fails():
    long = pile(20000)
    begin = time.perf_counter()
    with pytest.raises(mlcp.RangeError):
        mlcp.solve_many([long, ball_and_joint()], [None, mlcp.Mask(1)], workers=2, method="simplex")
    assert time.perf_counter() - begin < 5
