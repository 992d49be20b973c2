"""Nothing grows over repeated use: Python's own memory under tracemalloc, the library's in the resident set."""

import gc
import pickle
import tracemalloc

import numpy as np
import psutil
import pytest
import scipy.sparse as sp
from conftest import ball_and_joint, pile, squeezed

import mlcp

problem = pile(90)
solver = mlcp.Solver(trace=True)
bound = solver.bind(problem)
jacobian = sp.csr_array(np.ones((1, 2)))


def fail():
    try:
        ball_and_joint().set_r([1, 2, 3])
    except mlcp.RangeError:
        pass


uses = {
    "solve": lambda: solver.solve(problem),
    "bound solve": bound.solve,
    "new solver": lambda: mlcp.Solver(progress=print).solve(squeezed()),
    "one line": lambda: mlcp.solve(np.eye(2), 1.0, jacobian),
    "problem": lambda: pickle.loads(pickle.dumps(ball_and_joint())).copy(),
    "mask": lambda: pickle.loads(pickle.dumps(mlcp.Mask(100))).states,
    "result": lambda: pickle.loads(pickle.dumps(solver.solve(problem))),
    "lent": lambda: problem.jacobian(copy=False),
    "bad input": fail,
    "bad solver": lambda: pytest.raises(mlcp.ArgumentError, mlcp.Solver, tolerance=-1),
    "many": lambda: mlcp.solve_many([ball_and_joint()] * 3, workers=2),
    "scene": lambda: mlcp.Scene("tower", 3).step(),
    "factor": solver.factor,
}


@pytest.mark.parametrize("name", uses)
def test_repeated_use_keeps_no_memory(name):
    use, process, rounds = uses[name], psutil.Process(), 150
    for _ in range(rounds):
        use()
    gc.collect()
    tracemalloc.start()
    try:
        use()
        gc.collect()
        before, resident = tracemalloc.get_traced_memory()[0], process.memory_info().rss
        for _ in range(rounds):
            use()
        gc.collect()
        grown = tracemalloc.get_traced_memory()[0] - before
        assert grown < 100 * rounds  # less than any object of theirs a round
        assert process.memory_info().rss - resident < 2_000_000
    finally:
        tracemalloc.stop()
