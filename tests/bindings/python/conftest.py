"""Small problems with known answers, and an oracle that recomputes the conditions from the caller's own matrices."""

import os
from pathlib import Path

import numpy as np
import pytest

import mlcp

matplotlib_backend = os.environ.setdefault("MPLBACKEND", "Agg")

repository = Path(__file__).resolve().parents[3]


def ball_and_joint():
    """A ball (mass 2) that falls at 3 m/s on a table, key 5; another one (mass 4) that a joint holds at 0.5 m/s, key 6."""
    problem = mlcp.Problem()
    problem.add_bodies([[[2.0]], [[4.0]]])
    problem.set_momentum([-6, 8])
    problem.add_row([0], [1], key=5)
    problem.add_row([1], [1], r=0.5, lo=-np.inf, key=6)
    return problem


def squeezed():
    """A ball between two walls that move at each other: rows 0 and 1 contradict each other; ball 1 is free to fall."""
    problem = mlcp.Problem()
    problem.add_bodies(np.ones((2, 1, 1)))
    problem.set_momentum([0.0, -1.0])
    problem.add_row([0], [1], r=1)
    problem.add_row([0], [-1], r=1)
    problem.add_row([1], [1])
    return problem


def pile(contacts=60, seed=1):
    """The problem of the first step of a pile of spheres."""
    scene = mlcp.Scene("pile", max(1, contacts // 3), seed=seed)
    scene.prepare()
    return scene.problem


def natural_residual(problem, result):
    """Largest |Mv − Jᵀγ − k| and |median(w, γ − lo, γ − hi)|, in dense arithmetic, w recomputed."""
    mass, jacobian, sigma = (m.toarray() for m in (problem.mass(), problem.jacobian(), problem.compliance_matrix()))
    v, gamma = result.v, result.gamma
    momentum = mass @ v - jacobian.T @ gamma - problem.momentum
    w = jacobian @ v + sigma @ gamma - problem.r
    rows = np.median([w, gamma - problem.lo, gamma - problem.hi], axis=0)
    return np.max(np.abs(momentum), initial=0), np.max(np.abs(rows), initial=0)


@pytest.fixture
def ball():
    return ball_and_joint()


@pytest.fixture
def shared_problems():
    folder = Path(os.environ.get("MLCP_PROBLEMS", repository.parent / "shared" / "problems"))
    if not (folder / "INDEX.tsv").exists():
        pytest.skip(f"the shared problems are not at {folder}")
    return folder
