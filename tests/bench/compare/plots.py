"""Work-precision plots: error against time, one curve a solver."""
import re

import matplotlib
import numpy as np

from .tables import by_problem, is_ours

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  needs the backend first

SMALLEST = 1e-17
OURS = ("black", "dimgrey", "darkgrey", "silver")


def front(rows):
    """Points of a solver's settings and forms that no other point of it beats in both time and error, by time."""
    points, best = [], np.inf
    for time, error in sorted((row.cold, max(row.normwise, SMALLEST)) for row in rows if np.isfinite(row.cold) and np.isfinite(row.normwise)):
        if error < best:
            points.append((time, error))
            best = error
    return np.array(points).reshape(-1, 2)


def _panel(axes, name, rows, colours):
    for solver in dict.fromkeys(row.solver for row in rows):
        of_solver = [row for row in rows if row.solver == solver]
        points = front(of_solver)
        if len(points):
            marker, width, order = ("s", 2.2, 3) if is_ours(of_solver[0]) else ("o", 1.0, 2)
            axes.loglog(points[:, 0], points[:, 1], marker=marker, markersize=3.5, linewidth=width, zorder=order, label=solver,
                        color=colours[solver])
    axes.axhline(1e-9, color="grey", linewidth=0.6, linestyle=":")
    axes.set_title(f"{name}: {rows[0].n} velocities, {rows[0].m} rows", fontsize=9)
    axes.set_ylim(SMALLEST / 3, 30)
    axes.tick_params(labelsize=7)
    axes.grid(True, alpha=0.25)


def _colours(rows):
    ours = dict.fromkeys(row.solver for row in rows if is_ours(row))
    peers = dict.fromkeys(row.solver for row in rows if not is_ours(row))
    return dict(zip(ours, OURS)) | {name: pyplot.get_cmap("tab20")(2 * i % 20 + i // 10) for i, name in enumerate(peers)}


def _save(figure, path):
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)


def write(folder, rows, chosen):
    """One file a problem, and work_precision.svg and .png with the problems in `chosen` side by side."""
    groups, colours = by_problem(rows), _colours(rows)
    for name, group in groups.items():
        figure, axes = pyplot.subplots(figsize=(6, 4.2), layout="constrained")
        _panel(axes, name, group, colours)
        axes.set_xlabel("seconds, cold")
        axes.set_ylabel("largest error, by norm")
        axes.legend(fontsize=7)
        _save(figure, folder / (re.sub(r"\W+", "_", name) + ".svg"))
    names = [name for name in chosen if name in groups]
    if not names:
        return
    columns = min(3, len(names))
    figure, grid = pyplot.subplots(-(-len(names) // columns), columns, figsize=(4.2 * columns, 3.2 * -(-len(names) // columns)),
                                   squeeze=False, layout="constrained")
    for axes in grid.flat[len(names):]:
        axes.set_visible(False)
    for axes, name in zip(grid.flat, names):
        _panel(axes, name, groups[name], colours)
    figure.supxlabel("seconds, cold", fontsize=9)
    figure.supylabel("largest error, by norm", fontsize=9)
    handles = {label: handle for axes in grid.flat for handle, label in zip(*axes.get_legend_handles_labels())}
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=5, fontsize=8)
    figure.savefig(folder / "work_precision.png", dpi=90)
    _save(figure, folder / "work_precision.svg")
