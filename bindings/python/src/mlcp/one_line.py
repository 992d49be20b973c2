"""The one-line functions: matrices in, arrays out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, overload

import numpy as np
import scipy.sparse
from numpy.typing import ArrayLike, NDArray

from ._core import Mask, Problem, Result, Solver
from .errors import ArgumentError, NotSolved
from .records import RowState

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._core import MatrixLike, SolverSettings

__all__ = ["QPSolution", "solve", "solve_lcp", "solve_qp"]


def solve(mass: MatrixLike, momentum: ArrayLike, jacobian: MatrixLike | None = None, r: ArrayLike = 0.0, lo: ArrayLike = 0.0,
          hi: ArrayLike = np.inf, *, compliance: MatrixLike = 0.0, **settings: Unpack[SolverSettings]) -> Result:
    """Solve a problem of multibody dynamics given by its matrices.

    ::

        M v − Jᵀ γ = k,   J v + Σ γ − r = w,   lo ≤ γ ≤ hi,   wᵢ > 0 ⇒ γᵢ = lo,   wᵢ < 0 ⇒ γᵢ = hi,   else wᵢ = 0

    Parameters
    ----------
    mass : (n, n) sparse or dense, or (bodies, d, d) dense blocks
        M, symmetric positive definite, kg.
    momentum : (n,) array or number
        k, N·s.
    jacobian : (m, n) sparse or dense, optional
        J. None: no rows.
    r, lo, hi : (m,) array or number
        Right-hand side, m/s, and bounds on the impulses, N·s; lo = −inf with hi = inf for joints, the default for contacts.
    compliance : (m,) array, number, or (m, m) sparse or dense
        Σ, m/(N·s): its diagonal or all of it.
    **settings
        Keywords of `Solver`.

    Returns
    -------
    Result
        Also when it is not solved: see `Result.status`.
    """
    return Solver(**settings).solve(Problem.from_matrices(mass, momentum, jacobian, r, lo, hi, compliance=compliance))


@overload
def solve_lcp(A: MatrixLike, b: ArrayLike, lo: ArrayLike = ..., hi: ArrayLike = ..., *, full_output: Literal[False] = ...,
              **settings: Unpack[SolverSettings]) -> NDArray[np.float64]: ...
@overload
def solve_lcp(A: MatrixLike, b: ArrayLike, lo: ArrayLike = ..., hi: ArrayLike = ..., *, full_output: Literal[True],
              **settings: Unpack[SolverSettings]) -> Result: ...
def solve_lcp(A: MatrixLike, b: ArrayLike, lo: ArrayLike = 0.0, hi: ArrayLike = np.inf, *, full_output: bool = False,
              **settings: Unpack[SolverSettings]) -> NDArray[np.float64] | Result:
    """Solve the linear complementarity problem w = A z + b, 0 ≤ z ⊥ w ≥ 0.

    Parameters
    ----------
    A : (m, m) sparse or dense
        Symmetric and positive semidefinite, up to rounding.
    b : (m,) array or number
    lo, hi : (m,) array or number
        lo ≤ z ≤ hi for a mixed problem: a row with −inf and inf is free (w = 0), and w < 0 is right where z = hi.
    full_output : bool
        Return the `Result`, whose ``gamma`` is z, also when it is not solved.
    **settings
        Keywords of `Solver`.

    Returns
    -------
    (m,) array
        z.

    Raises
    ------
    NotSolved
        There is no solution, or a limit came first; not with ``full_output=True``.
    ArgumentError
        A is not symmetric.
    """
    result = Solver(**settings).solve(Problem.from_reduced(A, b, lo, hi))
    if full_output:
        return result
    if not result.solved:
        raise NotSolved(result)
    return result.gamma


class QPSolution(NamedTuple):
    """Solution of a quadratic program, duals with the signs of ``qpsolvers``: P x + q + Gᵀ z + Aᵀ y + z_box = 0."""

    x: NDArray[np.float64]  #: (n,)
    z: NDArray[np.float64]  #: multipliers of G x ≤ h, ≥ 0; empty without G
    y: NDArray[np.float64]  #: multipliers of A x = b; empty without A
    z_box: NDArray[np.float64]  #: (n,) multipliers of lb ≤ x ≤ ub: ≤ 0 at lb, ≥ 0 at ub
    objective: float  #: ½ xᵀ P x + qᵀ x
    result: Result


@overload
def solve_qp(P: MatrixLike, q: ArrayLike, G: MatrixLike | None = ..., h: ArrayLike | None = ..., A: MatrixLike | None = ...,
             b: ArrayLike | None = ..., lb: ArrayLike | None = ..., ub: ArrayLike | None = ..., *, initvals: ArrayLike | None = ...,
             full_output: Literal[False] = ..., **settings: Unpack[SolverSettings]) -> NDArray[np.float64]: ...
@overload
def solve_qp(P: MatrixLike, q: ArrayLike, G: MatrixLike | None = ..., h: ArrayLike | None = ..., A: MatrixLike | None = ...,
             b: ArrayLike | None = ..., lb: ArrayLike | None = ..., ub: ArrayLike | None = ..., *, initvals: ArrayLike | None = ...,
             full_output: Literal[True], **settings: Unpack[SolverSettings]) -> QPSolution: ...
def solve_qp(P: MatrixLike, q: ArrayLike, G: MatrixLike | None = None, h: ArrayLike | None = None, A: MatrixLike | None = None,
             b: ArrayLike | None = None, lb: ArrayLike | None = None, ub: ArrayLike | None = None, *, initvals: ArrayLike | None = None,
             full_output: bool = False, **settings: Unpack[SolverSettings]) -> NDArray[np.float64] | QPSolution:
    """Solve the convex quadratic program min ½ xᵀ P x + qᵀ x under G x ≤ h, A x = b, lb ≤ x ≤ ub.

    The arguments stand in the order of ``qpsolvers``.

    Parameters
    ----------
    P : (n, n) sparse or dense
        Symmetric positive definite, both triangles; a semidefinite one will do where the solution is finite.
    q : (n,) array
    G, h : (k, n) sparse or dense and (k,) array, optional
        Rows with h = inf constrain nothing.
    A, b : (l, n) sparse or dense and (l,) array, optional
    lb, ub : (n,) array or number, optional
        −inf and inf constrain nothing; where both are equal x is fixed.
    initvals : (n,) array, optional
        A guess of x: the solve starts from the constraints that it meets with equality, to 1e-6 of what they sum up.
    full_output : bool
        Return a `QPSolution` with the multipliers and the `Result`, also when it is not solved.
    **settings
        Keywords of `Solver`.

    Returns
    -------
    (n,) array
        x.

    Raises
    ------
    NotSolved
        The program is infeasible or unbounded, P is indefinite, or a limit came first; not with ``full_output=True``.
    ArgumentError, RangeError
        Naming argument and index.
    """
    rows = _QPRows(np.size(q))
    rows.inequalities(G, h)
    rows.equalities(A, b)
    rows.box(lb, ub)
    problem = Problem.from_matrices(P, -np.asarray(q, dtype=np.float64))
    if rows.blocks:
        problem.add_matrix_rows(scipy.sparse.vstack(rows.blocks, format="csr"), np.concatenate(rows.r), np.concatenate(rows.lo))
    start = None if initvals is None else _active_at(problem, initvals)
    result = Solver(**settings).solve(problem, start)
    if full_output:
        x = result.v
        z, y, z_box = rows.multipliers(result.gamma)
        return QPSolution(x, z, y, z_box, float(0.5 * x @ (problem.mass() @ x) - x @ problem.momentum), result)
    if not result.solved:
        raise NotSolved(result)
    return result.v


def _active_at(problem: Problem, x: ArrayLike) -> Mask:
    """The rows that x meets with equality are active, the others at rest."""
    guess = np.asarray(x, dtype=np.float64)
    if guess.shape != (problem.velocities,):
        raise ArgumentError(f"initvals has shape {guess.shape}, not ({problem.velocities},)")
    jacobian, r = problem.jacobian(), problem.r
    active = (np.abs(jacobian @ guess - r) <= 1e-6 * (abs(jacobian) @ np.abs(guess) + np.abs(r))) | (problem.lo == -np.inf)
    return Mask(np.where(active, RowState.ACTIVE, RowState.AT_LOWER))


class _QPRows:
    """The constraints of a quadratic program as rows J x − r = w ≥ 0, or w = 0 where lo = −inf."""

    def __init__(self, n: int) -> None:
        self.n = n
        self.blocks: list[Any] = []
        self.r: list[NDArray[np.float64]] = []
        self.lo: list[NDArray[np.float64]] = []
        self.at: dict[str, tuple[int, NDArray[np.int64]]] = {}  # first row, and the indices it holds of what the caller gave
        self.sizes = {"G": 0, "A": 0}
        self.count = 0

    def _add(self, name: str, block: Any, r: NDArray[np.float64], index: NDArray[np.int64], lo: float) -> None:
        if not len(index):
            return
        self.blocks.append(block[index])
        self.r.append(r[index])
        self.lo.append(np.full(len(index), lo))
        self.at[name] = self.count, index
        self.count += len(index)

    def _pair(self, matrix: MatrixLike | None, side: ArrayLike | None, names: str) -> tuple[Any, NDArray[np.float64]] | None:
        if matrix is None and side is None:
            return None
        if matrix is None or side is None:
            raise ArgumentError(f"{names[0]} and {names[1]} are given together or not at all")
        block = scipy.sparse.csr_array(matrix if scipy.sparse.issparse(matrix) else np.atleast_2d(np.asarray(matrix)))
        right = np.atleast_1d(np.asarray(side, dtype=np.float64))
        if block.shape != (len(right), self.n) or right.ndim != 1:
            raise ArgumentError(f"{names[0]} has shape {block.shape} and {names[1]} {right.shape}, not (k, {self.n}) and (k,)")
        self.sizes[names[0]] = len(right)
        return block, right

    def inequalities(self, G: MatrixLike | None, h: ArrayLike | None) -> None:
        if pair := self._pair(G, h, "Gh"):
            self._add("G", -pair[0], -pair[1], np.flatnonzero(pair[1] != np.inf), 0.0)

    def equalities(self, A: MatrixLike | None, b: ArrayLike | None) -> None:
        if pair := self._pair(A, b, "Ab"):
            self._add("A", pair[0], pair[1], np.arange(len(pair[1])), -np.inf)

    def box(self, lb: ArrayLike | None, ub: ArrayLike | None) -> None:
        identity = scipy.sparse.identity(self.n, format="csr")
        lower, upper = self._side(lb, -np.inf, "lb"), self._side(ub, np.inf, "ub")
        fixed = lower == upper
        self._add("fixed", identity, lower, np.flatnonzero(fixed), -np.inf)
        self._add("lb", identity, lower, np.flatnonzero((lower != -np.inf) & ~fixed), 0.0)
        self._add("ub", -identity, -upper, np.flatnonzero((upper != np.inf) & ~fixed), 0.0)

    def _side(self, side: ArrayLike | None, nothing: float, name: str) -> NDArray[np.float64]:
        bound = np.asarray(nothing if side is None else side, dtype=np.float64)
        if bound.shape not in ((), (self.n,)):
            raise ArgumentError(f"{name} has shape {bound.shape}, not ({self.n},)")
        return np.broadcast_to(bound, (self.n,))

    def multipliers(self, gamma: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """z, y and z_box. P x + q = Jᵀ γ with J = −G, A, I (lb), −I (ub)."""
        z, y, z_box = np.zeros(self.sizes["G"]), np.zeros(self.sizes["A"]), np.zeros(self.n)
        for name, (array, sign) in {"G": (z, 1), "A": (y, -1), "fixed": (z_box, -1), "lb": (z_box, -1), "ub": (z_box, 1)}.items():
            if name in self.at:
                first, index = self.at[name]
                array[index] += sign * gamma[first:first + len(index)]
        return z, y, z_box
