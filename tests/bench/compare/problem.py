"""A problem in the forms in which solvers want it."""
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from .errors import INFINITE, Measure, product
from .library import Dual

# a peer that wants dense matrices is not asked beyond this many unknowns
LARGEST_DENSE = 4000


@dataclass
class QP:
    """min ½ xᵀH x + gᵀx, l ≤ C x ≤ u, lo ≤ x ≤ hi; C or the bounds are None. H and C are compressed columns."""
    H: sp.csc_matrix
    g: np.ndarray
    C: sp.csc_matrix | None = None
    l: np.ndarray | None = None
    u: np.ndarray | None = None
    lo: np.ndarray | None = None
    hi: np.ndarray | None = None

    @cached_property
    def dense_H(self):
        return np.ascontiguousarray(self.H.toarray())

    @cached_property
    def dense_C(self):
        return np.ascontiguousarray(self.C.toarray())


class Problem:
    """One MLCP. The handle belongs to the library's side and lives as long as this object."""

    def __init__(self, name, family, library, handle):
        self.name, self.family, self.library, self.handle = name, family, library, handle
        self.M, self.J, self.S = (library.matrix(handle, which) for which in ("mass", "jacobian", "compliance"))
        self.S.eliminate_zeros()
        self.k, self.r, self.lo, self.hi = library.vectors(handle)
        self.n, self.m = len(self.k), len(self.r)

    def __del__(self):
        if handle := getattr(self, "handle", None):
            self.library.destroy(handle)

    @cached_property
    def measure(self):
        return Measure(self.M, self.J, self.S, self.k, self.r, self.lo, self.hi)

    @cached_property
    def bilateral(self):
        return np.isinf(self.lo) & np.isinf(self.hi)

    @cached_property
    def primal(self):
        """min ½ vᵀM v − kᵀv under J v ≥ r, = r on bilateral rows; None where Σ or boxes do not fit that form."""
        unilateral = (self.lo == 0) & np.isinf(self.hi)
        if self.n == 0 or self.S.nnz or not np.all(unilateral | self.bilateral):
            return None
        return QP(self.M, -self.k, self.J.tocsc(), self.r, np.where(self.bilateral, self.r, np.inf))

    @cached_property
    def _dual_form(self):
        return Dual(self.library, self.handle, self.m)

    @cached_property
    def _dual_seconds(self):
        repeats = 5
        analyze, form = self._dual_form.time(repeats)
        return float(np.median(analyze)), float(np.median(form))

    def dual_seconds(self, known):
        """What forming the dual adds to a peer's time: pattern and numbers, or numbers alone. Nothing where it is given."""
        if self.n == 0:
            return 0.0
        analyze, form = self._dual_seconds
        return form if known else analyze + form

    @cached_property
    def dual(self):
        """min ½ γᵀA γ + bᵀγ under lo ≤ γ ≤ hi; None where A is too full or does not exist."""
        entries_of_cliques = np.sum(np.bincount(self.J.indices, minlength=max(self.n, 1)).astype(float) ** 2)
        if entries_of_cliques > 1e8 or (self.m > LARGEST_DENSE and self.n > 0 and self._largest_block() > LARGEST_DENSE):
            return None
        try:
            self._dual_seconds
        except RuntimeError:  # M is singular
            return None
        A, b = self._dual_form.view()
        return QP(A, b, lo=self.lo, hi=self.hi)

    def _largest_block(self):
        _, label = sp.csgraph.connected_components(self.M, directed=False)
        return int(np.max(np.bincount(label)))

    @cached_property
    def _mass_factor(self):
        return splu(self.M.tocsc())

    def velocities(self, gamma):
        """v = M⁻¹(k + Jᵀγ), refined once in extended precision: the momentum balance is not what a peer of the dual is judged by."""
        if self.n == 0:
            return np.empty(0)
        right = self.measure.k + product(self.measure.JT, gamma)
        v = self._mass_factor.solve(right.astype(float))
        return v + self._mass_factor.solve((right - product(self.measure.M, v)).astype(float))

    def error(self, v, gamma):
        """The errors of an answer. A peer's own v may be replaced by M⁻¹(k + Jᵀγ) where that is better for it."""
        best = INFINITE
        if v is not None:
            best = self.measure.largest(v, gamma)
        if np.all(np.isfinite(gamma)):
            try:
                best = best.combine(self.measure.largest(self.velocities(gamma), gamma), min)
            except RuntimeError:  # M is singular
                pass
        return best
