"""The caller's executors and the number of cores."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import Executor, ProcessPoolExecutor, wait
from typing import TYPE_CHECKING

from .errors import ArgumentError

if TYPE_CHECKING:
    from ._core import Work

__all__ = ["cores", "sharing"]


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def sharing(parallel_for: Executor | Callable[[Work], object] | None) -> Callable[[Work], object] | None:
    """What shares a `Work` among threads, from what stands in the setting."""
    if isinstance(parallel_for, ProcessPoolExecutor):
        raise ArgumentError("parallel_for is an executor of processes; islands are shared among threads")
    if isinstance(parallel_for, Executor):
        executor = parallel_for
        return lambda work: _share(executor, work)
    if parallel_for is not None and not callable(parallel_for):
        raise ArgumentError(f"parallel_for = {parallel_for!r} is neither an executor nor can it be called")
    return parallel_for


def _share(executor: Executor, work: Work) -> None:
    """The solving thread works too, so that a pool whose threads are all busy, or wait for this solve, does not hold it up."""
    others = [executor.submit(work) for _ in range(min(work.count, cores()) - 1)]
    work()
    wait([other for other in others if not other.cancel()])
