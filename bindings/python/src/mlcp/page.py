"""Writes what the solver does with a problem, or with the steps of a recorded scene, as one page for a browser.

::

    python -m mlcp.page PROBLEM                       # a folder of Matrix Market files or a snapshot: PROBLEM.html
    python -m mlcp.page recorded/pile                 # a folder of snapshots: the steps of a scene, and the hardest of them
    python -m mlcp.page PROBLEM --friction coulomb --methods newton simplex --output page.html

The page needs no network and no script, and follows the light or dark scheme of the browser.
"""

from __future__ import annotations

import argparse
import html
import io
import re
import sys
from collections.abc import Callable, Sequence
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING, Any, NamedTuple

from ._core import Problem, Result, Solver, load, version
from .errors import Error

if TYPE_CHECKING:
    from ._core import Friction, Method

__all__ = ["page"]

METHODS: tuple[Method, ...] = ("auto", "newton", "simplex", "pgs")
_INK = "#010203"  # stands for the color of the text until the page is written


_STEPS = Template("""<section id="steps">
<h2>Steps</h2>
<p>Every step was solved twice: <em>warm</em> from the contacts of the step before, found again by their keys, and <em>cold</em> from nothing. All that
follows is about step $hardest, on which a cold solve works most.</p>
$figure</section>
""")


class Steps(NamedTuple):
    """The problems of a recorded scene and two solves of each."""

    problems: list[Problem]
    warm: list[Result]
    cold: list[Result]

    @classmethod
    def of(cls, problems: list[Problem], max_seconds: float) -> Steps:
        solver = Solver(max_seconds=max_seconds)
        warm = [solver.solve(problem) for problem in problems]
        solver.configure(warm_start=False)
        return cls(problems, warm, [solver.solve(problem) for problem in problems])

    @property
    def hardest(self) -> int:
        return max(range(len(self.problems)), key=lambda step: self.cold[step].counts.work)


def page(problems: Sequence[Problem], title: str, *, methods: Sequence[Method] = METHODS, max_seconds: float = 2.0) -> str:
    """The page about one problem, or about the steps of a scene and the hardest of them.

    Parameters
    ----------
    problems : sequence of Problem
        One, or the steps in order.
    title : str
    methods : sequence of str
        As in `Solver`.
    max_seconds : float
        Limit of every single solve, s.
    """
    from . import plot

    problem, parts = problems[0], {"steps": "", "steps_link": ""}
    if len(problems) > 1:
        steps = Steps.of(list(problems), max_seconds)
        problem = steps.problems[steps.hardest]
        parts["steps_link"] = '<a href="#steps">Steps</a>\n'
        parts["steps"] = _STEPS.substitute(
            hardest=steps.hardest, figure=_svg(lambda: plot.steps(steps.warm, steps.cold), "rows, iterations, time and error of each step"))
    results = {method: Solver(method=method, max_seconds=max_seconds).solve(problem) for method in methods}
    best = min(results.values(), key=lambda result: (not result.solved, result.times.total))
    frictionless = problem.copy()
    if problem.contact_count:
        frictionless.set_friction(model="none")
    pivots = Solver(method="simplex", trace=True, max_seconds=max_seconds).solve(frictionless)

    def sparsity() -> None:
        for axes in plot.sparsity(frictionless):
            for spots in axes.collections:
                spots.set_rasterized(True)  # a picture rather than a shape for each entry

    parts["methods"] = _svg(lambda: plot.work_precision(problem, methods, points=10, max_seconds=max_seconds), "error against time by method")
    parts["methods"] += _methods_table(results)
    parts["active"] = f"<p>The simplex ended with {pivots.status}: there is no trace of every pivot.</p>\n"
    if len(pivots.trace) == pivots.counts.pivots:
        parts["active"] = _svg(lambda: plot.active_set(pivots), "state of every row over the pivots")
    parts["islands"] = _svg(lambda: plot.islands(best), "rows of each island by state")
    parts["sparsity"] = _svg(sparsity, "entries of K and of L")
    template = Template(files(__package__).joinpath("page.html").read_text(encoding="utf-8"))
    return template.substitute(parts, title=html.escape(title), tiles=_tiles(problem, best), version=version,
                               without=" Friction is left out here." if problem.contact_count else "")


def _svg(draw: Callable[[], object], label: str) -> str:
    """The figure that `draw` makes as SVG to stand in the page: transparent, text as text, ink in the color of the text around it."""
    import matplotlib.pyplot as plt

    ink: dict[Any, Any] = dict.fromkeys(["text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color", "grid.color"], _INK)
    style = {"svg.fonttype": "none", "svg.hashsalt": label, "figure.facecolor": "none", "axes.facecolor": "none", "legend.framealpha": 0}
    text = io.StringIO()
    with plt.rc_context(style | ink):
        draw()
        plt.savefig(text, format="svg", dpi=150, bbox_inches="tight", metadata=dict.fromkeys(["Date", "Creator", "Format", "Type"]))
    plt.close()
    svg = text.getvalue()[text.getvalue().index("<svg") :]
    used = set(re.findall(r"#([\w.-]+)", svg))  # the names of groups are the same in every figure
    svg = re.sub(r' id="([^"]*)"', lambda found: found[0] if found[1] in used else "", svg)
    svg = re.sub(r"font: [^;\"]*?([\d.]+)px [^;\"]*", r"font-size: \1px", svg)  # the page's own font
    svg = svg.replace(_INK, "currentColor").replace("<svg ", f'<svg role="img" aria-label="{html.escape(label)}" ', 1)
    return f"<figure>\n{svg}</figure>\n"


def _methods_table(results: dict[Method, Result]) -> str:
    head = "<tr><th>method</th><th>ended</th><th>iterations</th><th>row toggles</th><th>factorizations</th><th>time, ms</th><th>largest error</th></tr>"
    lines = [f"<tr><td>{method}</td><td>{result.status}</td><td>{result.counts.pivots}</td><td>{result.counts.toggles}</td>"
             f"<td>{result.counts.factorizations}</td><td>{1e3 * result.times.total:.3g}</td><td>{result.errors.largest:.0e}</td></tr>"
             for method, result in results.items()]
    return f'<div class="wide"><table><thead>{head}</thead><tbody>{"".join(lines)}</tbody></table></div>\n'


def _tiles(problem: Problem, best: Result) -> str:
    numbers = {"velocities": problem.velocities, "rows": problem.rows, "contacts with friction": problem.contact_count, "islands": best.counts.islands,
               "active rows": best.counts.active_rows, "redundant rows": best.counts.redundant_rows,
               "entries of L": best.counts.factor_entries, f"ms, {best.method}": f"{1e3 * best.times.total:.3g}", "largest error": f"{best.errors.largest:.0e}"}
    return "\n".join(f"<div><b>{value}</b><span>{name}</span></div>" for name, value in numbers.items())


def _read(path: Path, friction: Friction | None) -> list[Problem]:
    if not path.is_dir():
        return [load(path).problem]
    snapshots = sorted(path.glob("*.mlcp"), key=lambda file: [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", file.name)])
    return [load(file).problem for file in snapshots] or [Problem.from_folder(path, friction=friction)]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program; returns its exit code."""
    parser = argparse.ArgumentParser(prog="python -m mlcp.page", description="Writes a page about a problem or a recorded scene.")
    parser.add_argument("problem", type=Path, help="a folder of Matrix Market files, a snapshot, or a folder of snapshots, the steps of a scene")
    parser.add_argument("--output", type=Path, help="[the name of the problem, .html]")
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=list(METHODS), help="[all]")
    parser.add_argument("--friction", choices=["none", "convex", "coulomb", "box", "findex"], help="of a folder of Matrix Market files [none]")
    parser.add_argument("--max-seconds", type=float, default=2.0, help="of one solve [2]")
    options = parser.parse_args(arguments)
    try:
        problems = _read(options.problem, options.friction)
        path = options.output or Path(options.problem.resolve().name).with_suffix(".html")
        text = page(problems, options.problem.resolve().name, methods=options.methods, max_seconds=options.max_seconds)
        path.write_text(text, encoding="utf-8")
        print(f"wrote {path}, {len(text) / 1e3:.0f} kB")
    except ImportError as error:
        print(f"mlcp.page: {error}; pip install 'mlcp[plot]'", file=sys.stderr)
        return 2
    except (Error, ValueError, OSError) as error:
        print(f"mlcp.page: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
