#!/usr/bin/env python3
"""Solve every shared problem with the `mlcp` program and check each answer with the folder's own verify.py.

    run_shared.py MLCP PROBLEMS [--tolerance T] [--seconds S] [--filter REGEX] [--json FILE]

Takes the problems that PROBLEMS/INDEX.tsv lists and the first step of every sequence. Symmetric ones must be solved with a
recomputed error of at most T; ones that are not symmetric must be refused with a message; for the few that no exact method can
promise, an honest refusal is as good. Exits 0 only if all that holds. Needs numpy and scipy.
"""
import argparse
import csv
import importlib.util
import json
import re
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

# M is singular: the simplex may refuse, newton must solve
SINGULAR = {"mm_cvxqp1m"}


@dataclass
class Problem:
    name: str
    folder: Path
    symmetric: bool
    may_refuse: bool


@dataclass
class Result:
    name: str
    rows: int
    status: str
    pivots: int
    seconds: float
    error: float
    passed: bool
    note: str = ""


def find_problems(root):
    with open(root / "INDEX.tsv", newline="") as file:
        listed = [(row["name"], row["symmetry"] == "symmetric") for row in csv.DictReader(file, delimiter="\t")]
    listed += [(f"{folder.name}/000", True) for folder in sorted(root.glob("sequence_*"))]
    for name, symmetric in listed:
        meta = json.loads((root / name / "meta.json").read_text())
        yield Problem(name, root / name, symmetric, name in SINGULAR or bool(meta.get("indefinite")))


def load_verify(root):
    spec = importlib.util.spec_from_file_location("verify", root / "verify.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def run(program, problem, method, seconds):
    """Exit code, answer as JSON or None, message, wall-clock seconds."""
    command = [program, "solve", str(problem.folder), "--method", method, "--output", "json"]
    begin = time.perf_counter()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return None, None, f"killed after {seconds:g} s", seconds
    elapsed = time.perf_counter() - begin
    try:
        answer = json.loads(done.stdout)
    except json.JSONDecodeError:
        answer = None
    return done.returncode, answer, done.stderr.strip(), elapsed


def refused_honestly(code, answer, message):
    """An exit code that says "not solved", and either a message or a status that says the same."""
    said = message or (answer or {}).get("status") not in (None, "solved")
    return code in (1, 2, 3) and bool(said)


def check(program, problem, verify, options):
    code, answer, message, elapsed = run(program, problem, options.method, options.seconds)
    answer = answer or {}
    result = Result(problem.name, len(answer.get("gamma", [])), answer.get("status", f"exit {code}"), answer.get("iterations", 0),
                    answer.get("seconds", elapsed), float("inf"), False, message.splitlines()[-1] if message else "")
    if "gamma" in answer and None not in answer["gamma"] and None not in answer["v"]:
        result.error = verify.errors(problem.folder, answer, "none", None)["largest"]
    solved = code == 0 and result.status == "solved" and result.error <= options.tolerance
    if not problem.symmetric:
        result.passed = code == 3 and bool(message)
    elif problem.may_refuse and options.method == "simplex":
        result.passed = solved or refused_honestly(code, answer, message)
    else:
        result.passed = solved
    return result


def print_row(result):
    error = "-" if result.error == float("inf") else f"{result.error:.1e}"
    verdict = "" if result.passed else "FAILED"
    print(f"{result.name:28} {result.rows:6} {result.status:22} {result.pivots:7} {result.seconds:9.4f} {error:>8}  "
          f"{verdict:6} {result.note}".rstrip(), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("problems", type=Path)
    parser.add_argument("--method", default="simplex")
    parser.add_argument("--tolerance", type=float, default=1e-9, help="on the error that verify.py finds [1e-9]")
    parser.add_argument("--seconds", type=float, default=60, help="a problem [60]")
    parser.add_argument("--filter", default="", help="only names that match this regular expression")
    parser.add_argument("--json", type=Path, help="also write the results there")
    options = parser.parse_args()
    if not (options.problems / "INDEX.tsv").exists():
        print(f"The shared problems are not at {options.problems}: this test was left out.")
        return 0
    verify = load_verify(options.problems)
    problems = [p for p in find_problems(options.problems) if re.search(options.filter, p.name)]
    print(f"{'name':28} {'rows':>6} {'status':22} {'pivots':>7} {'seconds':>9} {'error':>8}")
    results = []
    for problem in problems:
        results.append(check(options.program, problem, verify, options))
        print_row(results[-1])
    if options.json:
        options.json.write_text(json.dumps([asdict(r) for r in results], indent=1))
    required = [r for r, p in zip(results, problems) if p.symmetric]
    for bound in (1e-9, 1e-12):
        reached = sum(r.status == "solved" and r.error <= bound for r in required)
        print(f"error at most {bound:g}: {reached} of {len(required)} symmetric problems")
    failed = sum(not r.passed for r in results)
    print(f"{len(results) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
