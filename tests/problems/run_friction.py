#!/usr/bin/env python3
"""The three figures of friction on the real contact problems: how many answers of the `mlcp` program reach which error by the folder's own
verify.py, for the convex pyramid with 8 facets, the Coulomb pyramid with 8 facets and the circular cone.

    run_friction.py MLCP PROBLEMS [--seconds S] [--filter REGEX] [--fclib]

Takes the symmetric problems with contacts that PROBLEMS/INDEX.tsv lists. Exits 0 only if every convex answer is right to 1e-9, 90 % of the
Coulomb pyramids to 1e-8, 80 % of the circular cones to 1e-6, and no answer claims more than verify.py finds. --fclib: PROBLEMS/*.hdf5
must be solved too, and after writing and reading back. Needs numpy and scipy.
"""
import argparse
import csv
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from run_shared import load_verify

# friction, facets, error that counts, share that must reach it
FIGURES = [("convex", 8, 1e-9, 1.0), ("coulomb", 8, 1e-8, 0.9), ("coulomb", None, 1e-6, 0.8)]
BOUNDS = (1e-12, 1e-9, 1e-8, 1e-6)
TOLERANCE = 1e-9  # the program's own


def contact_problems(root, pattern):
    with open(root / "INDEX.tsv", newline="") as file:
        rows = [r for r in csv.DictReader(file, delimiter="\t") if r["symmetry"] == "symmetric" and int(r["dim"]) > 1]
    return [r["name"] for r in rows if re.search(pattern, r["name"])]


def solve(program, problem, friction, facets, seconds):
    command = [program, "solve", str(problem), "--friction", friction, "--output", "json", "--max-seconds", str(seconds)]
    done = subprocess.run(command + (["--facets", str(facets)] if facets else []), capture_output=True, text=True, timeout=10 * seconds)
    answer = json.loads(done.stdout)
    if "gamma" not in answer or None in answer["gamma"] or None in answer["v"]:
        raise ValueError(answer.get("message", answer["status"]))
    return answer


def figure(options, verify, friction, facets, bound, share):
    name = f"{friction}, {f'{facets} facets' if facets else 'circular cone'}"
    print(f"\n{name}\n{'problem':26} {'status':16} {'error':>8} {'solves':>6} {'facets':>6} {'open':>5} {'stick':>5} {'slide':>5} {'ms':>9}")
    errors, dishonest = [], 0
    for problem in contact_problems(options.problems, options.filter):
        answer = solve(options.program, options.problems / problem, friction, facets, options.seconds)
        error = verify.errors(options.problems / problem, answer, friction, facets)["largest"]
        lied = answer["status"] == "solved" and not error <= 2 * TOLERANCE
        dishonest += lied
        errors.append(error)
        f = answer["friction"]
        print(f"{problem:26} {answer['status']:16} {error:8.1e} {f['shift_iterations']:6} {f['facets']:6} {f['open']:5} {f['sticking']:5} "
              f"{f['sliding']:5} {1000 * answer['seconds']:9.2f}{'  SAYS SOLVED' if lied else ''}", flush=True)
    reached = {b: sum(e <= b for e in errors) for b in BOUNDS}
    print("reached " + ", ".join(f"{b:g}: {n}" for b, n in reached.items()) + f" of {len(errors)}")
    return sum(e <= bound for e in errors) >= share * len(errors) and not dishonest


def fclib_round_trip(options):
    good = True
    for path in sorted(options.problems.glob("*.hdf5")):
        with tempfile.TemporaryDirectory() as folder:
            copy = str(Path(folder) / "copy.hdf5")
            subprocess.run([options.program, "convert", str(path), copy], check=True)
            answers = [solve(options.program, p, "coulomb", None, options.seconds) for p in (path, copy)]
        same = answers[0]["gamma"] == answers[1]["gamma"] and answers[0]["status"] == "solved"
        print(f"{path.name}: {answers[0]['status']}, {'the same' if same else 'NOT THE SAME'} after writing and reading back")
        good &= same
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("problems", type=Path)
    parser.add_argument("--seconds", type=float, default=10, help="a problem [10]")
    parser.add_argument("--filter", default="", help="only names that match this regular expression")
    parser.add_argument("--fclib", action="store_true", help="the program was built with FCLIB")
    options = parser.parse_args()
    verify = load_verify(options.problems)
    results = [figure(options, verify, *f) for f in FIGURES]
    if options.fclib:
        results.append(fclib_round_trip(options))
    print(f"{sum(results)} passed, {len(results) - sum(results)} failed")
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
