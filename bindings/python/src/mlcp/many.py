"""Many independent problems at a time."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from typing import TYPE_CHECKING

from tqdm import tqdm

from ._core import Mask, Problem, Result, Solver
from .threads import cores

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._core import SolverSettings

__all__ = ["solve_many"]


def solve_many(problems: Iterable[Problem], starts: Sequence[Mask | None] | None = None, *,
               enabled: Sequence[Mask | None] | None = None, workers: int | None = None, bar: bool | None = None,
               **settings: Unpack[SolverSettings]) -> list[Result]:
    """Solve independent problems on the cores, in threads: solves release the GIL.

    Parameters
    ----------
    problems : iterable of Problem
        The same one may come more than once.
    starts, enabled : sequence of Mask or None, optional
        One for each problem, as in `Solver.solve`.
    workers : int, optional
        Threads; as many as this process may use cores.
    bar : bool, optional
        Whether to show a progress bar on stderr. None: when a person watches, that is when stderr is a terminal.
    **settings
        Keywords of `Solver`. A callback ``progress`` is called from several threads.

    Returns
    -------
    list of Result
        In the order of the problems. They do not depend on the number of workers: every problem gets a solver of its own.

    Raises
    ------
    Exception
        The first one of a solve; the others that are running are interrupted. Ctrl-C does the same.
    """
    batch = list(problems)
    for name, masks in (("starts", starts), ("enabled", enabled)):
        if masks is not None and len(masks) != len(batch):
            raise ValueError(f"{name} has {len(masks)} entries for {len(batch)} problems")
    if workers is None:
        workers = cores()
    if workers < 1:
        raise ValueError(f"workers = {workers} is not positive")
    results: list[Result | None] = [None] * len(batch)
    running: set[Solver] = set()
    left = iter(range(len(batch)))  # threads draw from it one at a time, which the GIL makes safe
    stopped = False

    def work() -> None:
        for i in left:
            solver = Solver(**settings)
            running.add(solver)
            if stopped:
                return
            results[i] = solver.solve(batch[i], starts[i] if starts else None, enabled=enabled[i] if enabled else None)
            running.discard(solver)
            with shown.get_lock():
                shown.update()

    with tqdm(total=len(batch), disable=None if bar is None else not bar, unit="solve") as shown, \
            ThreadPoolExecutor(min(workers, max(1, len(batch)))) as pool:
        futures = [pool.submit(work) for _ in range(min(workers, len(batch)))]
        try:
            for future in wait(futures, return_when=FIRST_EXCEPTION).done:
                future.result()
        except BaseException:
            stopped = True
            for solver in list(running):
                solver.interrupt()
            raise
    return [result for result in results if result is not None]
