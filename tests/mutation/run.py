#!/usr/bin/env python3
"""Breaks the ratio test and the row toggles on purpose, one place at a time, and expects the unit and property tests to notice.

    tests/mutation/run.py BUILD_FOLDER [NAME...]      a copy of the tree is made and built there; names: only those mutations

Prints a line for each and ends with "N passed, N failed"; a mutation that survives is a failure: it needs a test.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
RATIO, FACTOR, KERNELS, BASIS = ("core/solve/ratio_test.cpp", "core/factorize/factor.cpp", "core/factorize/kernel_loops.h", "core/solve/basis.cpp")

# name: file, text that stands there exactly once, what takes its place
MUTATIONS = {
    "step to w = 0: sign": (RATIO, "arrive(-set.w[entering] / slopes[entering]", "arrive(set.w[entering] / slopes[entering]"),
    "step to w = 0: not for dependent rows": (RATIO, "if (!direction.dependent) arrive(", "arrive("),
    "far bound: upper forgotten": (RATIO, "if (direction.sign > 0 && k.hi[entering] < infinity)", "if (false)"),
    "far bound: lower forgotten": (RATIO, "if (direction.sign < 0 && k.lo[entering] > -infinity)", "if (false)"),
    "far bound: direction": (RATIO, "arrive(gamma - k.lo[entering]", "arrive(k.lo[entering] - gamma"),
    "blocking: slope of the impulse": (RATIO, "const double slope = -dx[position[o]];", "const double slope = dx[position[o]];"),
    "blocking: lower bounds forgotten": (RATIO, "if (slope < 0 && k.lo[o] > -infinity)", "if (false)"),
    "blocking: upper bounds forgotten": (RATIO, "if (slope > 0 && k.hi[o] < infinity)", "if (false)"),
    "blocking: distance to the wrong bound": (RATIO, "std::max(k.hi[o] - basis.gamma(o), 0.0)", "std::max(k.lo[o] - basis.gamma(o), 0.0)"),
    "blocking: last instead of first": (RATIO, "if (std::abs(distance) > step.length * std::abs(slope) ||", "if (std::abs(distance) < step.length * std::abs(slope) ||"),
    "blocking: rows at rest too": (RATIO, "if (state[o] != ActiveSet::active) continue;", ""),
    "ties: greatest index": (RATIO, "row(o) < row(step.blocking)", "row(o) > row(step.blocking)"),
    "printed rule: satisfied rows never block": (RATIO, "if (rule == MLCP_PIVOT_PRINTED && !direction.dependent)", "if (false)"),
    "printed rule: at the lower bound, slope": (RATIO, "w >= -zero && slope < 0", "w >= -zero && slope > 0"),
    "printed rule: at the upper bound, slope": (RATIO, "w <= zero && slope > 0", "w <= zero && slope < 0"),
    "removal: sign of the update": (FACTOR, "rank_one(p, 1 / pivot_[p], work)", "rank_one(p, -1 / pivot_[p], work)"),
    "removal: update skipped": (FACTOR, "const FactorStatus status = rank_one(p, 1 / pivot_[p], work);", "const FactorStatus status = FactorStatus::ok;"),
    "removal: row of L stays": (FACTOR, "values_[t] = 0;\n  clear_row(p, work);\n  in_[p] = 0;", "values_[t] = 0;\n  in_[p] = 0;"),
    "removal: pivot stays": (FACTOR, "pivot_[p] = inverse_[p] = 0;\n  return status;", "return status;"),
    "insertion: sign of the update": (FACTOR, "return rank_one(p, -1 / d, work);", "return rank_one(p, 1 / d, work);"),
    "insertion: update skipped": (FACTOR, "return rank_one(p, -1 / d, work);", "return FactorStatus::ok;"),
    "insertion: pivot without its row": (FACTOR, "d -= y[j] * (y[j] * inverse_[j]);\n        values_", "values_"),
    "insertion: row of L forgotten": (FACTOR, "values_[symbolic_->pointers[j] + place - (j - s.first)] = y[j];", ""),
    "insertion: one place beside": (FACTOR, "+ place - (j - s.first)] = y[j]", "+ place - (j - s.first) - (place > j - s.first)] = y[j]"),
    "insertion: dependent rows enter": (FACTOR, "if (drop > 0 && !(std::abs(d) > drop * kkt_->a[o])) {", "if (false) {"),
    "update: stops at the first run": (FACTOR, "first = symbolic_->parent[symbolic_->run_end[first] - 1])", "first = -1)"),
    "update: scale of the rest": (KERNELS, "sigma *= d / updated;", "sigma *= updated / d;"),
    "update: pivot stays": (KERNELS, "f.pivot[j] = updated;", ""),
    "update: inverse stays": (KERNELS, "f.inverse[j] = 1 / updated;", ""),
    "update: lost pivots pass": (KERNELS, "if (!(size_of(updated) > 1e-12 * size_of(d)) || (updated > 0) != (d > 0)) {", "if (false) {"),
    "basis: a removal is not made": (BASIS, "fresh = factor.remove(position(f.o), counts.work) != FactorStatus::ok;", ""),
    "basis: an insertion is not made": (BASIS, "const FactorStatus status = factor.insert(position(f.o), counts.work, drop);", "const FactorStatus status = FactorStatus::ok;"),
    "basis: a row that leaves keeps its impulse": (BASIS, "  rest(o, to);\n", "  set.state[o] = to;\n"),
}


def copy_tree(work: pathlib.Path) -> None:
    """The files that git knows, as they are now."""
    names = subprocess.run(["git", "ls-files", "-z", "core", "capi", "cmake", "examples", "tests", "CMakeLists.txt", "CMakePresets.json", "VERSION", "mlcp.pc.in", "LICENSE"],
                           cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    for name in filter(None, names):
        source, target = ROOT / name, work / name
        if not source.is_file() or (target.is_file() and target.read_bytes() == source.read_bytes()):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, target)


def build(work: pathlib.Path) -> bool:
    command = ["cmake", "--build", work / "build", "-j", str(os.cpu_count()), "--target", "unit_tests", "property_tests"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        print(done.stdout[-3000:])
    return done.returncode == 0


def noticed(work: pathlib.Path) -> bool:
    """By a test that fails, a crash or a run without end."""
    for tests in ("unit_tests", "property_tests"):
        try:
            done = subprocess.run([work / "build" / "bin" / tests, "--gtest_fail_fast", "--gtest_brief=1"], cwd=work / "build", capture_output=True, timeout=900)
        except subprocess.TimeoutExpired:
            return True
        if done.returncode:
            return True
    return False


def survives(work: pathlib.Path, name: str) -> str:
    """"" if the tests notice it, else what is wrong."""
    file, old, new = MUTATIONS[name]
    target = work / file
    text = target.read_text()
    if text.count(old) != 1:
        return f"{file} has its text {text.count(old)} times: bring the list up to date"
    target.write_text(text.replace(old, new))
    try:
        if not build(work):
            return "does not compile"
        return "" if noticed(work) else "survives"
    finally:
        target.write_text(text)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build_folder", type=pathlib.Path)
    parser.add_argument("names", nargs="*", metavar="NAME")
    arguments = parser.parse_args()
    if unknown := [name for name in arguments.names if name not in MUTATIONS]:
        parser.error(f"no such mutation: {', '.join(unknown)}")
    work = arguments.build_folder.resolve()
    copy_tree(work)
    configure = ["cmake", "-S", work, "-B", work / "build", "-DCMAKE_BUILD_TYPE=Release", "-DMLCP_BUILD_TESTS=ON", "-DMLCP_BUILD_EXAMPLES=ON", "-DMLCP_INSTALL=OFF"]
    subprocess.run([*configure, *(["-G", "Ninja"] if shutil.which("ninja") else [])], check=True, stdout=subprocess.DEVNULL)
    if not build(work) or noticed(work):
        print("the tests fail without any mutation")
        return 1
    failed = 0
    names = arguments.names or list(MUTATIONS)
    for name in names:
        fault = survives(work, name)
        failed += bool(fault)
        print(f"{name}: {fault or 'noticed'}", flush=True)
    print(f"{len(names) - failed} passed, {failed} failed")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
