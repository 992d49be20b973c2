"""The peers: one file each, all behind the same interface.

A peer is a class with
    name          as it appears in tables
    forms         the forms it can take, of FORMS
    settings      its sweep, from loose to tight: text -> keyword arguments of its constructor
    timer         whose clock is counted: its own, or ours around set-up and solve
    available()   whether it is installed
    version()     of what is installed
and its objects, one for each problem, form and setting, have
    cold()        set-up and solve                           -> Outcome
    known()       new values in a known pattern, and solve; None where the peer has no such thing
"""
import importlib.metadata
import importlib.util
from dataclasses import dataclass

import numpy as np

PRIMAL_SPARSE, PRIMAL_DENSE, DUAL_SPARSE, DUAL_DENSE = FORMS = ("primal", "primal, dense", "dual", "dual, dense")


class Packaged:
    """A peer that is a Python package. module: what is imported; package: what is installed."""

    @classmethod
    def available(cls):
        return importlib.util.find_spec(cls.module) is not None

    @classmethod
    def version(cls):
        return importlib.metadata.version(cls.package)


@dataclass
class Outcome:
    """seconds: what is counted. around: our clock around the same calls, Python's share included. v None: the peer solved for γ alone."""
    seconds: float
    around: float
    claimed: bool
    v: np.ndarray | None
    gamma: np.ndarray


def all_peers():
    from . import bullet, clarabel, daqp, highs, ode, osqp, piqp, proxqp, qpalm, qpoases
    return [module.Peer for module in (daqp, piqp, proxqp, osqp, clarabel, qpoases, qpalm, highs, ode, bullet)]
