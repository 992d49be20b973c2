"""Who runs on a problem: the library's methods and every setting of every peer that fits."""
from dataclasses import dataclass, field

from . import library as lib
from .peers import DUAL_SPARSE, PRIMAL_DENSE, PRIMAL_SPARSE, Outcome
from .problem import LARGEST_DENSE

OURS = "libmlcp"


@dataclass
class Candidate:
    """One curve's point: a solver in one form with one setting. open(problem) makes its session, with cold() and known()."""
    solver: str
    form: str
    setting: str
    tolerance: float
    open: object = field(repr=False)


class LibrarySession:
    """The library as a peer: the same cold() and known()."""

    def __init__(self, problem, method, tolerance):
        self._run = lib.Run(problem.library, problem.handle, problem.n, problem.m, method, tolerance)

    def cold(self):
        return self._timed(lib.COLD)

    def known(self):
        return self._timed(lib.KNOWN)

    def _timed(self, how):
        seconds = float(self._run.time(how, 1)[0])
        answer = self._run.answer()
        return Outcome(seconds, seconds, answer.outcome == lib.SOLVED, answer.v, answer.gamma)


def ours(library, tolerances=(1e-9,)):
    for number, name in library.methods().items():
        for tolerance in tolerances:
            def open_session(problem, number=number, tolerance=tolerance):
                return LibrarySession(problem, number, tolerance)
            yield Candidate(f"{OURS} {name}", "", f"{tolerance:g}", tolerance, open_session)


def fits(problem, form):
    if form in (PRIMAL_SPARSE, PRIMAL_DENSE):
        return problem.primal is not None and (form == PRIMAL_SPARSE or max(problem.n, problem.m) <= LARGEST_DENSE / 2)
    return problem.dual is not None and (form == DUAL_SPARSE or problem.m <= LARGEST_DENSE)


def of_peer(peer, problem):
    for form in peer.forms:
        if not fits(problem, form):
            continue
        for text, arguments in peer.settings.items():
            def open_session(problem, form=form, arguments=arguments):
                return peer(problem, form, **arguments)
            yield Candidate(peer.name, form, text, arguments.get("tolerance", 0.0), open_session)
