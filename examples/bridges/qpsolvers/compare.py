#!/usr/bin/env python3
"""Errors and times of mlcp and the sparse solvers of qpsolvers on programs of the Maros-Meszaros set, run by qpbenchmark.

    compare.py [--solvers mlcp clarabel highs osqp piqp proxqp qpalm scs] [--programs NAME...] [--settings default high_accuracy]

The error is the largest of qpsolvers' primal residual, dual residual and duality gap, which are absolute; the time is that of the processor.
OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 RAYON_NUM_THREADS=1 keep the solvers on one core.
"""
import argparse
import contextlib
import itertools
import logging
import os
import tempfile
import time
import warnings
from unittest import mock

import numpy as np
import qpbenchmark.utils
import qpsolvers
from maros_meszaros import MarosMeszaros
from qpbenchmark.results import Results
from qpbenchmark.run import run


def measure(test_set, solvers, settings):
    """qpbenchmark's results, a row for each program, solver and settings, with processor time instead of its wall clock."""
    logging.disable(logging.WARNING)
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(), open(os.devnull, "w") as nowhere, \
            contextlib.redirect_stdout(nowhere), mock.patch.object(qpbenchmark.utils, "perf_counter", time.process_time):
        warnings.simplefilter("ignore")  # of peers, about formats and settings
        results = Results(os.path.join(folder, "results.csv"), test_set)
        for solver, name in itertools.product(solvers, settings):
            run(test_set, results, only_solver=solver, only_settings=name)
        return results.df


def table_of(frame, settings, solvers):
    """A line a program: the larger of its residuals and its duality gap, and the time; what is best is bold."""
    yield f"| {settings.replace('_', ' ')} | " + " | ".join(solvers) + " |"
    yield "|---" * (1 + len(solvers)) + "|"
    chosen = frame[frame["settings"] == settings]
    for name in dict.fromkeys(chosen["problem"]):
        cells = chosen[chosen["problem"] == name].set_index("solver")
        error = cells[["primal_residual", "dual_residual", "duality_gap"]].max(axis=1).where(cells["found"], np.inf)
        seconds = cells["runtime"].where(np.isfinite(error), np.inf)
        yield f"| {name} | " + " | ".join(cell(error[solver], seconds[solver], error.min(), seconds.min()) for solver in solvers) + " |"


def cell(error, seconds, best_error, best_seconds):
    if not np.isfinite(error):
        return "–"
    texts = [f"{error:.0e}", f"{1e3 * seconds:.2g} ms"]
    return ", ".join(f"**{text}**" if best else text for text, best in zip(texts, (error == best_error, seconds == best_seconds)))


def summary_of(frame, solvers, settings):
    """How many have an error below a bound, and the geometric mean of the times over the programs that all have found."""
    bounds = (1e-3, 1e-6, 1e-9)
    yield "| settings | solver | found | " + " | ".join(f"error < {bound:.0e}" for bound in bounds) + " | time, ms |"
    yield "|---|---|---|" + "---|" * len(bounds) + "---|"
    for name in settings:
        chosen = frame[frame["settings"] == name]
        by_all = chosen.groupby("problem")["found"].all()
        for solver in solvers:
            cells = chosen[chosen["solver"] == solver]
            error = cells[["primal_residual", "dual_residual", "duality_gap"]].max(axis=1).where(cells["found"], np.inf)
            times = cells["runtime"][cells["problem"].map(by_all)]
            yield (f"| {name.replace('_', ' ')} | {solver} | {int(cells['found'].sum())} of {len(cells)} | "
                   + " | ".join(str(int((error < bound).sum())) for bound in bounds) + f" | {1e3 * np.exp(np.log(times).mean()):.2g} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--solvers", nargs="+", default=["mlcp", *sorted(set(qpsolvers.sparse_solvers) - {"mlcp"})])
    parser.add_argument("--programs", nargs="+")
    parser.add_argument("--settings", nargs="+", default=["default", "high_accuracy"])
    options = parser.parse_args()
    frame = measure(MarosMeszaros(options.programs), options.solvers, options.settings)
    for settings in options.settings:
        print(*table_of(frame, settings, options.solvers), "", sep="\n")
    print(*summary_of(frame, options.solvers, options.settings), sep="\n")


if __name__ == "__main__":
    main()
