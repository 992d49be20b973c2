"""MuJoCo's Newton on its own soft version of its models, with friction, against our exact frictionless solve of the same state."""
import importlib.util
import time

import numpy as np
import scipy.sparse as sp

from . import soft_models
from .problem import Problem

STABILISATION = 0.2  # of overlaps, as in the recorded problems


def missing():
    """Why there is nothing to compare with, or "" where there is."""
    if importlib.util.find_spec("mujoco") is None:
        return "MuJoCo is not installed"
    return "" if soft_models.humanoid_file() else "the package mujoco-mjx with the model of the humanoid is not installed"


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
        entries = data.efc_J_rowadr[m - 1] + data.efc_J_rownnz[m - 1]
        J = sp.csr_matrix((data.efc_J[:entries], data.efc_J_colind[:entries], np.append(data.efc_J_rowadr[:m], entries)), shape=(m, n))
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
    hi = np.full(np.count_nonzero(kept), np.inf)
    return Problem(f"MuJoCo {name}", "mujoco", library, library.assemble(M, J[kept], k, r[kept], lo[kept], hi))
