#!/usr/bin/env python3
"""Designs of the gripper simulated on a Dask cluster, one task each: friction of its pads, clearance, masses.

    sweep.py                                        # a cluster on this machine, a process a core
    sweep.py --scheduler tcp://HOST:8786            # any other one
    sweep.py --friction 0 0.05 0.1 0.2 --part-mass 0.3 0.7 1.5 --csv sweep.csv
"""
import argparse
import csv
import hashlib
import itertools
import sys
from typing import NamedTuple

import dask.distributed as dd

import mlcp


class Outcome(NamedTuple):
    """What became of a design. `digest` is of the velocities of all steps, bit by bit."""

    design: dict[str, float]
    off_centre: float  # m
    slid: float  # m, of the part out of the gripper
    strongest: float  # N, of all forces of rows
    error: float  # the largest of all steps
    unsolved: int
    digest: str
    hardest: tuple[mlcp.Problem, mlcp.Mask | None]  # the step with the most work, and where it started


def simulate(design, fingers=8, steps=100, h=0.01):
    """Close the gripper on the part and hold it for the rest of `steps`."""
    scene = mlcp.Scene("gripper", fingers, design=design)
    digest = hashlib.sha256()
    strongest = error = 0.0
    unsolved, work, hardest = 0, -1, None
    for _ in range(steps):
        scene.prepare(h)
        problem, start = scene.problem, scene.start
        result = scene.finish()
        digest.update(result.v.tobytes())
        strongest, error = max(strongest, abs(result.gamma).max() / h), max(error, result.errors.largest)
        unsolved += not result.solved
        if result.counts.work > work:
            work, hardest = result.counts.work, (problem, start)
    measures = scene.measures
    return Outcome(design, measures["part_off_centre"], measures["part_slid"], strongest, error, unsolved, digest.hexdigest(), hardest)


def designs(**choices):
    """Every combination of the values."""
    return [dict(zip(choices, values)) for values in itertools.product(*choices.values())]


def sweep(client, chosen, steps=100, bar=None):
    """The outcomes of the designs, in their order, wherever they ran. bar: whether to show progress; None: when a person watches."""
    futures = client.map(simulate, chosen, steps=steps, pure=False)
    if sys.stdout.isatty() if bar is None else bar:
        dd.progress(futures, notebook=False)
        print()
    return client.gather(futures)


def solve(solver, problem, start):
    """On a worker: all three arguments, and the result, cross the border of processes."""
    return solver.solve(problem, start)


def least_norm(client, outcomes):
    """The hardest step of each design again, on the cluster, with equal loads where the method leaves a choice: the largest force of each, N s."""
    solver = mlcp.Solver(impulses="least_norm")
    problems, starts = zip(*(outcome.hardest for outcome in outcomes))
    return [abs(result.gamma).max() for result in client.gather(client.map(solve, [solver] * len(problems), problems, starts, pure=False))]


def print_table(outcomes):
    names = list(outcomes[0].design)
    print("".join(f"{name:>12}" for name in names) + f"{'off, mm':>10}{'slid, mm':>10}{'force, N':>10}{'error':>9}{'unsolved':>10}")
    for outcome in outcomes:
        print("".join(f"{outcome.design[name]:12g}" for name in names) + f"{1e3 * outcome.off_centre:10.3f}{1e3 * outcome.slid:10.3f}"
              f"{outcome.strongest:10.1f}{outcome.error:9.0e}{outcome.unsolved:10}")


def write_csv(outcomes, path):
    with open(path, "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow([*outcomes[0].design, "off_centre", "slid", "strongest", "error", "unsolved", "digest"])
        rows.writerows([*outcome.design.values(), *outcome[1:-1]] for outcome in outcomes)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scheduler", help="address of a running one, e.g. tcp://10.0.0.1:8786; without it a cluster of this machine's own")
    parser.add_argument("--workers", type=int, help="processes of the cluster on this machine [one a core]")
    parser.add_argument("--friction", type=float, nargs="+", default=[0.0, 0.1, 0.2, 0.4])
    parser.add_argument("--clearance", type=float, nargs="+", default=[0.014, 0.016, 0.018], help="m")
    parser.add_argument("--part-mass", type=float, nargs="+", default=[0.7, 2.0], help="kg")
    parser.add_argument("--finger-mass", type=float, nargs="+", default=[0.06], help="kg")
    parser.add_argument("--steps", type=int, default=100, help="of 0.01 s [100]")
    parser.add_argument("--csv", help="write the outcomes there too")
    options = parser.parse_args(arguments)
    chosen = designs(friction=options.friction, clearance=options.clearance, part_mass=options.part_mass, finger_mass=options.finger_mass)
    cluster = None if options.scheduler else dd.LocalCluster(n_workers=options.workers, threads_per_worker=1, dashboard_address=None)
    with dd.Client(options.scheduler or cluster) as client:
        print(f"{len(chosen)} designs on {len(client.scheduler_info(n_workers=-1)['workers'])} workers of {client.scheduler.address}")
        client.upload_file(__file__)
        outcomes = sweep(client, chosen, options.steps)
    if cluster:
        cluster.close()
    print_table(outcomes)
    if options.csv:
        write_csv(outcomes, options.csv)
    return 0 if all(outcome.unsolved == 0 for outcome in outcomes) else 1


if __name__ == "__main__":
    import sweep as module  # what tasks send must be found in a module by the workers, not in this program

    sys.exit(module.main())
