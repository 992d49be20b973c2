"""All candidates on one problem: one look at each, then medians of turns that they take one after the other."""
from dataclasses import dataclass

import numpy as np

from .worker import Worker

REACHED = 1e-9    # the error at which a candidate counts
WRONG = 1e-3      # with a larger error than this a claim of success is wrong, if what was asked for is
SERIOUS = 1e-6    # this or less, or exact


@dataclass
class Row:
    """One line of the CSV. seconds is NaN where there is no such time."""
    problem: str
    family: str
    n: int
    m: int
    solver: str
    form: str
    setting: str
    cold: float = np.nan
    cold_around: float = np.nan
    known: float = np.nan
    known_around: float = np.nan
    error: float = np.inf        # by section "report" of mlcp.h; the largest of all turns
    normwise: float = np.inf     # the same residuals against the largest scale of the problem
    claimed: bool = False
    memory: float = np.nan       # MB
    turns: int = 0
    note: str = ""

    asked: float = 0.0           # tolerance; 0: none to be set

    @property
    def reached(self):
        return self.error <= REACHED

    @property
    def reached_normwise(self):
        return self.normwise <= REACHED

    @property
    def wrong(self):
        return self.claimed and self.asked <= SERIOUS and not self.normwise <= WRONG


@dataclass
class Budget:
    """seconds: for the repeats of one candidate. limit: for one turn. turns: at most so many."""
    seconds: float
    limit: float
    turns: int


def _sweep(problem, candidates, budget):
    """A worker for every candidate that did not fail, after a first turn. Where one took too long, tighter settings of the same peer and
    form are left out."""
    hopeless = set()
    for candidate in candidates:
        row = Row(problem.name, problem.family, problem.n, problem.m, candidate.solver, candidate.form,
                  candidate.setting, asked=candidate.tolerance)
        if (candidate.solver, candidate.form) in hopeless:
            row.note = "left out: a looser setting took too long"
            yield row, None, None
            continue
        worker = Worker(problem, candidate)
        first = worker.turn(False, budget.limit)
        if first is None:
            row.note = worker.why
            if worker.why.startswith("more than"):
                hopeless.add((candidate.solver, candidate.form))
            yield row, None, None
        else:
            row.memory = first.memory
            yield row, worker, first


def compare(problem, candidates, budget):
    """Rows of all candidates; medians over turns in turns, `known` after `cold`."""
    contestants = [(row, worker, [first], []) for row, worker, first in _sweep(problem, candidates, budget)]
    wanted = {id(row): (1 if worker is None else max(1, min(budget.turns, int(budget.seconds / max(first.around, 1e-6)))))
              for (row, worker, (first,), _) in contestants}
    for turn in range(max(wanted.values(), default=0)):
        for row, worker, cold, known in contestants:
            if worker is None or turn >= wanted[id(row)]:
                continue
            if turn > 0:
                _keep(cold, worker.turn(False, budget.limit))
            if cold[0].errors.normwise <= REACHED:  # others do not count, and large ones take long
                _keep(known, worker.turn(True, budget.limit))
    for row, worker, cold, known in contestants:
        if worker is not None:
            row.turns = len(cold)
            row.cold, row.cold_around = (float(np.median([getattr(t, which) for t in cold])) for which in ("seconds", "around"))
            row.error, row.normwise = max(t.errors.strict for t in cold), max(t.errors.normwise for t in cold)
            row.claimed = any(t.claimed for t in cold)
            if known and max(t.errors.normwise for t in known) <= REACHED:
                row.known, row.known_around = (float(np.median([getattr(t, which) for t in known])) for which in ("seconds", "around"))
            row.note = worker.why or ""
            worker.close()
        yield row


def _keep(turns, turn):
    if turn is not None:
        turns.append(turn)
