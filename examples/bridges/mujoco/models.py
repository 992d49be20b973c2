"""The scenes: models that the package mujoco-warp ships, set up so that what a contact solver does can be seen, and a tower.

mujoco-warp is MuJoCo's own package, of the same authors and version; its test data hold the humanoid of MuJoCo's repository (mujoco itself has no
models), a two-armed robot with a pot on a table, and a model with every kind of constraint. Only its files are used: install it with --no-deps.
"""
import importlib.util
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np

GRAVITY = 9.81


class Scene(NamedTuple):
    title: str
    model: mujoco.MjModel
    data: mujoco.MjData  # its start
    tracked: str  # the body whose slip is measured
    load: float  # N, what the floor carries along its normal at rest
    seconds: float


def load(path):
    """A model of mujoco-warp's test data by its path there, with MuJoCo's default limits of the solver and flags."""
    package = importlib.util.find_spec("mujoco_warp")
    if package is None:
        raise ModuleNotFoundError("the models come with mujoco-warp: pip install --no-deps mujoco-warp", name="mujoco_warp")
    spec = mujoco.MjSpec.from_file(str(Path(package.origin).parent / "test_data" / path))
    default = mujoco.MjSpec().option  # the files are set up for a GPU: few iterations, explicit damping
    for name in "iterations", "ls_iterations", "disableflags":
        setattr(spec.option, name, getattr(default, name))
    return spec.compile()


def humanoid_on_slope(degrees=5.0):
    """A humanoid stands straight on a slope that rises before it. Springs and dampers hold its joints; friction would hold at 45 degrees."""
    model = load("humanoid/humanoid.xml")
    model.qpos_spring[:] = model.qpos0
    model.jnt_stiffness[1:], model.dof_damping[6:] = 2000.0, 100.0  # all but the root
    slope = np.radians(degrees)
    model.opt.gravity[:] = GRAVITY * np.array([-np.sin(slope), 0, -np.cos(slope)])
    weight = GRAVITY * model.body_subtreemass[0]
    return Scene(f"humanoid on a slope of {degrees:g}°", model, mujoco.MjData(model), "foot_left", weight * np.cos(slope), 5.0)


def tower(masses=(1.0, 1.0, 1.0, 1000.0), side=0.2):
    """Boxes on each other, the heaviest on top. A tenth of their weight pushes sideways: friction holds it twice over and more."""
    spec = mujoco.MjSpec()
    spec.option.gravity = [0.1 * GRAVITY, 0, -GRAVITY]
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[2, 2, 0.1])
    for i, mass in enumerate(masses):
        body = spec.worldbody.add_body(name=f"box {i}", pos=[0, 0, (i + 0.5) * side])
        body.add_freejoint()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[side / 2] * 3, mass=mass)
    model = spec.compile()
    return Scene(f"{masses[-1]:g} kg on three boxes of 1 kg", model, mujoco.MjData(model), f"box {len(masses) - 1}", GRAVITY * sum(masses), 2.0)


def pot():
    """A pot with its lid on the table of a robot with two arms that hold their pose."""
    model = load("aloha_pot/scene.xml")
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    tracked = "partnet_100015/"
    return Scene("pot on the table of a robot", model, data, tracked, GRAVITY * model.body(tracked).subtreemass[0], 2.0)


SCENES = {"humanoid": humanoid_on_slope, "tower": tower, "pot": pot}
