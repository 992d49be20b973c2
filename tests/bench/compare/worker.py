"""A process of its own for every candidate: a peer that hangs or crashes stops nothing, and its peak memory is its own."""
import ctypes
import multiprocessing
import os
import resource
import signal
import time
from dataclasses import dataclass

import numpy as np

from .errors import Errors
from .peers import DUAL_DENSE, DUAL_SPARSE

_fork = multiprocessing.get_context("fork")  # the problem is there already
PR_SET_PDEATHSIG = 1
SHORTEST_TURN = 2e-3  # s: what is faster is repeated within a turn


@dataclass
class Turn:
    """One turn of a candidate. seconds: the median over the turn's repeats."""
    seconds: float
    around: float
    claimed: bool
    errors: Errors
    memory: float  # MB above what the process had before


def _turn(session, problem, candidate, known):
    solve = session.known if known else session.cold
    outcome = solve()
    if outcome is None:
        return None
    seconds, around = [outcome.seconds], [outcome.around]
    while sum(around) < SHORTEST_TURN:
        outcome = solve()
        seconds.append(outcome.seconds)
        around.append(outcome.around)
    extra = problem.dual_seconds(known) if candidate.form in (DUAL_SPARSE, DUAL_DENSE) else 0
    return float(np.median(seconds)) + extra, float(np.median(around)) + extra, outcome


def _peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def keep_freed_memory():
    """As in a process that has run for a while: glibc hands memory back to the system from twice the largest block on that was ever freed. In a new
    process that is 128 KB, and most of a cold solve of a few hundred rows are page faults; later it is 64 MB, and half of a cold solve of 10⁵ links is. Here all
    blocks up to 32 MB, glibc's limit, stay, for libmlcp and for peers alike. Workers are forked and inherit it."""
    trim_threshold, mmap_threshold = -1, -3  # malloc.h: M_TRIM_THRESHOLD, M_MMAP_THRESHOLD
    mallopt = ctypes.CDLL(None).mallopt
    if not (mallopt(mmap_threshold, 32 << 20) and mallopt(trim_threshold, 2**31 - 1)):
        raise OSError("mallopt: glibc does not keep what is freed")


def _serve(pipe, problem, candidate):
    try:
        session = candidate.open(problem)
        before = _peak()
        while True:
            known = pipe.recv()
            turn = _turn(session, problem, candidate, known)
            if turn is None:
                pipe.send(None)
                continue
            memory = _peak() - before
            seconds, around, outcome = turn
            pipe.send(Turn(seconds, around, outcome.claimed, problem.error(outcome.v, outcome.gamma), memory))
    except EOFError:
        pass
    except Exception as error:  # whatever a peer throws is its answer
        pipe.send(f"{type(error).__name__}: {error}")
    finally:
        os._exit(0)


class Worker:
    """A candidate on a problem, in its own process."""

    def __init__(self, problem, candidate):
        self.candidate = candidate
        self.why = None  # of a worker that is gone
        self._pipe, theirs = _fork.Pipe()
        # silence what peers print
        self._process = _fork.Process(target=self._silently, args=(theirs, problem, candidate), daemon=True)
        self._process.start()
        theirs.close()

    @staticmethod
    def _silently(pipe, problem, candidate):
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)  # ends with its parent, also when that is killed
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        _serve(pipe, problem, candidate)

    def turn(self, known, limit):
        """A Turn; None where there is no such thing, and where the worker failed: then `why` tells."""
        if self.why:
            return None
        try:
            self._pipe.send(known)
            deadline = time.monotonic() + limit
            if not self._pipe.poll(max(0.0, deadline - time.monotonic())):
                return self._gone(f"more than {limit:g} s")
            answer = self._pipe.recv()
        except (EOFError, OSError):
            return self._gone("crashed")
        return self._gone(answer) if isinstance(answer, str) else answer

    def _gone(self, why):
        self.why = why
        self.close()

    def close(self):
        self._pipe.close()
        self._process.kill()
        self._process.join()
