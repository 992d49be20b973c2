"""Steps a scene, prints what the solver did, and writes its animation.

::

    python -m mlcp.demo gripper                      # gripper.gif
    python -m mlcp.demo wall --size 12 --steps 50 --output wall.gif
    python -m mlcp.demo rope --picture forces.png    # the contact forces of the last step
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from ._core import Result, Scene, scenes
from .errors import Error
from .records import Drawing


class Step(NamedTuple):
    """A step and what there was to see when it began."""

    time: float
    drawing: Drawing
    forces: NDArray[np.float64]
    result: Result


def run(scene: Scene, steps: int, h: float) -> list[Step]:
    """Step a scene, and stop at the first step that is not solved."""
    done: list[Step] = []
    for _ in tqdm(range(steps), disable=None, unit="step", leave=False):
        scene.prepare(h)
        drawing = scene.draw()
        result = scene.finish()
        done.append(Step(scene.time, drawing, result.gamma / h, result))
        if not result.solved:
            break
    return done


def print_table(steps: Sequence[Step]) -> None:
    """A line for about every tenth step."""
    print(f"{'time':>7} {'rows':>6} {'active':>7} {'pivots':>7} {'ms':>8} {'error':>8}  status")
    every = max(1, len(steps) // 10)
    for i, step in enumerate(steps):
        if i % every == 0 or i + 1 == len(steps):
            r = step.result
            print(f"{step.time:7.3f} {len(r.gamma):6} {r.counts.active_rows:7} {r.counts.pivots:7} {1e3 * r.times.total:8.3f} "
                  f"{r.errors.largest:8.0e}  {r.status}")


def animate(steps: Sequence[Step], path: Path, seconds: float, *, forces: bool, dpi: int) -> None:
    """Write a film with a frame for each of the steps, so many seconds apart: GIF, WebP, or what else Matplotlib writes by the name's ending."""
    import matplotlib.pyplot as plt
    from matplotlib.animation import FuncAnimation, PillowWriter
    from matplotlib.artist import Artist

    from . import plot

    strongest = max((float(np.max(np.abs(step.forces), initial=0.0)) for step in steps), default=0.0)
    axes = plot.scene(steps[0].drawing)
    figure = plt.gcf()
    for step in steps[1::max(1, len(steps) // 4)]:
        plot.scene(step.drawing, axes=axes)  # room for what comes later
    extent = max(axes.dataLim.width, axes.dataLim.height)
    limits = axes.get_xlim(), axes.get_ylim()

    def frame(i: int) -> list[Artist]:
        axes.clear()
        if forces:
            plot.contact_forces(steps[i].drawing, steps[i].forces, scale=0.125 * extent / strongest if strongest else None, axes=axes,
                                bar=False)
        else:
            plot.scene(steps[i].drawing, axes=axes)
        axes.set(xlim=limits[0], ylim=limits[1], title=f"{steps[i].time:.2f} s")
        return []

    film = FuncAnimation(figure, frame, frames=len(steps), interval=1e3 * seconds)
    writer = PillowWriter(fps=min(50, max(1, round(1 / seconds)))) if path.suffix.lower() in {".gif", ".webp"} else None
    with tqdm(total=len(steps), disable=None, unit="frame", leave=False) as shown:
        update: Callable[[int, int], object] = lambda i, n: shown.update()
        film.save(path, writer=writer, dpi=dpi, progress_callback=update)
    plt.close(figure)


def picture(step: Step, path: Path, *, forces: bool, dpi: int) -> None:
    """Write the scene at one step."""
    import matplotlib.pyplot as plt

    from . import plot

    axes = plot.contact_forces(step.drawing, step.forces) if forces else plot.scene(step.drawing)
    axes.set_title(f"{step.time:.2f} s, {step.result.counts.active_rows} rows active")
    plt.savefig(path, dpi=dpi)
    plt.close()


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program; returns its exit code, 1 if a step was not solved."""
    parser = argparse.ArgumentParser(prog="python -m mlcp.demo", description="Steps a scene and writes its animation.")
    parser.add_argument("scene", choices=sorted(scenes))
    parser.add_argument("--size", type=int, help="; ".join(f"{name}: {shown.unit} [{shown.size}]" for name, shown in scenes.items()))
    parser.add_argument("--steps", type=int, help="[what shows the scene best]")
    parser.add_argument("--every", type=int, help="a frame each so many steps [what shows the scene best]")
    parser.add_argument("--h", type=float, default=0.01, help="length of a step in s [0.01]")
    parser.add_argument("--seed", type=int, default=1, help="[1]")
    parser.add_argument("--output", type=Path, help="the animation [SCENE.gif]")
    parser.add_argument("--picture", type=Path, help="the last step instead of an animation")
    parser.add_argument("--no-forces", dest="forces", action="store_false", help="without the contact forces")
    parser.add_argument("--dpi", type=int, default=80, help="resolution [80]")
    options = parser.parse_args(arguments)
    shown = scenes[options.scene]
    start = shown.start if options.steps is None else 0
    if options.steps is None:
        options.steps = shown.steps
    if options.every is None:
        options.every = shown.every
    if options.steps < 1 or options.every < 1 or options.dpi < 1 or not options.h > 0:
        parser.error("--steps, --every, --dpi and --h are positive")
    try:
        steps = run(Scene(options.scene, options.size, seed=options.seed), options.steps, options.h)
        print_table(steps)
        path = options.picture or options.output or Path(options.scene + ".gif")
        if options.picture:
            picture(steps[-1], path, forces=options.forces, dpi=options.dpi)
        else:
            animate(steps[start::options.every] or steps[-1:], path, options.every * options.h, forces=options.forces, dpi=options.dpi)
        print(f"wrote {path}")
    except ImportError as error:
        print(f"mlcp.demo: {error}; pip install 'mlcp[plot]'", file=sys.stderr)
        return 2
    except (Error, ValueError, OSError) as error:
        print(f"mlcp.demo: {error}", file=sys.stderr)
        return 2
    return 0 if all(step.result.solved for step in steps) else 1


if __name__ == "__main__":
    sys.exit(main())
