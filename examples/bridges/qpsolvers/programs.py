"""Quadratic programs of the Maros-Meszaros set that their authors define by a formula or by a few numbers, made here from those.

Maros & Meszaros, Optim. Methods Softw. 11 (1999); the sources of each are named where it is made. OPTIMA has the optimal values that the paper
lists, by which the formulas are checked (tests/bridges/qpsolvers).
"""
import numpy as np
import scipy.sparse as sp
from qpbenchmark.problem import Problem

OPTIMA = {
    "HS21": -9.99599999e1, "HS35": 1.11111111e-1, "HS35MOD": 2.50000001e-1, "HS51": 0.0, "HS52": 5.32664756e0, "HS53": 4.09302326e0,
    "HS76": -4.68181818e0, "HS118": 6.64820450e2, "HS268": 0.0, "TAME": 0.0, "ZECEVIC2": -4.125, "GENHS28": 9.27173692e-1,
    "CVXQP1_S": 1.15907181e4, "CVXQP2_S": 8.12094048e3, "CVXQP3_S": 1.19434322e4, "CVXQP1_M": 1.08751157e6, "CVXQP2_M": 8.20155431e5,
    "CVXQP3_M": 1.36282874e6, "LISWET1": 3.61224021e1, "YAO": 1.97704256e2, "POWELL20": 5.20895828e10, "DTOC3": 2.35262481e2,
}


def program(name, P, q, constant=0.0, rows=None, at_least=None, equal=None, b=None, lb=None, ub=None):
    """rows x ≥ at_least, equal x = b; `constant` is part of the published optimum."""
    q = np.asarray(q, float)

    def matrix(given, sign=1.0):
        made = sign * sp.csc_matrix(given, dtype=float)
        made.sort_indices()  # some of the solvers take that for granted
        return made

    def bounds(given):
        return None if given is None else np.broadcast_to(np.asarray(given, float), q.shape).copy()

    made = Problem(matrix(P), q, None if rows is None else matrix(rows, -1.0), None if rows is None else -np.asarray(at_least, float),
                   None if equal is None else matrix(equal), None if equal is None else np.asarray(b, float), bounds(lb), bounds(ub), name)
    made.constant = constant
    return made


def least_squares(name, A, c, **rest):
    """min |A x − c|²"""
    A, c = np.asarray(A, float), np.asarray(c, float)
    return program(name, 2 * A.T @ A, -2 * A.T @ c, c @ c, **rest)


def small():
    """Hock & Schittkowski (1981), Schittkowski (1987), Zecevic (1983)."""
    yield program("HS21", np.diag([0.02, 2]), [0, 0], -100, [[10, -1]], [10], lb=[2, -50], ub=50)
    hs35 = [[4, 2, 2], [2, 4, 0], [2, 0, 2]]
    yield program("HS35", hs35, [-8, -6, -4], 9, [[-1, -1, -2]], [-3], lb=0)
    yield program("HS35MOD", hs35, [-8, -6, -4], 9, [[-1, -1, -2]], [-3], lb=[0, 0.5, 0], ub=[np.inf, 0.5, np.inf])
    joined = [[1, 3, 0, 0, 0], [0, 0, 1, 1, -2], [0, 1, 0, 0, -1]]
    squares = np.array([[1, -1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0], [0, 0, 0, 0, 1]])
    yield least_squares("HS51", squares, [0, 2, 1, 1], equal=joined, b=[4, 0, 0])
    yield least_squares("HS52", squares + np.outer([1, 0, 0, 0], [3, 0, 0, 0, 0]), [0, 2, 1, 1], equal=joined, b=[0, 0, 0])
    yield least_squares("HS53", squares, [0, 2, 1, 1], equal=joined, b=[0, 0, 0], lb=-10, ub=10)
    yield program("HS76", [[2, 0, -1, 0], [0, 1, 0, 0], [-1, 0, 2, 1], [0, 0, 1, 1]], [-1, -3, 1, -1], 0,
                  [[-1, -2, -1, -1], [-3, -1, -2, 1], [0, 1, 4, 0]], [-5, -4, 1.5], lb=0)
    yield hs118()
    d = [[10197, -12454, -1013, 1948, 329], [-12454, 20909, -1733, -4914, -186], [-1013, -1733, 1755, 1089, -174], [1948, -4914, 1089, 1515, -22],
         [329, -186, -174, -22, 27]]
    yield program("HS268", 2 * np.array(d), -2 * np.array([-9170, 17099, -2271, -4336, -43]), 14463,
                  [[-1, -1, -1, -1, -1], [10, 10, -3, 5, 4], [-8, 1, -2, -5, 3], [8, -1, 2, 5, -3], [-4, -2, 3, -5, 1]], [-5, 20, -40, 11, -30])
    yield least_squares("TAME", [[1, -1]], [0], equal=[[1, 1]], b=[1], lb=0)
    yield program("ZECEVIC2", np.diag([0, 4]), [-2, -3], 0, [[-1, -1], [-1, -4]], [-2, -4], lb=0, ub=10)
    sums = np.eye(9, 10) + np.eye(9, 10, 1)
    yield least_squares("GENHS28", sums, np.zeros(9), equal=np.eye(8, 10) + 2 * np.eye(8, 10, 1) + 3 * np.eye(8, 10, 2), b=np.ones(8))


def hs118():
    """Production in five periods: three goods each, small steps from one period to the next."""
    q = np.tile([2.3, 1.7, 2.2], 5)
    P = np.diag(np.tile([2e-4, 2e-4, 3e-4], 5))
    step = np.eye(12, 15, 3) - np.eye(12, 15)
    sums = np.kron(np.eye(5), np.ones((1, 3)))
    lb, ub = np.zeros(15), np.tile([90.0, 120, 60], 5)
    lb[:3], ub[:3] = [8, 43, 3], [21, 57, 16]
    return program("HS118", P, q, 0, np.vstack([step, -step, sums]),
                   np.concatenate([np.full(12, -7), np.tile([-6, -7, -6], 4), [60, 50, 70, 85, 100]]), lb=lb, ub=ub)


def cvxqp(name, n, m):
    """Gould's CVXQP: ½ Σ i (xᵢ + x₍₂ᵢ₋₁₎ + x₍₃ᵢ₋₁₎)², indices modulo n plus 1; m equations, bounds 0.1 and 10. P is singular."""
    i = np.arange(1, n + 1)

    def combine(count, first, second, factors):
        at = np.stack([i - 1, (first * i - 1) % n, (second * i - 1) % n], axis=1)[:count]
        return sp.csr_matrix((np.tile(np.asarray(factors, float), count), (np.repeat(np.arange(count), 3), at.ravel())), shape=(count, n))

    sums = combine(n, 2, 3, [1, 1, 1])
    return program(name, sums.T @ sp.diags(i.astype(float)) @ sums, np.zeros(n), equal=combine(m, 4, 5, [1, 2, 3]), b=np.full(m, 6.0), lb=0.1, ub=10)


def second_differences(n):
    return sp.diags([1.0, -2.0, 1.0], [0, 1, 2], shape=(n - 2, n))


def liswet1(n=10_002):
    """Li & Swetits (1993): the convex sequence nearest to noisy values of a root."""
    i = np.arange(1, n + 1)
    c = np.sqrt((i - 1) / (n - 1)) + 0.1 * np.sin(i)
    return program("LISWET1", sp.identity(n), -c, 0.5 * c @ c, second_differences(n), np.zeros(n - 2))


def yao(n=2002):
    """Yao: the convex sequence nearest to a sine that begins with 0.08 at least and ends in two zeros."""
    c = np.sin(np.arange(1, n + 1) / n)
    lb, ub = np.full(n, -np.inf), np.full(n, np.inf)
    lb[0], lb[-2:], ub[-2:] = 0.08, 0, 0
    return program("YAO", sp.identity(n), -c, 0.5 * c @ c, second_differences(n), np.zeros(n - 2), lb=lb, ub=ub)


def powell20(n=10_000):
    """Powell (1990): min ½|x|², steps that are as large as their index at least, up and down in turns."""
    k = np.arange(1, n)
    step = sp.diags([-1.0, 1.0], [0, 1], shape=(n - 1, n))
    back = sp.csr_matrix(([1.0, -1.0], ([0, 0], [0, n - 1])), shape=(1, n))
    return program("POWELL20", sp.identity(n), np.zeros(n), rows=sp.vstack([step, back]), at_least=np.append((-1.0) ** k * k - 0.5, n - 0.5))


def dtoc3(times=5000):
    """Coleman & Liao (1995): control of an oscillator; two states at each time, one control between two times. The first state is given."""
    s = 1 / times
    weight = np.concatenate([[0, 0], np.tile([2 * s, s], times - 1), np.full(times - 1, 6 * s)])
    now, then = sp.eye(times - 1, times), sp.eye(times - 1, times, 1)
    move = sp.kron(now, [[1, s], [-s, 1]]) - sp.kron(then, np.eye(2))
    push = sp.kron(sp.identity(times - 1), [[0], [s]])
    lb, ub = np.full(len(weight), -np.inf), np.full(len(weight), np.inf)
    lb[:2] = ub[:2] = [15, 5]
    return program("DTOC3", sp.diags(weight), np.zeros(len(weight)), equal=sp.hstack([move, push]), b=np.zeros(2 * (times - 1)), lb=lb, ub=ub)


def by_formula():
    """All of them, small ones first."""
    yield from small()
    for size, n in (("S", 100), ("M", 1000)):
        for kind, share in ((1, 2), (2, 4), (3, 4)):
            yield cvxqp(f"CVXQP{kind}_{size}", n, n // share if kind < 3 else 3 * n // 4)
    yield yao()
    yield liswet1()
    yield powell20()
    yield dtoc3()
