"""MuJoCo's Newton on its own soft version of its models, with friction, against our exact frictionless solve of the same state."""
import importlib.util
import time
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from .problem import Problem

STABILISATION = 0.2  # of overlaps, as in the recorded problems
HUMANOIDS_IN_A_ROW = 5


def installed():
    return importlib.util.find_spec("mujoco") is not None


def _shipped_humanoid():
    """The model file that the package mujoco-mjx ships."""
    spec = importlib.util.find_spec("mujoco")
    path = spec and Path(spec.origin).parent / "mjx" / "test_data" / "humanoid" / "humanoid.xml"
    return path if path and path.exists() else None


def _crowd(mujoco, path, count):
    """`count` humanoids of one file on one floor, apart from each other."""
    crowd = mujoco.MjSpec.from_file(str(path))
    first = crowd.body("torso").pos
    for i in range(1, count):
        other = mujoco.MjSpec.from_file(str(path))
        place = crowd.worldbody.add_frame(pos=[i % HUMANOIDS_IN_A_ROW * 1.5 - first[0], i // HUMANOIDS_IN_A_ROW * 1.5 - first[1], 0])
        crowd.attach(other, prefix=f"h{i}_", frame=place)
    return crowd.compile()


def models(folder):
    """Name -> (model, steps to simulate first, why it is left out). folder: of a source tree of MuJoCo, or None."""
    import mujoco
    humanoid = _shipped_humanoid()
    if humanoid is None:
        yield "humanoid, 22 humanoids", None, 0, "the package mujoco-mjx with the model file is not installed"
    else:
        yield "humanoid", mujoco.MjModel.from_xml_path(str(humanoid)), 250, ""
        yield "22 humanoids", _crowd(mujoco, humanoid, 22), 800, ""
    for name, file, steps in (("hammock", "model/hammock/hammock.xml", 500),
                              ("stacked boxes", "test/engine/testdata/collision_convex/stacked_boxes.xml", 300)):
        path = folder and Path(folder) / file
        if path and path.exists():
            yield name, mujoco.MjModel.from_xml_path(str(path)), steps, ""
        else:
            yield name, None, 0, f"no package ships {file}; give a source tree of MuJoCo with --mujoco"


def _settle(mujoco, model, steps):
    data = mujoco.MjData(model)
    for _ in range(steps):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return data


def newton_seconds(model, steps, turns):
    """Seconds of one call of its constraint solver, cold; its rows and iterations."""
    import mujoco
    model.opt.solver = mujoco.mjtSolver.mjSOL_NEWTON
    data = _settle(mujoco, model, steps)
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_WARMSTART)
    seconds = []
    for _ in range(turns):
        start = time.perf_counter()
        mujoco.mj_fwdConstraint(model, data)
        seconds.append(time.perf_counter() - start)
    model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_WARMSTART)
    return float(np.median(seconds)), data.nefc, int(np.sum(data.solver_niter))


def exact_problem(library, name, model, steps):
    """The frictionless rigid problem of the same state: normal rows of contacts, joint limits and equalities, as the paper's (2.5)."""
    import mujoco
    data = _settle(mujoco, model, steps)
    condim = model.geom_condim.copy(), model.pair_dim.copy()
    model.geom_condim[:], model.pair_dim[:] = 1, 1
    mujoco.mj_forward(model, data)
    h, n, m = model.opt.timestep, model.nv, data.nefc
    kinds = data.efc_type[:m]
    K = mujoco.mjtConstraint
    kept = np.isin(kinds, [K.mjCNSTR_EQUALITY, K.mjCNSTR_LIMIT_JOINT, K.mjCNSTR_LIMIT_TENDON, K.mjCNSTR_CONTACT_FRICTIONLESS])
    if mujoco.mj_isSparse(model):
        J = sp.csr_matrix((data.efc_J[:data.efc_J_rowadr[m - 1] + data.efc_J_rownnz[m - 1]], data.efc_J_colind[:data.efc_J_rowadr[m - 1] + data.efc_J_rownnz[m - 1]],
                           np.append(data.efc_J_rowadr[:m], data.efc_J_rowadr[m - 1] + data.efc_J_rownnz[m - 1])), shape=(m, n))
    else:
        J = sp.csr_matrix(data.efc_J[:m * n].reshape(m, n))
    M = np.zeros((n, n))
    mujoco.mj_fullM(model, data, M)
    model.geom_condim[:], model.pair_dim[:] = condim
    M = sp.csc_matrix(M)
    gap = data.efc_pos[:m] - data.efc_margin[:m]
    bilateral = kinds == K.mjCNSTR_EQUALITY
    r = np.where(bilateral | (gap < 0), -STABILISATION / h * gap, -gap / h)
    lo = np.where(bilateral, -np.inf, 0.0)
    k = M @ (data.qvel + h * data.qacc_smooth)
    return Problem(f"MuJoCo {name}", "mujoco", library, library.assemble(M, J[kept], k, r[kept], lo[kept], np.full(np.count_nonzero(kept), np.inf)))
