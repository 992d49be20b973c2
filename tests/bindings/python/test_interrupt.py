"""Ctrl-C ends a long solve at once and leaves what it has."""

import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

begin = """
    import os, signal, sys, threading, time
    import numpy as np
    import mlcp
    from conftest import pile

    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs inherit one that ignores
    problem = pile(20000)  # seconds of the simplex on any machine
    sent = []

    def press(wait=0.3):  # Ctrl-C, as a terminal sends it, when the solve has run for a while
        time.sleep(wait)
        sent.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)
"""


def run(script):
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(begin) + textwrap.dedent(script)], capture_output=True, text=True,
                          cwd=Path(__file__).parent, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def soonest(script):
    """The run of three with the least delay, its first word: a shared machine may be slow for a while, what does not listen is slow each time."""
    best = run(script)
    for _ in range(2):
        if float(best[0]) < 0.1:
            break
        best = min(best, run(script), key=lambda words: float(words[0]))
    return best


def test_ctrl_c_stops_a_solve_within_a_tenth_of_a_second_and_leaves_the_iterate():
    delay, status, finite = soonest("""
        solver = mlcp.Solver(method="simplex")
        solver.analyze(problem)
        threading.Thread(target=press).start()
        try:
            solver.solve(problem)
        except KeyboardInterrupt:
            ended = time.process_time()
            print(ended - sent[0], solver.result.status, np.isfinite(solver.result.v).all())
    """)
    assert status == "interrupted" and finite == "True"
    assert float(delay) < 0.1  # of processor time, so that a busy machine does not count


@pytest.mark.parametrize("phase, side", [("analysis", 64), ("factorization", 40)])
def test_ctrl_c_stops_inside_of_an_analysis_and_a_factorization(phase, side):
    """Masses in a cube, each coupled to six others: either phase takes several seconds, ten times as long as the wait before the key."""
    delay, status, entries, factorizations = soonest(f"""
        import scipy.sparse as sp
        line = sp.diags_array([-1.0, 2.1, -1.0], offsets=[-1, 0, 1], shape=({side}, {side}))
        plane = sp.kronsum(line, line)
        mass = sp.csc_array(sp.kronsum(plane, line))
        n = mass.shape[0]
        grid = mlcp.Problem.from_matrices(mass, np.random.default_rng(1).normal(size=n), sp.identity(n, format="csr")[::7])
        solver = mlcp.Solver(method="newton")
        if {phase == "factorization"}:
            solver.analyze(grid)
        threading.Thread(target=press).start()
        try:
            solver.solve(grid)
        except KeyboardInterrupt:
            delay, counts = time.process_time() - sent[0], solver.result.counts
            print(delay, solver.result.status, counts.factor_entries, counts.factorizations)
    """)
    assert float(delay) < 0.1 and status == "interrupted"
    assert (int(entries) == 0) == (phase == "analysis") and int(factorizations) == 0  # that it was in the midst of the phase


def test_ctrl_c_stops_solve_many():
    delay, = run("""
        threading.Thread(target=press).start()
        try:
            mlcp.solve_many([problem] * 4, method="simplex")
        except KeyboardInterrupt:
            print(time.process_time() - sent[0])
    """)
    assert float(delay) < 0.2  # of two threads


def test_a_handler_of_the_caller_decides():
    status, calls = run("""
        calls = []
        signal.signal(signal.SIGINT, lambda number, frame: calls.append(number))
        threading.Thread(target=press).start()
        result = mlcp.Solver(method="simplex", max_seconds=0.8).solve(problem)
        print(result.status, len(calls))
    """)
    assert (status, calls) == ("time_limit", "1")


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="POSIX only")
def test_other_signals_are_handled_during_a_solve():
    text, = run("""
        def ring(number, frame):
            raise TimeoutError("rang")

        signal.signal(signal.SIGALRM, ring)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        try:
            mlcp.Solver(method="simplex").solve(problem)
        except TimeoutError as error:
            print(error)
    """)
    assert text == "rang"
