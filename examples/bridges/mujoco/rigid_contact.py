"""Steps a MuJoCo model with rigid contacts: MuJoCo finds contacts and forces and moves the bodies, mlcp solves for the impulses.

A step is MuJoCo's semi-implicit Euler, with its implicit damping of joints, but with hard constraints at its end instead of soft ones:

    (M + hD) v⁺ − Jᵀγ = (M + hD) v + h q,    q' = q ⊕ h v⁺

h time step, D damping of the joints, q all forces but those of constraints. Equalities and dry friction of joints hold, limits and
contacts let a gap close fully but not more, friction obeys Coulomb's law on the circular cone (an ellipse where a pair has two
coefficients), torsional and rolling friction are bounded by their coefficients times the normal force. What makes constraints soft in
MuJoCo (solref, solimp, impratio, margin, gap) has no effect.
"""
import copy

import mlcp
import mujoco
import numpy as np
import scipy.sparse as sp

_KIND = mujoco.mjtConstraint
_PRIME = np.uint64(0x100000001B3)  # of the Fowler-Noll-Vo hash


class RigidContact:
    """Takes the place of ``mujoco.mj_step`` for one model.

    Parameters
    ----------
    model : mujoco.MjModel
        Is copied; later changes belong into the attribute `model`, such as ``rigid.model.opt.gravity``.
    reach : float
        Contacts and limits become rows where their gap is smaller than this, m or rad: at least what can close in a step.
    stabilisation : float
        Part of an overlap, or of the error of an equality, that a step takes away, 0 to 1.
    **settings
        Keywords of `mlcp.Solver`.

    Attributes
    ----------
    model : mujoco.MjModel
        The copy, with elliptic cones, a sparse Jacobian, the Euler integrator and `reach` as margin.
    problem : mlcp.Problem
        Of the last step: M + hD, k, J, r, contacts. ``mlcp.save`` records it.
    solver : mlcp.Solver
    """

    def __init__(self, model, *, reach=0.02, stabilisation=0.2, **settings):
        self.model = copy.copy(model)
        option = self.model.opt
        self._damped = not option.disableflags & int(mujoco.mjtDisableBit.mjDSBL_EULERDAMP)
        option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_EULERDAMP)  # damping is in the mass of the solve
        option.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)  # rows of what sleeps would be missing
        option.integrator = mujoco.mjtIntegrator.mjINT_EULER
        option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC  # rows of a contact: normal, tangents, torsion, rolling
        option.jacobian = mujoco.mjtJacobian.mjJAC_SPARSE
        for name in "geom", "pair", "jnt", "tendon", "flex":
            getattr(self.model, f"{name}_margin")[:] = reach
        for name in "geom", "pair", "flex":
            getattr(self.model, f"{name}_gap")[:] = 0
        self.stabilisation = stabilisation
        self.problem = mlcp.Problem()
        self.solver = mlcp.Solver(**settings)
        self._body = None

    def step(self, data):
        """One time step of `data`, as ``mj_step`` makes it. Forces are left where sensors and ``mj_contactForce`` look for them.

        Returns the `mlcp.Result`. Where rows contradict each other, as redundant equalities do once they have drifted, it is
        ``"infeasible"``: bodies move with the velocity of least violation. Raises `mlcp.NotSolved` before they move if the solver met a limit.
        """
        model, h = self.model, self.model.opt.timestep
        mujoco.mj_step1(model, data)
        mujoco.mj_fwdActuation(model, data)
        mujoco.mj_fwdAcceleration(model, data)
        self._set_bodies(data)
        row_scale = self._set_rows(data)
        result = self.solver.solve(self.problem)
        if not result.solved and result.status != "infeasible":
            raise mlcp.NotSolved(result)
        force = row_scale * result.gamma / h
        data.efc_force[:] = force
        mujoco.mj_mulJacTVec(model, data, data.qfrc_constraint, force)
        data.qacc[:] = (result.v - data.qvel) / h
        mujoco.mj_sensorAcc(model, data)
        mujoco.mj_Euler(model, data)
        return result

    def _set_bodies(self, data):
        """M + hD, one sparse body for all, and k = (M + hD) v + h q."""
        model, h = self.model, self.model.opt.timestep
        mass = data.M.copy()
        if self._damped:
            mass[model.M_rowadr + model.M_rownnz - 1] += h * model.dof_damping  # the diagonal ends a row of the lower triangle
        if self._body is None:
            rows = np.append(model.M_rowadr, len(mass))
            self._body = self.problem.add_sparse_body(sp.csr_array((mass, model.M_colind, rows), shape=(model.nv, model.nv)), "lower")
        else:
            self.problem.set_mass(self._body, mass)
        self.problem.set_timestep_momentum(h, data.qvel, data.qfrc_smooth)

    def _set_rows(self, data):
        """J, r, bounds and friction from MuJoCo's list of constraints. Returns by what each of its rows was multiplied."""
        h, count = self.model.opt.timestep, data.nefc
        kind, gap = data.efc_type, data.efc_pos
        jacobian = sp.csr_array((data.efc_J, data.efc_J_colind, np.append(data.efc_J_rowadr, len(data.efc_J))), shape=(count, self.model.nv))
        equality = kind == _KIND.mjCNSTR_EQUALITY
        dry = (kind == _KIND.mjCNSTR_FRICTION_DOF) | (kind == _KIND.mjCNSTR_FRICTION_TENDON)
        r = np.where(equality | (gap < 0), self.stabilisation, 1.0) * -gap / h
        if self.model.geom_surfacevel.any():
            r += jacobian @ data.qvel - data.efc_vel  # MuJoCo's velocities of rows are relative to moving surfaces
        hi = np.where(dry, h * data.efc_frictionloss, np.inf)
        lo = np.where(dry | equality, -hi, 0.0)
        key = (1 + kind.astype(np.uint64)) << np.uint64(32) | data.efc_id.astype(np.uint64)
        row_scale, findex = np.ones(count), np.full(count, -1, np.int32)

        touching = data.contact.efc_address >= 0
        normal, dimension = data.contact.efc_address[touching], data.contact.dim[touching]
        friction = data.contact.friction[touching]
        if data.contact.adhesion[touching].any():
            raise ValueError(f"contact {np.flatnonzero(data.contact.adhesion)[0]} is adhesive: rigid contacts only push")
        for first, size, identity in zip(normal, dimension, _identities(data.contact, touching)):
            key[first:first + size] = identity
        rough = dimension >= 3
        # |(γ₁/µ₁, γ₂/µ₂)| ≤ γₙ is a circular cone for a second tangent µ₂/µ₁ times as long
        row_scale[normal[rough] + 2] = friction[rough, 1] / friction[rough, 0]
        for extra in 3, 4, 5:  # torsion; rolling about both tangents
            has = dimension > extra
            rows = normal[has] + extra
            findex[rows], hi[rows] = normal[has], friction[has, extra - 1]
            lo[rows] = -hi[rows]

        self.problem.clear_rows()
        self.problem.add_matrix_rows(sp.diags_array(row_scale) @ jacobian, r, lo, hi, keys=key)
        self.problem.declare_contacts(normal[rough], mu=friction[rough, 0])
        self.problem.set_findex(findex)
        return row_scale


def _identities(contact, chosen):
    """A key for what touches what. Contacts of one pair share it: they keep their order from step to step."""
    key = np.full(np.count_nonzero(chosen), 0xCBF29CE484222325, np.uint64)
    for column in np.hstack([contact.geom, contact.flex, contact.elem, contact.vert])[chosen].T:
        key = (key ^ column.astype(np.uint64)) * _PRIME
    return key
