"""The hard cases by the peers of the benchmark, beside what the library made of them: peers.csv, table.md, totals.md and hard.png. See tests/hard/run."""
import argparse
import csv
import re
from dataclasses import asdict, dataclass
from pathlib import Path

import matplotlib
import matplotlib.ticker
import numpy as np

from compare import candidates
from compare.library import Library
from compare.peers import all_peers, native
from compare.problem import Problem
from compare.worker import Worker

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  needs the backend first

WRONG = 1e-3       # by norm; what claims success with more is wrong
REACHED = 1e-9
STOPS = 2          # a form of a peer that was stopped at so many values in a row is not tried at the larger ones of the family
STOPPED, NOT_TRIED, DOES_NOT_FIT = "more than", "not tried", "does not fit"  # notes; the first begins the one of worker.py
SMALLEST = 1e-18   # of the picture
SHOWN = ("tower, heavy top", "chain of 100, heavy end", "light under heavy, 20 layers", "chain, end of 10 t", "wall, contacts repeated",
         "parallel rockers", "wall, rows of length 10^±p", "point on two planes", "two joints", "narrow wedge", "pile of 100 spheres", "Fathi")


@dataclass
class Answer:
    """Of one solver on one case. strict, norm: the errors of compare/errors.py; a peer's are those of the setting with the smallest by norm."""
    family: str
    parameter: str
    value: float
    expected: str
    solver: str
    claimed: bool
    strict: float = np.inf
    norm: float = np.inf
    seconds: float = np.nan
    wrong: bool = False
    note: str = ""


def tightest(peer, problem):
    """The candidates of a peer with its smallest tolerance, in every form that fits."""
    found = list(candidates.of_peer(peer, problem))
    least = min((candidate.tolerance for candidate in found), default=0)
    return [candidate for candidate in found if candidate.tolerance == least]


class Patience:
    """How often each form of each peer was stopped in a row, within a family."""

    def __init__(self, limit):
        self.limit = limit
        self._stops = {}

    def next_family(self):
        self._stops.clear()

    def is_over(self, candidate):
        return self._stops.get((candidate.solver, candidate.form, candidate.setting), 0) >= STOPS

    def count(self, candidate, stopped):
        key = candidate.solver, candidate.form, candidate.setting
        self._stops[key] = self._stops.get(key, 0) + 1 if stopped else 0


def by_peer(peer, problem, case, patience):
    """What a peer makes of a case, at its best over the forms that it takes."""
    best = Answer(*case, peer.name, False, note=DOES_NOT_FIT)
    for candidate in tightest(peer, problem):
        if patience.is_over(candidate):
            if best.note == DOES_NOT_FIT:
                best.note = NOT_TRIED
            continue
        worker = Worker(problem, candidate)
        turn = worker.turn(False, patience.limit)
        why = worker.why
        worker.close()
        patience.count(candidate, bool(why) and why.startswith(STOPPED))
        if turn is None:
            if not np.isfinite(best.norm):
                best.note = why or "no answer"
            continue
        wrong = turn.claimed and (case[3] == "infeasible" or not turn.errors.normwise <= WRONG)
        # an honest answer stands for the peer before one that claims too much
        if (wrong, turn.errors.normwise) < (best.wrong, best.norm) or not np.isfinite(best.seconds):
            best = Answer(*case, peer.name, turn.claimed, turn.errors.strict, turn.errors.normwise, turn.seconds, wrong,
                          f"{candidate.form} {candidate.setting}")
    return best


def of_library(lines):
    """What mlcp_hard_table found. Its errors are by component, which are no smaller than those by norm."""
    for line in lines:
        error = float(line["error"])
        claimed = line["outcome"] == "solved"
        yield Answer(line["family"], line["parameter"], float(line["value"]), line["expected"], "libmlcp " + line["method"], claimed, error, error,
                     float(line["seconds"]), claimed and (line["expected"] == "infeasible" or not error <= WRONG), line["outcome"])


def cases(folder, families):
    """Lines of library.csv, those of one case together. families: a regular expression."""
    groups = {}
    with open(folder / "library.csv", newline="") as file:
        for line in csv.DictReader(file):
            if re.search(families, line["family"]):
                groups.setdefault(line["snapshot"], []).append(line)
    return groups


def run(folder, families, library, peers, limit):
    answers = []
    groups = cases(folder, families)
    patience = Patience(limit)
    for number, (snapshot, lines) in enumerate(groups.items(), 1):
        first = lines[0]
        if answers and answers[-1].family != first["family"]:
            patience.next_family()
        case = first["family"], first["parameter"], float(first["value"]), first["expected"]
        answers += of_library(lines)
        if int(first["friction"]) or first["expected"] == "unbounded":
            continue
        print(f"[{number}/{len(groups)}] {case[0]}, {case[1]} {case[2]:g}", flush=True)
        problem = Problem(case[0], "hard", library, library.read(folder / snapshot))
        answers += [by_peer(peer, problem, case, patience) for peer in peers]
        write(folder / "peers.csv", answers)  # a run that is stopped keeps what it has
    return answers


def write(path, answers):
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, [*asdict(answers[0])])
        table.writeheader()
        table.writerows(asdict(answer) for answer in answers)


def read(path):
    with open(path, newline="") as file:
        for line in csv.DictReader(file):
            for field in ("value", "strict", "norm", "seconds"):
                line[field] = float(line[field])
            for field in ("claimed", "wrong"):
                line[field] = line[field] == "True"
            yield Answer(**line)


def is_near(answer):
    """By norm alone, whatever is claimed: what has no solution is right where no success is claimed."""
    return ((answer.expected != "infeasible" and answer.norm <= REACHED)
            or (answer.expected in ("infeasible", "either") and np.isfinite(answer.seconds) and not answer.claimed))


def with_and_without_end(answers):
    answers = list(answers)
    return [a for a in answers if np.isfinite(a.seconds)], [a for a in answers if not np.isfinite(a.seconds)]


def cell(answers):
    """How many of the cases that a peer ended it got right, how many wrong while claiming success, how many it was stopped at or not tried on."""
    ended, others = with_and_without_end(answers)
    counts = {text: sum(a.note.startswith(note) for a in others) for note, text in ((STOPPED, "stopped"), (NOT_TRIED, "not tried"))}
    return f"{sum(map(is_near, ended))}/{len(ended)}" + wrong_text(ended) + "".join(f", {count} {text}" for text, count in counts.items() if count)


def is_right(answer):
    """Of the library, which tells apart what has a solution and what has none."""
    accepted = {"either": ("solved", "infeasible")}.get(answer.expected, (answer.expected,))
    return answer.note in accepted


def wrong_text(answers):
    wrong = sum(answer.wrong for answer in answers)
    return f", **{wrong} wrong**" if wrong else ""


def table(answers):
    ours = "libmlcp auto"
    solvers = [name for name in dict.fromkeys(a.solver for a in answers) if not name.startswith("libmlcp")]
    lines = ["| case | parameter | libmlcp auto: right | largest error, by component | slowest, ms | " + " | ".join(solvers) + " |",
             "|---" * (5 + len(solvers)) + "|"]
    for family in dict.fromkeys(a.family for a in answers):
        group = [a for a in answers if a.family == family]
        own = [a for a in group if a.solver == ours]
        solved = [a.strict for a in own if a.claimed]
        values = [a.value for a in own]
        columns = [family, f"{own[0].parameter} {min(values):g} … {max(values):g}", f"{sum(map(is_right, own))}/{len(own)}" + wrong_text(own),
                   f"{max(solved):.0e}" if solved else own[0].note, f"{1e3 * max(a.seconds for a in own):.1f}"]
        for solver in solvers:
            theirs = [a for a in group if a.solver == solver]
            columns.append(cell(theirs) if theirs else "")
        lines.append("| " + " | ".join(columns) + " |")
    return "\n".join(lines) + "\n"


def totals(answers):
    """A line for each solver over the cases that peers are asked."""
    peers = [name for name in dict.fromkeys(a.solver for a in answers) if not name.startswith("libmlcp")]
    asked = {(a.family, a.value) for a in answers if a.solver in peers}
    lines = ["| solver | right | wrong, success claimed | neither | crashed | stopped | not tried | takes no such problem |", "|---" * 8 + "|"]
    for solver in ["libmlcp auto", "libmlcp simplex", "libmlcp newton", *peers]:
        ended, others = with_and_without_end(a for a in answers if a.solver == solver and (a.family, a.value) in asked)
        right, wrong = sum(map(is_near, ended)), sum(a.wrong for a in ended)
        left = [sum(a.note.startswith(note) for a in others) for note in (STOPPED, NOT_TRIED, DOES_NOT_FIT)]
        counts = [right, wrong, len(ended) - right - wrong, len(others) - sum(left), *left]
        lines.append(f"| {solver} | " + " | ".join(str(count) for count in counts) + " |")
    return "\n".join(lines) + "\n"


def picture(answers, path):
    shown = [family for family in SHOWN if any(a.family == family for a in answers)]
    solvers = [name for name in dict.fromkeys(a.solver for a in answers) if name in ("libmlcp auto", "libmlcp pgs") or "libmlcp" not in name]
    peers = [name for name in solvers if "libmlcp" not in name]
    colours = {"libmlcp auto": "black", "libmlcp pgs": "darkgrey"} | {name: pyplot.get_cmap("tab10")(i % 10) for i, name in enumerate(peers)}
    figure, grid = pyplot.subplots(-(-len(shown) // 4), 4, figsize=(15, 3.1 * -(-len(shown) // 4)), layout="constrained", squeeze=False)
    for axes in grid.flat[len(shown):]:
        axes.set_visible(False)
    for axes, family in zip(grid.flat, shown):
        group = [a for a in answers if a.family == family]
        for solver in solvers:
            points = np.array([(a.value, max(a.norm, SMALLEST)) for a in group if a.solver == solver and np.isfinite(a.norm)]).reshape(-1, 2)
            false = np.array([(a.value, max(a.norm, SMALLEST)) for a in group if a.solver == solver and a.wrong and np.isfinite(a.norm)]).reshape(-1, 2)
            own = solver == "libmlcp auto"
            axes.plot(*points.T, marker="s" if own else "o", markersize=4 if own else 2.5, linewidth=2.6 if own else 1.1, linestyle="--" if solver == "libmlcp pgs" else "-", color=colours[solver],
                      label=solver, zorder=3 if own else 2)
            axes.plot(*false.T, linestyle="", marker="x", markersize=8, color=colours[solver], zorder=4)
        axes.set_yscale("log")
        if group[0].parameter != "p":
            axes.set_xscale("log")
            axes.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        if group[0].parameter == "angle":
            axes.invert_xaxis()  # harder to the right, as in the others
        axes.set_ylim(SMALLEST / 3, 30)
        axes.set_title(family, fontsize=9)
        axes.set_xlabel(group[0].parameter, fontsize=8)
        axes.tick_params(labelsize=7)
        axes.grid(True, alpha=0.25)
    figure.supylabel("largest error by norm; ×: claims success and is wrong", fontsize=9)
    handles = {label: handle for axes in grid.flat for handle, label in zip(*axes.get_legend_handles_labels())}
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=7, fontsize=8)
    figure.savefig(path, dpi=80)


def main():
    parser = argparse.ArgumentParser(prog="tests/hard/run", description=__doc__)
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--cases", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--limit", type=float, default=1, metavar="S", help="of one solve of a peer [1]")
    parser.add_argument("--families", default="", metavar="REGEX", help="only families whose name matches")
    parser.add_argument("--peers", default="", metavar="REGEX", help="only peers whose name matches")
    parser.add_argument("--again", action="store_true", help="table and picture from the peers.csv that there is")
    options = parser.parse_args()
    native.folder = options.build / "lib"
    peers = [peer for peer in all_peers() if peer.available() and re.search(options.peers, peer.name)]
    for peer in all_peers():
        if not peer.available():
            print(f"left out: {peer.name}: not installed")
    if options.again:
        answers = list(read(options.cases / "peers.csv"))
    else:
        answers = run(options.cases, options.families, Library(options.build / "lib" / "libmlcp_bench.so"), peers, options.limit)
        write(options.cases / "peers.csv", answers)
    text = table(answers)
    summary = totals(answers)
    (options.cases / "table.md").write_text(text)
    (options.cases / "totals.md").write_text(summary)
    picture(answers, options.cases / "hard.png")
    print("\n" + text + "\n" + summary + f"\nwritten: library.csv, peers.csv, table.md, totals.md, hard.png in {options.cases}")


if __name__ == "__main__":
    main()
