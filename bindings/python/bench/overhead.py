"""What the binding costs over C: time a call, and bytes that are copied on the way in.

    python bindings/python/bench/overhead.py

The overhead of a call is its wall time less what the library's own clock says it took (`Result.times.total`); that counts the work of
the C functions outside of that clock as the binding's, so the true overhead is smaller. Medians.
"""

import time
import tracemalloc

import numpy as np
import scipy.sparse as sp

import mlcp


def ball():
    problem = mlcp.Problem()
    problem.add_bodies([[[2.0]], [[4.0]]])
    problem.set_momentum([-6, 8])
    problem.add_rows(body_b=[0, 1], jacobian_b=[[1], [1]])
    return problem


def pile(spheres):
    scene = mlcp.Scene("pile", spheres)
    scene.prepare()
    return scene.problem


def median_overhead(call, times, rounds=4001):
    """Microseconds; times() is told after each call, outside of the timing."""
    extra = []
    for _ in range(rounds):
        begin = time.perf_counter_ns()
        call()
        taken = time.perf_counter_ns() - begin
        extra.append(taken * 1e-3 - times() * 1e6)
    return float(np.median(extra))


def time_table():
    print(f"{'overhead of a call, µs':34} {'2 rows':>10} {'pile':>10}   (the pile: ", end="")
    problems = [ball(), pile(100)]
    print(f"{problems[1].velocities} velocities, {problems[1].rows} rows)")
    rows = {"bound, k and r in, v, γ and w out": [], "bound, nothing in": [], "Solver.solve, a whole Result": []}
    for problem in problems:
        solver = mlcp.Solver()
        rounds = 4001 if problem.rows < 10 else 1001
        start = solver.solve(problem).mask
        bound = solver.bind(problem, momentum=problem.momentum, r=problem.r)
        plain = solver.bind(problem)
        last = lambda: bound.result.times.total
        rows["bound, k and r in, v, γ and w out"].append(median_overhead(lambda: bound.solve(True), last, rounds))
        rows["bound, nothing in"].append(median_overhead(lambda: plain.solve(True), last, rounds))
        rows["Solver.solve, a whole Result"].append(median_overhead(lambda: solver.solve(problem, start), last, rounds))
    for name, values in rows.items():
        print(f"{name:34} " + " ".join(f"{value:10.2f}" for value in values))


def peak(call):
    """The most bytes that NumPy held at a time during a call."""
    tracemalloc.start()
    call()
    bytes = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return bytes


def copy_table(n=200_000):
    problem = mlcp.Problem.from_matrices(sp.identity(n, format="csc"), 0.0)
    jacobian = sp.csr_array(sp.identity(n, format="csr"))
    wide = jacobian.copy()
    wide.indices, wide.indptr = wide.indices.astype(np.int64), wide.indptr.astype(np.int64)
    values, single, blocks = np.zeros(n), np.zeros(n, np.float32), np.zeros((n, 4))
    bodies = mlcp.Problem()
    ids = bodies.add_bodies(np.broadcast_to(np.eye(2), (n, 2, 2)))
    calls = {
        "set_momentum, float64": (8 * n, lambda: problem.set_momentum(values)),
        "set_momentum, float32": (4 * n, lambda: problem.set_momentum(single)),
        "set_momentum, every second of float64": (4 * n, lambda: problem.set_momentum(values[::2])),
        "add_matrix_rows, CSR, int32": (48 * n, lambda: problem.add_matrix_rows(jacobian, values, values, values, compliance=values)),
        "add_matrix_rows, CSR, int64": (56 * n, lambda: problem.add_matrix_rows(wide, values, values, values, compliance=values)),
        "add_rows, blocks in a wider array": (52 * n, lambda: bodies.add_rows(ids, None, blocks[:, :2], r=values, lo=values, hi=values,
                                                                             compliance=values)),
        "jacobian(copy=False)": (16 * n, lambda: problem.jacobian(copy=False)),
    }
    print(f"\n{'copied by the binding':40} {'arrays, kB':>12} {'copies, kB':>12}")
    for name, (size, call) in calls.items():
        call()
        print(f"{name:40} {size / 1000:12.0f} {peak(call) / 1000:12.1f}")


if __name__ == "__main__":
    time_table()
    copy_table()
