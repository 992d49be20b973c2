"""parallel_for: islands on the caller's threads, to the same bits."""

import signal
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
import scipy.sparse as sp
from conftest import pile

import mlcp
from mlcp import Outcome


def piles(count=8, contacts=150):
    """Piles that do not touch each other: islands, each with a factor that is worth a thread."""
    each = [pile(contacts, seed) for seed in range(1, count + 1)]
    return mlcp.Problem.from_matrices(sp.block_diag([p.mass() for p in each]), np.concatenate([p.momentum for p in each]),
                                      sp.block_diag([p.jacobian() for p in each]), np.concatenate([p.r for p in each]))


def same(a, b):
    for name in ("v", "gamma", "w"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))
    assert a.mask == b.mask and a.counts._replace(analyzed=True) == b.counts._replace(analyzed=True)


@pytest.mark.parametrize("workers", [1, 2, 5])
def test_an_executor_solves_the_islands_to_the_same_bits(workers):
    problem, names = piles(), set()
    alone = mlcp.Solver().solve(problem)
    with ThreadPoolExecutor(workers, initializer=lambda: names.add(threading.current_thread().name)) as executor:
        solver = mlcp.Solver(parallel_for=executor)
        assert solver.parallel_for is executor
        for _ in range(3):
            result = solver.solve(problem)
            same(result, alone)
    assert result.solved and names


def test_a_callable_gets_the_work_and_shares_it_as_it_likes():
    problem, counts, threads = piles(), [], []
    alone = mlcp.Solver().solve(problem)

    def share(work):
        counts.append(work.count)
        threads[:] = [threading.Thread(target=work) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        work()  # nothing is left

    solver = mlcp.Solver(parallel_for=share)
    same(solver.solve(problem), alone)
    assert counts and counts[0] > 1
    shared = len(counts)
    solver.parallel_for = None
    same(solver.solve(problem), alone)
    assert len(counts) == shared
    solver.configure(parallel_for=lambda work: None)  # does nothing: the solving thread does it all
    same(solver.solve(problem), alone)
    with pytest.raises(TypeError, match="comes from a solve"):
        mlcp.Work()


def test_work_that_is_called_too_late_or_not_waited_for_does_no_harm():
    problem, kept, threads = piles(), [], []
    alone = mlcp.Solver().solve(problem)

    def careless(work):
        kept.append(work)
        threads[:] = [threading.Thread(target=work) for _ in range(3)]
        for thread in threads:
            thread.start()

    solver = mlcp.Solver(parallel_for=careless)
    for _ in range(5):
        same(solver.solve(problem), alone)
        for thread in threads:
            thread.join()
    del solver
    for work in kept:
        work()


def test_a_pool_whose_threads_wait_for_the_solve_does_not_hold_it_up():
    problem = piles()
    alone = mlcp.Solver().solve(problem)
    with ThreadPoolExecutor(2) as executor:
        for result in executor.map(lambda _: mlcp.Solver(parallel_for=executor).solve(problem), range(4), timeout=60):
            same(result, alone)


def test_an_exception_of_the_callable_comes_out_of_the_solve_and_stops_it():
    problem = piles()

    def broken(work):
        raise LookupError("no threads")

    solver = mlcp.Solver(parallel_for=broken)
    with pytest.raises(LookupError, match="no threads"):
        solver.solve(problem)
    assert solver.result.status is Outcome.INTERRUPTED
    solver.parallel_for = None
    assert solver.solve(problem).solved
    executor = ThreadPoolExecutor(1)
    executor.shutdown()
    with pytest.raises(RuntimeError, match="shutdown"):
        mlcp.Solver(parallel_for=executor).solve(problem)


def test_ctrl_c_while_the_others_work_comes_out_of_the_solve():
    problem = piles()

    def share(work):
        signal.raise_signal(signal.SIGINT)
        time.sleep(10)  # not that long: here the handler raises

    solver = mlcp.Solver(parallel_for=share)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs inherit one that ignores
    try:
        with pytest.raises(KeyboardInterrupt):
            solver.solve(problem)
    finally:
        signal.signal(signal.SIGINT, before)
    assert solver.result.status is Outcome.INTERRUPTED


def test_progress_is_told_on_the_solving_thread_alone():
    problem, where = piles(), set()
    with ThreadPoolExecutor(2) as executor:
        mlcp.Solver(parallel_for=executor, progress=lambda now: where.add(threading.get_ident())).solve(problem)
    assert where <= {threading.get_ident()}


def test_what_is_no_pool_of_threads_is_refused():
    with ProcessPoolExecutor(1) as processes:
        for bad, text in ((processes, "processes"), (3, "parallel_for = 3")):
            with pytest.raises(mlcp.ArgumentError, match=text):
                mlcp.Solver(parallel_for=bad)
            solver = mlcp.Solver()
            with pytest.raises(mlcp.ArgumentError, match=text):
                solver.configure(parallel_for=bad)
            assert solver.parallel_for is None
