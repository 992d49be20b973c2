"""Pictures of what the solver did; needs Matplotlib, ``pip install mlcp[plot]``.

Every function draws into the axes that it is given or makes new ones, returns them, and neither shows nor saves anything.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import scipy.sparse
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap, ListedColormap
from matplotlib.patches import Circle, Patch, Polygon
from numpy.typing import NDArray

from ._core import Mask, Problem, Result, Solver
from .errors import ArgumentError
from .records import Drawing, Factor, Role, RowState

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._core import Method, SolverSettings

__all__ = ["active_set", "contact_forces", "islands", "scene", "sparsity", "steps", "work_precision"]

_STATE_COLORS = {RowState.DISABLED: "0.75", RowState.AT_LOWER: "none", RowState.ACTIVE: "tab:blue", RowState.AT_UPPER: "tab:orange"}
_FORCE_COLORS = LinearSegmentedColormap.from_list("force", ["#e0a030", "#c0392b", "#4a0d14"])


def sparsity(problem: Problem, *, enabled: Mask | None = None, axes: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw the patterns of K = [M Jᵀ; J −Σ] and of its factor L in elimination order, an island a color.

    Parameters
    ----------
    problem : Problem
        Is analyzed, not solved. Without cones of friction, whose rows inside are not the problem's own.
    enabled : Mask, optional
        As in `Solver.solve`.
    axes : two Axes, optional
        For K and for L.
    """
    if {"convex", "coulomb"} & set(problem.contacts.model):
        raise ArgumentError('problem has cones of friction: leave them out with problem.set_friction(model="none")')
    solver = Solver()
    solver.analyze(problem, enabled=enabled)
    factor = solver.factor()
    if axes is None:
        axes = plt.subplots(1, 2, figsize=(10, 5), layout="constrained")[1]
    size = len(factor.nodes)
    column = np.repeat(np.arange(size), np.diff(factor.pointers))
    k_row, k_column = _pattern_of_k(problem, factor)
    below = k_row > k_column
    _spots(axes[0], factor, k_row, k_column, f"K: {size} unknowns, {np.count_nonzero(below)} entries below the diagonal")
    diagonal = np.arange(size)
    _spots(axes[1], factor, np.concatenate([diagonal, factor.rows]), np.concatenate([diagonal, column]),
           f"L: {len(factor.rows)} entries below the diagonal")
    return axes


def _pattern_of_k(problem: Problem, factor: Factor) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Entries of K between nodes that are in the factor, both triangles, as positions."""
    position = np.full(problem.velocities + problem.rows, -1)
    position[factor.nodes] = np.arange(len(factor.nodes))
    jacobian = problem.jacobian()
    k = scipy.sparse.block_array([[problem.mass(), jacobian.T], [jacobian, problem.compliance_matrix()]], format="coo")
    row, column = position[k.row], position[k.col]
    inside = (row >= 0) & (column >= 0)
    return row[inside], column[inside]


def _spots(axes: Axes, factor: Factor, row: NDArray[np.int64], column: NDArray[np.int64], title: str) -> None:
    size = len(factor.nodes)
    ends = np.flatnonzero(np.diff(factor.pointers) == 0)  # an island ends with the root of its tree
    island = np.searchsorted(ends, column)
    colors = plt.get_cmap("tab10")(island % 10)
    box = axes.get_window_extent()
    points_per_entry = 72 / axes.figure.dpi * min(box.width, box.height) / max(size, 1)
    axes.scatter(column, row, s=max(points_per_entry, 0.4) ** 2, c=colors, marker="s", linewidths=0)
    axes.set(title=title, xlim=(-0.5, max(size, 1) - 0.5), ylim=(max(size, 1) - 0.5, -0.5), aspect="equal", xlabel="1 island" if len(ends) == 1 else f"{len(ends)} islands")


def active_set(result: Result, start: Mask | None = None, *, axes: Axes | None = None) -> Axes:
    """Draw the state of every row over the pivots of a solve.

    Parameters
    ----------
    result : Result
        Of a solver with ``method="simplex", trace=True``.
    start : Mask, optional
        The mask the solve started from; None: every row at its lower bound, or active where it ends active without a pivot.
    axes : Axes, optional
    """
    trace, end = result.trace, np.array(result.mask.states)
    if len(trace) != result.counts.pivots:
        raise ArgumentError('result has no trace of every step: it is not from a solver with method="simplex", trace=True')
    moved = trace[trace["blocking"] >= 0]
    states = np.empty((len(end), len(moved) + 1), np.uint8)
    states[:] = (end if start is None else np.array(start.states))[:, np.newaxis]
    if start is None:
        states[moved["blocking"]] = RowState.AT_LOWER
    states[end == RowState.DISABLED] = RowState.DISABLED
    for step, (row, to) in enumerate(zip(moved["blocking"], moved["to"]), start=1):
        states[row, step:] = to
    if axes is None:
        axes = plt.subplots(figsize=(7, 5), layout="constrained")[1]
    colors = ListedColormap(list(_STATE_COLORS.values()))
    image = axes.imshow(states, cmap=colors, norm=BoundaryNorm(np.arange(-0.5, 4), 4), aspect="auto", interpolation="nearest",
                        extent=(-0.5, len(moved) + 0.5, max(len(end), 1) - 0.5, -0.5))
    bar = axes.figure.colorbar(image, ax=axes, ticks=list(_STATE_COLORS))
    bar.ax.set_yticklabels([state.name.lower().replace("_", " ") for state in _STATE_COLORS])
    axes.set(xlabel="pivot", ylabel="row", title=f"{result.counts.active_rows} of {len(end)} rows active after {len(moved)} pivots")
    return axes


def islands(result: Result, *, most: int = 40, axes: Axes | None = None) -> Axes:
    """Draw how many rows every island has and in which state they ended, the largest island first.

    Parameters
    ----------
    result : Result
    most : int
        So many islands get a bar of their own; the last bar is the mean of all others.
    axes : Axes, optional
    """
    if axes is None:
        axes = plt.subplots(figsize=(7, 3.5), layout="constrained")[1]
    of_row, states = result.row_islands, np.array(result.mask.states)
    count = result.counts.islands
    by_state = np.array([np.bincount(of_row[(of_row >= 0) & (states == state)], minlength=count) for state in RowState]).astype(float)
    largest_first = np.argsort(-by_state.sum(axis=0), kind="stable")
    names, bars = [str(island) for island in largest_first], by_state[:, largest_first]
    if count > most:
        names = [*names[: most - 1], f"mean of {count - most + 1} others"]
        bars = np.column_stack([bars[:, : most - 1], bars[:, most - 1 :].mean(axis=1)])
    bottom = np.zeros(len(names))
    for state in RowState:
        if bars[state].any():
            axes.bar(names, bars[state], bottom=bottom, color=_STATE_COLORS[state], edgecolor="tab:blue", linewidth=0.6,
                     label=state.name.lower().replace("_", " "))
            bottom += bars[state]
    failed = sum(status != "solved" for status in result.island_status)
    axes.set(xlabel="island", ylabel="rows", title=f"{count} island{'s' * (count != 1)}, {failed} not solved")
    axes.tick_params(axis="x", rotation=90 if len(names) > 12 else 0)
    axes.set_xlim(-0.6, max(len(names), 12) - 0.4)
    if len(axes.patches):
        axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    return axes


def steps(results: Sequence[Result], cold: Sequence[Result], *, axes: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw a sequence of solves, such as the steps of a scene: rows, iterations, time and error.

    Parameters
    ----------
    results : sequence of Result
        Each started from the one before.
    cold : sequence of Result
        The same problems, started from nothing.
    axes : four Axes, optional
    """
    if axes is None:
        axes = plt.subplots(2, 2, figsize=(10, 6), sharex=True, layout="constrained")[1].ravel()
    axes[0].plot([result.counts.enabled_rows for result in results], label="rows")
    axes[0].plot([result.counts.active_rows for result in results], label="active")
    for name, solves in (("warm", results), ("cold", cold)):
        axes[1].plot([result.counts.pivots for result in solves], label=name)
        axes[2].semilogy([1e3 * result.times.total for result in solves], label=name)
        axes[3].semilogy([max(result.errors.largest, np.finfo(float).eps / 4) for result in solves], label=name)
    for axis, title in zip(axes, ("rows", "iterations", "time, ms", "largest relative error")):
        axis.set(title=title, xlabel="step")
        axis.grid(alpha=0.3)
        axis.legend()
    axes[3].set_ylim(1e-17, max(1e-9, axes[3].get_ylim()[1]))
    return axes


def work_precision(problem: Problem, methods: Iterable[Method] = ("simplex",), *, points: int = 12, repeats: int = 3,
                   axes: Axes | None = None, **settings: Unpack[SolverSettings]) -> Axes:
    """Draw the error that each method reaches against the time it takes.

    Every point is a solve of its own, stopped by ``max_iterations``; analysis is left out, since the pattern is known from the
    first solve on. The last point of a curve is the solve that ended by itself.

    Parameters
    ----------
    problem : Problem
    methods : iterable of str
        As in `Solver`.
    points : int
        Limits on the iterations, spaced evenly by their logarithm.
    repeats : int
        Each time is the median of so many.
    axes : Axes, optional
    **settings
        Other keywords of `Solver`.
    """
    if axes is None:
        axes = plt.subplots(figsize=(6, 4.5), layout="constrained")[1]
    for method in methods:
        solver = Solver(**settings)
        solver.configure(method=method, warm_start=False)  # every point begins afresh
        whole = solver.solve(problem)
        limits = np.unique(np.geomspace(1, max(whole.counts.pivots, 1), points).astype(int))
        curve = [_time_and_error(solver, problem, int(limit), repeats) for limit in (*limits, settings.get("max_iterations", 0))]
        seconds, error = np.array(curve).T
        axes.loglog(1e3 * seconds, np.maximum(error, np.finfo(float).eps / 4), marker="o", markersize=4, label=method)
    axes.set(xlabel="time, ms", ylabel="largest relative error", title=f"{problem.velocities} velocities, {problem.rows} rows")
    axes.grid(alpha=0.3)
    axes.legend()
    return axes


def _time_and_error(solver: Solver, problem: Problem, limit: int, repeats: int) -> tuple[float, float]:
    solver.configure(max_iterations=limit)
    results = [solver.solve(problem) for _ in range(repeats)]
    return float(np.median([result.times.total - result.times.analyze for result in results])), results[-1].errors.largest


def scene(drawing: Drawing, *, axes: Axes | None = None) -> Axes:
    """Draw a scene in parallel projection from where its `Drawing.eye` lies, what is nearer over what is farther.

    Parameters
    ----------
    drawing : Drawing
        Of `Scene.draw`.
    axes : Axes, optional
    """
    if axes is None:
        axes = _axes_for(drawing)
    view = _View.of(drawing)
    patches: list[Patch] = []
    colors: list[NDArray[np.float64]] = []
    for _, patch, color in sorted([*_balls(drawing, view), *_faces(drawing, view)], key=lambda shape: shape[0]):
        patches.append(patch)
        colors.append(color)
    axes.add_collection(PatchCollection(patches, facecolor=colors, edgecolor=[0.86 * color for color in colors], linewidth=0.4))
    axes.add_collection(LineCollection([view.flat(path) for path in drawing.paths], colors="0.25", linewidths=1.2))
    axes.set(aspect="equal")
    if view.upright:
        axes.set(xlabel="x, m", ylabel="z, m")
    else:
        axes.set_axis_off()
    axes.autoscale_view()
    return axes


class _View(NamedTuple):
    """A parallel projection: to the right, up, and towards the eye."""

    right: NDArray[np.float64]
    up: NDArray[np.float64]
    eye: NDArray[np.float64]

    @classmethod
    def of(cls, drawing: Drawing) -> _View:
        eye = drawing.eye / np.linalg.norm(drawing.eye)
        right = np.cross([0.0, 0.0, 1.0], eye)
        right /= np.linalg.norm(right)
        return cls(right, np.cross(eye, right), eye)

    @property
    def upright(self) -> bool:
        """Whether the picture shows x and z."""
        return bool(self.eye[1] == -1)

    def flat(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Where points (..., 3) are in the picture, (..., 2)."""
        return np.stack([points @ self.right, points @ self.up], axis=-1)


_ROLE_COLORS = np.array([[0.78, 0.84, 0.90], [0.93, 0.66, 0.25], [0.66, 0.68, 0.70], [0.36, 0.55, 0.74], [0.90, 0.90, 0.88]])
_LIGHT = np.array([-0.35, -0.55, 0.76])
_BOX_FACES = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
_Shape = tuple[float, Patch, NDArray[np.float64]]


def _balls(drawing: Drawing, view: _View) -> Iterable[_Shape]:
    """Each ball, and a highlight on it."""
    glint = view.flat(_LIGHT)
    for (*centre, radius), role in zip(drawing.spheres, drawing.sphere_roles, strict=True):
        color = _ROLE_COLORS[role]
        at, depth = view.flat(np.array(centre)), float(np.array(centre) @ view.eye)
        yield depth, Circle(tuple(at), radius), 0.92 * color
        yield depth, Circle(tuple(at + 0.28 * radius * glint), 0.55 * radius), 0.4 + 0.6 * color


def _faces(drawing: Drawing, view: _View) -> Iterable[_Shape]:
    """The faces that look at the eye, brighter the more they look at the light."""
    sides = [(corners[face], Role.BODY) for corners in drawing.boxes for face in _BOX_FACES]
    for corners, role in [*sides, *zip(drawing.faces, drawing.face_roles, strict=True)]:
        normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
        size = np.linalg.norm(normal)
        if not normal @ view.eye > 1e-9 * size:
            continue
        brightness = 0.72 + 0.28 * max(0.0, float(normal @ _LIGHT / size))
        depth = -math.inf if role == Role.GROUND else float(corners.mean(axis=0) @ view.eye)
        yield depth, Polygon(view.flat(corners)), brightness * _ROLE_COLORS[role]


def _axes_for(drawing: Drawing) -> Axes:
    """New axes about as high and wide as the scene."""
    seen = np.concatenate([drawing.spheres[:, :3], drawing.boxes.reshape(-1, 3), *drawing.paths, *drawing.faces, drawing.points])
    width, height = np.ptp(_View.of(drawing).flat(seen), axis=0) if len(seen) else (1.0, 1.0)
    largest = max(width, height, np.finfo(float).tiny)
    size = np.clip(7 * np.array([width, height]) / largest, 2.5, 7)
    return plt.subplots(figsize=(size[0] + 1.2, size[1] + 0.6), layout="constrained")[1]


def contact_forces(drawing: Drawing, forces: NDArray[np.float64], *, scale: float | None = None, bar: bool = True,
                   axes: Axes | None = None) -> Axes:
    """Draw the force of every row over a scene: a line along it, as long and as thick as it is strong.

    Parameters
    ----------
    drawing : Drawing
        At the positions of the beginning of the step.
    forces : (m,) array
        N, ``result.gamma / h``.
    scale : float, optional
        Length of 1 N, m; None: the largest force is an eighth as long as the picture.
    bar : bool
        Whether to draw the scale of the colors.
    axes : Axes, optional
    """
    axes = scene(drawing, axes=axes)
    forces = np.asarray(forces, dtype=np.float64)
    if forces.shape != (len(drawing.points),):
        raise ArgumentError(f"forces has shape {forces.shape}, not ({len(drawing.points)},), one for each row that was drawn")
    strongest = float(np.max(np.abs(forces), initial=0.0))
    if strongest == 0:
        return axes
    if scale is None:
        scale = 0.125 * max(axes.dataLim.width, axes.dataLim.height) / strongest
    acts = np.abs(forces) > 1e-6 * strongest
    view = _View.of(drawing)
    middle = view.flat(drawing.points[acts])
    half = 0.5 * scale * forces[acts, np.newaxis] * view.flat(drawing.directions[acts])
    strength = np.abs(forces[acts]) / strongest
    lines = LineCollection(list(np.stack([middle - half, middle + half], axis=1)), linewidths=0.5 + 2.5 * strength, cmap=_FORCE_COLORS,
                           capstyle="round")
    lines.set_array(np.abs(forces[acts]))
    lines.set_clim(0, strongest)
    axes.add_collection(lines)
    if bar:
        axes.figure.colorbar(lines, ax=axes, label="force, N")
    return axes
