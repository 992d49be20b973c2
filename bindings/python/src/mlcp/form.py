"""What folders of Matrix Market files and FCLIB files hold alike, in their signs.

::

    global   M v = k + Jᵀγ,  w = J v + shift        reduced   w = A γ + shift

Bilateral rows come first (w = 0), then groups of rows that are contacts, the normal one first, then plain unilateral rows.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

from ._core import Problem
from .errors import FormatError, UnsupportedError

if TYPE_CHECKING:
    from ._core import Friction

__all__ = ["ProblemFile"]


class ProblemFile(NamedTuple):
    """A problem that was read and where its rows stand in the files."""

    problem: Problem
    file_rows: NDArray[np.int64]  #: of each row of the problem
    file_row_count: int  #: rows in the files, those of friction included

    def in_files(self, gamma: NDArray[np.float64]) -> NDArray[np.float64]:
        """Impulses in the order of the files, 0 for rows that were left out."""
        spread = np.zeros(self.file_row_count)
        spread[self.file_rows] = gamma
        return spread


@dataclass
class ProblemForm:
    """The global form has mass, k and jacobian, the reduced one a."""

    bilateral: int
    shift: NDArray[np.float64]
    mass: Any = None
    k: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    jacobian: Any = None
    a: Any = None
    contacts: int = 0
    dimension: int = 1
    mu: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    keys: NDArray[np.uint64] | None = None  #: of the library, 0: none

    @property
    def end_of_contacts(self) -> int:
        return self.bilateral + self.contacts * self.dimension


def compressed_rows(matrix: Any, source: object) -> Any:
    """CSR of a matrix by entries or of a dense one; `source` names it where an entry comes twice."""
    compressed = scipy.sparse.csr_array(matrix)
    if scipy.sparse.issparse(matrix) and compressed.nnz != matrix.nnz:
        raise FormatError(f"{source}: an entry comes twice")
    return compressed


def make_problem(form: ProblemForm, problem_class: type[Problem], friction: Friction | None) -> ProblemFile:
    """Without friction the tangent rows of contacts are left out; rows of a group beyond the third (rolling) always are."""
    kept = 1 if friction is None else min(form.dimension, 3)
    row = np.arange(len(form.shift))
    in_group = (row >= form.bilateral) & (row < form.end_of_contacts)
    chosen = row[~in_group | ((row - form.bilateral) % form.dimension < kept)]
    shift, lo = form.shift[chosen], np.where(chosen < form.bilateral, -np.inf, 0.0)
    keys = None if form.keys is None else form.keys[chosen]
    if form.a is not None:
        problem = problem_class.from_reduced(form.a[chosen][:, chosen], shift, lo, keys=keys)
    else:
        problem = problem_class.from_matrices(form.mass, form.k, form.jacobian[chosen], 0.0 - shift, lo, keys=keys)
    if friction is not None and kept > 1 and form.contacts:
        problem.declare_contacts(form.bilateral + kept * np.arange(form.contacts), kept, mu=form.mu, model=friction)
    return ProblemFile(problem, chosen, len(form.shift))


def form_of(problem: Problem) -> ProblemForm:
    """The form of a problem. Prescribed bodies have no place in it: their velocities go into the shift.

    Raises
    ------
    UnsupportedError
        The form cannot hold it: rows that are neither bilateral nor unilateral (0 ≤ γ), compliance beside velocities, contacts in the plane
        and in space at once, fixed bounds of friction.
    """
    contacts = problem.contacts
    if len(np.unique(contacts.dimension)) > 1:
        raise UnsupportedError("the form cannot hold contacts in the plane and in space at once")
    if "box" in contacts.model:
        raise UnsupportedError(f"the form cannot hold the fixed bounds of contact {contacts.model.index('box')}")
    dimension = int(contacts.dimension[0]) if len(contacts.row) else 1
    grouped = (contacts.row[:, np.newaxis] + np.arange(dimension)).ravel()
    plain = np.setdiff1d(np.arange(problem.rows), grouped)
    free = (problem.lo[plain] == -np.inf) & (problem.hi[plain] == np.inf)
    neither = plain[~free & ((problem.lo[plain] != 0) | (problem.hi[plain] != np.inf))]
    if len(neither):
        raise UnsupportedError(f"the form cannot hold row {neither[0]}: neither bilateral nor unilateral")
    order = np.concatenate([plain[free], grouped, plain[~free]])
    form = ProblemForm(int(np.count_nonzero(free)), 0.0 - problem.r[order], contacts=len(contacts.row), dimension=dimension, mu=contacts.mu,
                       keys=problem.keys[order])
    if problem.velocities == 0:
        form.a = problem.compliance_matrix().tocsr()[order][:, order]
        return form
    if problem.compliance_matrix().count_nonzero():
        raise UnsupportedError("the form cannot hold compliance beside velocities")
    dynamic, given = np.ones(problem.velocities, bool), np.zeros(problem.velocities)
    for body in problem.bodies:
        if (velocity := problem.given_velocity(body)) is not None:
            dynamic[problem.body_slice(body)], given[problem.body_slice(body)] = False, velocity
    jacobian = problem.jacobian()[order]
    form.shift = form.shift + jacobian @ given
    form.mass, form.k, form.jacobian = problem.mass().tocsr()[dynamic][:, dynamic], problem.momentum[dynamic], jacobian[:, dynamic]
    return form
