#!/usr/bin/env python3
"""Rigid contact by mlcp beside MuJoCo's soft one, on the same scenes from the same start: a table and a figure.

    compare.py [--output rigid_and_soft.png] [--scenes humanoid tower pot]
"""
import argparse
import copy
import time
from typing import NamedTuple

import models
import mujoco
import numpy as np
from rigid_contact import RigidContact


class Run(NamedTuple):
    """What happened in each step of a scene."""

    time: np.ndarray  # s, at the end of the step
    depth: np.ndarray  # m, of the deepest overlap at its beginning
    slip: np.ndarray  # m, way of the tracked body along the floor since the start
    load: np.ndarray  # N, what the world carries along the floor's normal
    solve: np.ndarray  # s, of the contact solver
    step: np.ndarray  # s, of the whole step


def soft(model):
    """MuJoCo's step, its stages called one by one to time the solver among them.

    Returns the model that it steps with and the step: a function of the data that returns the solver's seconds.
    """
    def step(data):
        mujoco.mj_step1(model, data)
        mujoco.mj_fwdActuation(model, data)
        mujoco.mj_fwdAcceleration(model, data)
        begin = time.perf_counter()
        mujoco.mj_fwdConstraint(model, data)
        seconds = time.perf_counter() - begin
        mujoco.mj_sensorAcc(model, data)
        mujoco.mj_Euler(model, data)
        return seconds
    return model, step


def soft_without_slip(model):
    """MuJoCo's cure for creep: elliptic cones, friction ten times as stiff as contacts, and its post-processing of slip."""
    model = copy.copy(model)
    model.opt.cone, model.opt.impratio, model.opt.noslip_iterations = mujoco.mjtCone.mjCONE_ELLIPTIC, 10, 10
    return soft(model)


def soft_but_stiff(model):
    """Contacts as stiff as MuJoCo allows without a shorter step, on elliptic cones."""
    model = copy.copy(model)
    model.opt.cone, model.opt.impratio = mujoco.mjtCone.mjCONE_ELLIPTIC, 10
    model.geom_solref[:] = 2 * model.opt.timestep, 1  # shorter time constants than two steps are not taken
    model.geom_solimp[:, :2] = 0.99, 0.999
    return soft(model)


def rigid(model):
    contact = RigidContact(model)
    return contact.model, lambda data: contact.step(data).times.total


SMALLEST = 1e-7  # mm, that the figure shows
STEPPERS = {"MuJoCo": soft, "MuJoCo, no slip": soft_without_slip, "MuJoCo, stiff": soft_but_stiff, "mlcp": rigid}


def load(model, data):
    """N: contact forces on the world along z."""
    total, force = 0.0, np.zeros(6)
    for i, contact in enumerate(data.contact):
        on_first, on_second = (model.body_weldid[model.geom_bodyid[g]] == 0 for g in contact.geom)
        if on_first == on_second or contact.efc_address < 0:
            continue
        mujoco.mj_contactForce(model, data, i, force)  # on the second geom, in the contact's frame
        total += (1 if on_first else -1) * force[:3] @ contact.frame.reshape(3, 3)[:, 2]
    return total


def run(scene, make_step):
    model, step = make_step(scene.model)
    data, body = copy.copy(scene.data), model.body(scene.tracked).id
    mujoco.mj_kinematics(model, data)
    start, rows = data.xpos[body, :2].copy(), []
    for _ in range(round(scene.seconds / model.opt.timestep)):
        begin = time.perf_counter()
        solve = step(data)
        whole = time.perf_counter() - begin
        depth = max(0.0, -np.min(data.contact.dist, initial=0.0))
        rows.append((data.time, depth, np.linalg.norm(data.xpos[body, :2] - start), load(model, data), solve, whole))
    return Run(*np.array(rows).T)


def measures(scene, result):
    """Slip at the end; of the second half of a run, when a scene at rest is at rest: overlap, error of the load, median times."""
    late = Run(*(values[len(result.time) // 2:] for values in result))
    return {"overlap, mm": 1e3 * late.depth.max(), "slip, mm": 1e3 * result.slip[-1],
            "load, % off": 1e2 * np.abs(late.load / scene.load - 1).max(),
            "solver, ms": 1e3 * np.median(late.solve), "step, ms": 1e3 * np.median(late.step)}


def table(results):
    lines = []
    for scene, runs in results:
        for name, result in runs.items():
            found = measures(scene, result)
            lines.append(" | ".join(["", scene.title, name, *map(short, found.values()), ""]).strip())
    return "\n".join([f"| scene | solver | {' | '.join(found)} |", "|---" * (2 + len(found)) + "|", *lines])


def short(value):
    """Two digits."""
    return f"{value:.0e}" if value < 1e-3 else f"{value:.0f}" if value >= 10 else f"{value:.2g}"


def draw(results, path):
    import matplotlib.pyplot as plt
    colors = dict(zip(STEPPERS, ("tab:orange", "tab:brown", "tab:green", "tab:blue")))
    figure, axes = plt.subplots(len(results), 4, figsize=(14, 2.7 * len(results) + 0.5), layout="constrained", squeeze=False)
    for title, axis in zip(("deepest overlap, mm", "slip since the start, mm", "load on the floor / weight", "contact solver, ms a step"), axes[0]):
        axis.set_title(title)
    for row, (scene, runs) in zip(axes, results):
        for name, result in runs.items():
            style = {"color": colors[name], "label": name, "linewidth": 1.6 if name == "mlcp" else 0.9, "zorder": 3 if name == "mlcp" else 2}
            row[0].semilogy(result.time, np.maximum(1e3 * result.depth, SMALLEST), **style)
            row[1].semilogy(result.time, np.maximum(1e3 * result.slip, SMALLEST), **style)
            row[2].plot(result.time, result.load / scene.load, **style)
            bar = row[3].barh(name, 1e3 * np.median(result.solve), color=colors[name])
            row[3].bar_label(bar, fmt="%.2g", padding=3)
        row[0].set_ylabel(scene.title)
        row[2].set_ylim(0, 2)
        row[3].set(xscale="log", xlim=(1e-3, 2))
        row[3].invert_yaxis()
        for axis in row[:3]:
            axis.grid(alpha=0.3)
            axis.set_xlabel("time, s")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=len(STEPPERS), frameon=False)
    figure.savefig(path, dpi=75)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--output", default="rigid_and_soft.png", help="the figure; '' for none")
    parser.add_argument("--scenes", nargs="+", default=list(models.SCENES), choices=models.SCENES)
    options = parser.parse_args()
    results = []
    for name in options.scenes:
        scene = models.SCENES[name]()
        results.append((scene, {stepper: run(scene, make) for stepper, make in STEPPERS.items()}))
    print(table(results))
    if options.output:
        draw(results, options.output)


if __name__ == "__main__":
    main()
