"""The words and the small records in which results are told."""

from __future__ import annotations

from enum import Enum, IntEnum
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._core import Mask, Problem, Solver

__all__ = ["Certificate", "ContactState", "Contacts", "Counts", "Drawing", "Errors", "Exhibit", "Factor", "Outcome", "Progress", "Role", "RowState", "Snapshot", "Times"]


class Outcome(str, Enum):
    """How a solve ended. Equal to its name as a string: ``result.status == "solved"``."""

    SOLVED = "solved"  #: every error recomputed from the problem is within the tolerance
    ITERATION_LIMIT = "iteration_limit"  #: max_iterations, or no further progress above the tolerance
    WORK_LIMIT = "work_limit"  #: max_work entries touched
    TIME_LIMIT = "time_limit"  #: max_seconds passed
    INTERRUPTED = "interrupted"  #: Ctrl-C, the progress callback or Solver.interrupt
    INFEASIBLE = "infeasible"  #: rows contradict each other; the certificates name them
    UNBOUNDED = "unbounded"  #: only for semidefinite M: a ray along which the energy falls without end
    NOT_POSITIVE_DEFINITE = "not_positive_definite"  #: M (or Σ of a reduced problem) is indefinite

    __str__ = str.__str__


class RowState(IntEnum):
    """Where a row stands, the entries of a `Mask`."""

    DISABLED = 0  #: not part of the problem: costs nothing, constrains nothing, impulse 0
    AT_LOWER = 1  #: impulse at lo; for a contact: open
    ACTIVE = 2  #: w = 0, impulse between the bounds
    AT_UPPER = 3  #: impulse at hi


class ContactState(IntEnum):
    """What a contact does, the entries of `Result.contact_states`."""

    DISABLED = 0  #: its normal row is left out
    OPEN = 1  #: no impulse
    STICKING = 2  #: no slip
    SLIDING = 3  #: it slips, and the impulse is at the limit of friction


class Errors(NamedTuple):
    """Errors recomputed from the problem's own numbers; not finite: inf."""

    momentum: float  #: max |Mv − Jᵀγ − k|ᵢ / (|M||v| + |J|ᵀ|γ| + |k|)ᵢ
    constraints: float  #: max |median(w, a(γ − lo), a(γ − hi))|ᵢ over the row's own scale
    largest: float  #: the largest of momentum, constraints and cone
    momentum_residual: float  #: max |Mv − Jᵀγ − k|ᵢ, N·s
    constraint_residual: float  #: max |median(w, a(γ − lo), a(γ − hi))|ᵢ, m/s
    worst_velocity: int  #: where momentum is, −1 if n = 0; not positive definite: whose pivot failed
    worst_row: int  #: where constraints is, −1 if there is none
    worst_body: int  #: the body whose mass is not positive definite, else −1; the row in a reduced problem
    cone: float  #: of contacts with a cone, whose rows are not in constraints: distances of γ and w to the cones, and |γ·w|/|γ|
    cone_residual: float  #: the same, m/s
    worst_contact: int  #: where cone is, −1 if there is none


class Counts(NamedTuple):
    """What a solve did."""

    islands: int  #: connected components of dynamic bodies and enabled rows
    islands_failed: int  #: of them not solved
    enabled_rows: int
    active_rows: int
    redundant_rows: int
    pivots: int  #: steps of the simplex, Newton steps, sweeps of Gauss-Seidel
    toggles: int  #: rows taken into or out of the factor
    factorizations: int
    refinements: int  #: steps of iterative refinement
    work: int  #: entries of L, J and M touched
    factor_entries: int  #: below the diagonal of L, every enabled row in
    analyzed: bool  #: this solve had to analyze
    refactorized_for_drift: int
    warm: bool  #: started from a mask, given or found by keys
    fallbacks: int  #: islands that newton or pgs gave up and another method solved
    contacts_open: int  #: contacts with friction, as all that follow
    contacts_sticking: int
    contacts_sliding: int
    generators: int  #: rows that stand for cones in the solves
    facets: int  #: most generators that one contact needed
    shift_iterations: int  #: solves of the iteration for friction
    islands_by_lemke: int  #: islands that the finite fallback solved


class Times(NamedTuple):
    """Where the time went, s, wall clock."""

    total: float
    analyze: float  #: 0 if the pattern was known
    factorize: float
    solve: float
    report: float  #: measuring the errors


class Certificate(NamedTuple):
    """Proof that rows of one island contradict each other: Jᵀy = 0 and rᵀy > 0."""

    island: int
    rows: NDArray[np.int32]
    y: NDArray[np.float64]


class Progress(NamedTuple):
    """What a progress callback is told."""

    seconds: float
    pivots: int
    work: int  #: entries touched so far
    island: int  #: the one being solved
    islands: int
    violation: float  #: largest one in this island, relative as in `Errors`


class Factor(NamedTuple):
    """Pattern of L, every enabled row in, in elimination order; what couples to nothing is not in it."""

    nodes: NDArray[np.int32]  #: what stands at a position: velocity j as j, row i as n + i
    pointers: NDArray[np.int64]  #: compressed columns, positions + 1
    rows: NDArray[np.int32]  #: positions, ascending in each column, strictly below the diagonal


class Snapshot(NamedTuple):
    """What a snapshot holds. Masks that were not saved are None."""

    problem: Problem
    solver: Solver
    enabled: Mask | None
    start: Mask | None


class Contacts(NamedTuple):
    """The contacts of a problem, in order of adding: arrays of their number."""

    row: NDArray[np.int32]  #: the normal one; the tangents follow it
    dimension: NDArray[np.int32]  #: rows a contact
    model: list[str]  #: "none", "convex", "coulomb", "box" or "findex"
    mu: NDArray[np.float64]
    facets: NDArray[np.int32]


class Exhibit(NamedTuple):
    """A scene that there is, and the steps of 0.01 s that make a film of it."""

    unit: str  #: what its size counts
    size: int  #: when it is not given
    steps: int
    every: int  #: a frame each so many steps
    start: int  #: the step of the first frame


class Role(IntEnum):
    """What a thing is to a scene."""

    BODY = 0
    PRODUCT = 1
    MACHINE = 2
    DRIVE = 3
    GROUND = 4


class Drawing(NamedTuple):
    """What there is to see of a scene, in the world's frame, m. A scene in the plane has y = 0 and its height in z."""

    spheres: NDArray[np.float64]  #: (count, 4): centre and radius
    boxes: NDArray[np.float64]  #: (count, 8, 3): corners; corner 4i + 2j + k lies at −x or +x (i), −y or +y (j), −z or +z (k)
    paths: list[NDArray[np.float64]]  #: (points, 3) each: bodies that are lines, and the ground
    points: NDArray[np.float64]  #: (m, 3): where each row acts
    directions: NDArray[np.float64]  #: (m, 3): γ/h is the force along it on body b, and its opposite on body a
    sphere_roles: NDArray[np.uint8]  #: (count,): a `Role` each
    faces: list[NDArray[np.float64]]  #: (corners, 3) each: flat polygons, seen from the side where they run counterclockwise
    face_roles: NDArray[np.uint8]  #: (faces,): a `Role` each
    eye: NDArray[np.float64]  #: (3,): the direction from which the scene is best seen
