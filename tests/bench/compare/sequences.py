"""Warm steps of recorded scenes against cold ones, and against the oracle: one factorization and solve of the final active set."""
from dataclasses import dataclass

import numpy as np

from . import families, library as lib, tables

METHOD, TOLERANCE = 0, 1e-9  # auto
PASSES = 3


@dataclass
class Sequence:
    """Seconds are medians over the steps but the first, each the median of passes in turns; ratios are medians of the steps' own."""
    name: str
    steps: int
    rows: int         # of the last step
    cold: float
    warm: float
    slow: float       # nine steps in ten are no slower, warm
    oracle: float
    to_cold: float
    to_oracle: float
    error: float      # the largest of all passes
    unsolved: int     # warm or cold


def measure(library, name, handles, passes=PASSES):
    """handles: of the steps; destroyed when done."""
    times, error, unsolved = {True: [], False: []}, 0.0, 0
    try:
        for _ in range(passes):
            for warm, kept in times.items():
                seconds, errors, outcomes, _ = library.sequence(handles, METHOD, TOLERANCE, warm)
                kept.append(seconds[1:])
                error = max(error, float(np.max(errors)))
                unsolved = max(unsolved, int(np.sum(outcomes != lib.SOLVED)))
        oracle = library.sequence(handles, METHOD, TOLERANCE, True, oracle=True)[3][1:]
        rows = library.rows(handles[-1])
    finally:
        for handle in handles:
            library.destroy(handle)
    warm, cold = (np.median(times[which], axis=0) for which in (True, False))
    return Sequence(name, len(warm) + 1, rows, float(np.median(cold)), float(np.median(warm)), float(np.quantile(warm, 0.9)), float(np.median(oracle)),
                    float(np.median(warm / cold)), float(np.median(warm / oracle)), error, unsolved)


def of_recording(library, recording, steps):
    """With and without friction, where there is some."""
    return [measure(library, name, recording.steps(library, facets, count=steps)) for name, facets in families.variants(recording)]


def real(library, folder):
    """Robots, and what else has been recorded elsewhere."""
    for name, handles in families.recorded(folder, library):
        yield measure(library, name, handles)


def all_of(library, folder, quick):
    for recording in families.SEQUENCES[-1:] if quick else families.SEQUENCES:
        yield from of_recording(library, recording, 10 if quick else families.STEPS)
    if folder is not None:
        yield from real(library, folder)


def table(sequences):
    head = ["scene", "steps", "rows", "cold", "warm", "nine in ten", "warm ÷ cold", "oracle", "warm ÷ oracle", "largest error", "not solved"]
    return tables.markdown(head, [[s.name, str(s.steps), str(s.rows), tables.duration(s.cold), tables.duration(s.warm), tables.duration(s.slow),
                                   f"{s.to_cold:.2g}", tables.duration(s.oracle), f"{s.to_oracle:.2g}", f"{s.error:.0e}", str(s.unsolved)]
                                  for s in sequences])
