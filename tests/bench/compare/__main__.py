"""tests/bench/run: see its --help."""
import argparse
import os
import platform
import re
import sys
from pathlib import Path

from . import candidates, families, figures, plots, rounds, sequences, tables
from .library import Library
from .peers import all_peers, native as native_peers
from .worker import keep_freed_memory

# of the picture in the README
CHOSEN = ("humanoid_fall", "humanoids22", "spheres_356", "stacked_boxes", "pile 300", "pile 3000", "rope 10000", "wall 10", "islands 100")
FOR_FIGURES = {figures.PILE, figures.LARGE_PILE}


def arguments():
    parser = argparse.ArgumentParser(prog="tests/bench/run", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--native", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--quick", action="store_true", help="small problems and few repeats: about 2 minutes, for work on the benchmark")
    parser.add_argument("--figures", action="store_true", help="only what the table of figures needs, and that table")
    parser.add_argument("--problems", type=Path, metavar="FOLDER", help="real problems [$MLCP_PROBLEMS, ../shared/problems where it is]")
    parser.add_argument("--only", metavar="REGEX", help="only problems whose name matches; no table of figures")
    parser.add_argument("--peers", metavar="REGEX", default="", help="only peers whose name matches")
    parser.add_argument("--limit", type=float, metavar="S", help="of one solve of one peer [60, quick 3]")
    parser.add_argument("--seconds", type=float, metavar="S", help="for the repeats of one candidate on one problem [2, quick 0.1]")
    parser.add_argument("--output", type=Path, metavar="FOLDER", required=True, help="where CSV, tables and plots go")
    return parser.parse_args()


def sources(options, folder):
    """The problems to compare on, real ones first."""
    found = families.shared(folder) if folder else []
    found += families.scenes() + families.machines()
    if options.quick:
        found = [source for source in found if source.name in families.QUICK]
    elif options.only:
        found = [source for source in found if re.search(options.only, source.name)]
    elif options.figures:
        found = [source for source in found if source.family == "real" or source.name in FOR_FIGURES]
    return found


def compare(library, found, peers, budget, tolerances, csv_file):
    rows = []
    for number, source in enumerate(found, 1):
        try:
            problem = source.problem(library)
        except RuntimeError as error:
            print(f"left out: {source.name}: {error}")
            continue
        contestants = list(candidates.ours(library, tolerances))
        for peer in peers:
            contestants += candidates.of_peer(peer, problem)
        print(f"[{number}/{len(found)}] {problem.name}: {problem.n} velocities, {problem.m} rows, {len(contestants)} candidates", flush=True)
        rows += rounds.compare(problem, contestants, budget)
        tables.write_csv(csv_file, rows)  # a run that is stopped keeps what it has
    return rows


def head(library, peers, missing):
    lines = [f"libmlcp {library.version()}, {platform.machine()}, {os.cpu_count()} CPUs, one thread, load {os.getloadavg()[0]:.1f}", "",
             "| peer | version | whose clock |", "| --- | --- | --- |"]
    lines += [f"| {peer.name} | {peer.version()} | {peer.timer} |" for peer in peers]
    lines += [f"| {peer.name} | left out: not installed | |" for peer in missing]
    return "\n".join(lines) + "\n"


def main():
    options = arguments()
    sys.stdout.reconfigure(line_buffering=True)
    keep_freed_memory()
    library = Library(options.build / "lib" / "libmlcp_bench.so")
    native = Library(options.native / "lib" / "libmlcp_bench.so") if options.native else None
    native_peers.folder = options.build / "lib"
    installed = [peer for peer in all_peers() if peer.available()]
    missing = [peer for peer in all_peers() if not peer.available()]
    peers = [peer for peer in installed if re.search(options.peers, peer.name)]
    folder = options.problems if options.problems and (options.problems / "INDEX.tsv").exists() else None
    if folder is None:
        print("left out: the real problems; give their folder with --problems")

    options.output.mkdir(parents=True, exist_ok=True)
    budget = rounds.Budget(options.seconds or (0.1 if options.quick else 2), options.limit or (3 if options.quick else 60),
                           5 if options.quick else 21)
    tolerances = (1e-9,) if options.figures else (1e-3, 1e-6, 1e-9, 1e-12)
    rows = compare(library, sources(options, folder), peers, budget, tolerances, options.output / "times.csv")
    if not options.figures:
        plots.write(options.output, rows, CHOSEN)
    report = [head(library, peers, missing), "## Problems\n", tables.summary(rows), "## Solvers\n", tables.solvers(rows),
              "## Wrong answers that claim success\n", tables.wrong(rows)]
    if not options.only:
        report += ["## Warm sequences\n", sequences.table(sequences.all_of(library, folder, options.quick))]
        every = [*figures.from_rows(rows), *figures.measured_alone(library, native, folder, options.quick)]
        report += ["## Figures\n", figures.markdown(every)]
    text = "\n".join(report)
    (options.output / "report.md").write_text(text)
    print("\n" + text)
    print(f"written: {options.output}/times.csv, report.md" + ("" if options.figures else ", *.svg"))


main()
