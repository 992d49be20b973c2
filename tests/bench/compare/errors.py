"""What counts as an error: section "report" of capi/mlcp.h, written a second time and in extended precision.

A body that a wall holds still has the scale 0 but for rounding: there 1e-13 m/s against 0 is an error of 1 by the strict measure, and whoever
stops at a tolerance fails it on every pile. So there is a normwise one beside it.
"""
from dataclasses import dataclass

import numpy as np

EXTENDED = np.longdouble


def product(matrix, x):
    """matrix (compressed rows) times x, in extended precision."""
    terms = matrix.data.astype(EXTENDED) * x[matrix.indices]
    sums = np.zeros(matrix.shape[0], EXTENDED)
    filled = np.diff(matrix.indptr) > 0
    if terms.size:
        sums[filled] = np.add.reduceat(terms, matrix.indptr[:-1][filled])
    return sums


@dataclass
class Errors:
    """strict: every component against its own scale, as the report has it. normwise: the largest residual against the largest scale."""
    strict: float
    normwise: float

    @classmethod
    def of(cls, residual, scale):
        residual = np.abs(residual)
        if not np.all(np.isfinite(residual)):
            return INFINITE
        strict = np.max(residual / np.where(scale > 0, scale, 1), initial=0)
        return cls(float(strict), float(np.max(residual, initial=0) / (np.max(scale, initial=0) or 1)))

    def combine(self, other, choose):
        """choose: max of the parts of one answer, min of two answers that may stand for each other."""
        return Errors(choose(self.strict, other.strict), choose(self.normwise, other.normwise))


INFINITE = Errors(np.inf, np.inf)


class Measure:
    """The errors of points of one problem: M, J, Σ sparse, k, r, lo, hi."""

    def __init__(self, M, J, S, k, r, lo, hi):
        self.M, self.J, self.JT, self.S = M.tocsr(), J.tocsr(), J.T.tocsr(), S.tocsr()
        self.absolute = [abs(matrix) for matrix in (self.M, self.J, self.JT, self.S)]
        self.k, self.r, self.lo, self.hi = (x.astype(EXTENDED) for x in (k, r, lo, hi))
        diagonal = self.M.diagonal()
        diagonal = np.where(diagonal > 0, diagonal, 1).astype(EXTENDED)
        self.v0 = np.abs(self.k / diagonal)
        squares = self.J.copy()
        squares.data = squares.data ** 2
        self.a = product(squares, 1 / diagonal) + self.S.diagonal()

    def momentum(self, v, gamma):
        v, gamma = v.astype(EXTENDED), gamma.astype(EXTENDED)
        M, _, JT, _ = self.absolute
        residual = product(self.M, v) - product(self.JT, gamma) - self.k
        return Errors.of(residual, product(M, np.abs(v)) + product(JT, np.abs(gamma)) + np.abs(self.k))

    def constraints(self, v, gamma):
        v, gamma = v.astype(EXTENDED), gamma.astype(EXTENDED)
        _, J, _, S = self.absolute
        w = product(self.J, v) + product(self.S, gamma) - self.r
        with np.errstate(invalid="ignore"):
            low, high = self.a * (gamma - self.lo), self.a * (gamma - self.hi)
        residual = np.maximum(np.minimum(low, w), np.minimum(np.maximum(low, w), high))  # the median of three, high ≤ low
        return Errors.of(residual, product(J, np.abs(v) + self.v0) + product(S, np.abs(gamma)) + np.abs(self.r))

    def largest(self, v, gamma):
        if not (np.all(np.isfinite(v)) and np.all(np.isfinite(gamma))):
            return INFINITE
        return self.momentum(v, gamma).combine(self.constraints(v, gamma), max)
