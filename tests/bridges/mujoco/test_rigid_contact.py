"""The bridge to MuJoCo: its free motion where nothing touches, textbook motion where something does, and scenes beside its soft solver."""
import copy

import compare
import mlcp
import models
import mujoco
import numpy as np
import pytest
from rigid_contact import RigidContact

BALL, BOX, PLANE = mujoco.mjtGeom.mjGEOM_SPHERE, mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_PLANE
HALF, MASS = 0.1, 2.0  # of the box: half a side, m; kg
ADHESION = 5.0  # N


def on_a_floor(kind, edit=lambda spec: None, **geom):
    """A box or ball that touches the floor."""
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(name="floor", type=PLANE, size=[5, 5, 0.1], friction=[0, 0, 0])
    body = spec.worldbody.add_body(name="body", pos=[0, 0, HALF])
    body.add_freejoint()
    body.add_geom(name="body", type=kind, size=[HALF] * 3, mass=MASS, **geom)
    edit(spec)
    model = spec.compile()
    return model, mujoco.MjData(model)


def steps(contact, data, count):
    return [contact.step(data) for _ in range(count)]


def test_without_contact_it_is_mujocos_step():
    model = models.load("humanoid/humanoid.xml")
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
    ours, theirs = mujoco.MjData(model), mujoco.MjData(model)
    for data in ours, theirs:
        data.qpos[2] += 5  # in the air
        data.qvel[:] = np.random.default_rng(1).uniform(-0.1, 0.1, model.nv)
        data.ctrl[:] = 0.01
    contact = RigidContact(model, reach=1e-3)
    for _ in range(50):
        contact.step(ours)
        mujoco.mj_step(model, theirs)
    assert theirs.nefc == 0
    np.testing.assert_allclose(ours.qpos, theirs.qpos, rtol=0, atol=1e-12)
    np.testing.assert_allclose(ours.qvel, theirs.qvel, rtol=0, atol=1e-10)
    assert ours.time == theirs.time


def test_a_falling_ball_stops_on_the_floor_and_not_in_it():
    model, data = on_a_floor(BALL)
    data.qpos[2] = HALF + 0.05
    lowest = np.inf
    contact = RigidContact(model)
    for _ in range(200):
        contact.step(data)
        lowest = min(lowest, data.qpos[2])
    assert abs(lowest - HALF) < 1e-12 and abs(data.qvel[2]) < 1e-12


@pytest.mark.parametrize("along", [0, 1])
def test_a_box_slides_as_coulomb_says_also_with_two_coefficients(along):
    mu = 0.4, 0.1
    model, data = on_a_floor(BOX, lambda spec: spec.add_pair(geomname1="floor", geomname2="body", condim=3, friction=[*mu, 0, 0, 0]))
    data.qvel[along] = speed = 0.5
    contact = RigidContact(model, tolerance=1e-12)
    mujoco.mj_forward(contact.model, data)
    first_tangent = data.contact.frame[0, 3:6]  # MuJoCo chooses it
    chosen = mu[0] if abs(first_tangent[along]) > 0.5 else mu[1]
    count = 50
    steps(contact, data, count)
    assert data.qvel[along] == pytest.approx(speed - chosen * 9.81 * count * model.opt.timestep, abs=1e-9)


def test_a_ball_stops_spinning_as_torsional_friction_says():
    torsion, spin = 0.01, 5.0
    model, data = on_a_floor(BALL, condim=4, friction=[1, torsion, 0])
    data.qvel[5] = spin
    contact, count = RigidContact(model), 40
    steps(contact, data, count)
    inertia = 0.4 * MASS * HALF**2
    assert data.qvel[5] == pytest.approx(spin - torsion * MASS * 9.81 / inertia * count * model.opt.timestep, abs=1e-9)


def test_a_conveyor_belt_takes_a_box_along():
    def belt(spec):
        spec.geom("floor").surfacevel = [0.3, 0, 0, 0, 0, 0]
    model, data = on_a_floor(BOX, belt, friction=[0.5, 0, 0])
    contact = RigidContact(model)
    steps(contact, data, 10)
    assert abs(data.qvel[0]) == pytest.approx(0.5 * 9.81 * 10 * model.opt.timestep, abs=1e-9)
    steps(contact, data, 100)
    assert abs(data.qvel[0]) == pytest.approx(0.3, abs=1e-9)


def test_forces_are_where_mujoco_looks_for_them():
    def touch(spec):
        spec.body("body").add_site(name="pad", type=BOX, size=[1.1 * HALF] * 3)
        spec.add_sensor(name="touch", type=mujoco.mjtSensor.mjSENS_TOUCH, objtype=mujoco.mjtObj.mjOBJ_SITE, objname="pad")
    model, data = on_a_floor(BOX, touch)
    contact = RigidContact(model)
    steps(contact, data, 3)
    weight = MASS * 9.81
    assert data.sensor("touch").data[0] == pytest.approx(weight, rel=1e-9)
    assert compare.load(contact.model, data) == pytest.approx(weight, rel=1e-9)
    np.testing.assert_allclose(data.qfrc_constraint[:3], [0, 0, weight], atol=1e-9)


def test_steps_start_from_the_contacts_of_the_last_one():
    scene = models.tower()
    contact, data = RigidContact(scene.model), copy.copy(scene.data)
    results = steps(contact, data, 5)
    assert [result.counts.warm for result in results] == [False, True, True, True, True]
    assert len(set(contact.problem.keys)) == 4  # one for each pair of geoms


def test_equalities_limits_and_dry_friction():
    model = models.load("constraints.xml")
    data, contact, h = mujoco.MjData(model), RigidContact(model), model.opt.timestep
    kind = mujoco.mjtConstraint
    for _ in range(2):
        result = contact.step(data)
    assert result.solved
    force = result.gamma / h
    dry = np.isin(data.efc_type, [kind.mjCNSTR_FRICTION_DOF, kind.mjCNSTR_FRICTION_TENDON])
    equality = data.efc_type == kind.mjCNSTR_EQUALITY
    assert dry.sum() == 2 and equality.sum() == 20
    assert np.all(np.abs(force[dry]) <= data.efc_frictionloss[dry] * (1 + 1e-12))
    np.testing.assert_allclose(result.w[equality], 0, atol=1e-9)


def test_joints_stop_at_their_limits():
    def door(spec):
        body = spec.worldbody.add_body(name="door", pos=[0, 0, 2])
        body.add_joint(name="hinge", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0], range=[-30, 30], limited=True)
        body.add_geom(type=BOX, pos=[0.5, 0, 0], size=[0.5, 0.02, 0.2], mass=1)
    model, data = on_a_floor(BOX, door)
    contact = RigidContact(model)
    steps(contact, data, 400)
    assert data.joint("hinge").qpos[0] == pytest.approx(np.radians(30), abs=1e-9)


def test_where_equalities_contradict_each_other_bodies_go_on_and_the_certificate_names_the_rows():
    def torn(spec):
        for x in 0.2, -0.2:
            spec.worldbody.add_site(name=f"site {x}", pos=[x, 0, HALF])
            spec.add_equality(type=mujoco.mjtEq.mjEQ_CONNECT, objtype=mujoco.mjtObj.mjOBJ_SITE, name1=f"site {x}", name2="centre")
        spec.body("body").add_site(name="centre")
    model, data = on_a_floor(BALL, torn)
    result = RigidContact(model).step(data)
    assert result.status == "infeasible" and {0, 3} <= set(result.certificates[0].rows)
    assert np.isfinite(data.qvel).all() and abs(data.qvel[0]) < 1e-6  # between both


def test_a_limit_of_the_solver_is_an_error_and_moves_nothing():
    scene = models.tower()
    data = copy.copy(scene.data)
    before = data.qpos.copy()
    with pytest.raises(mlcp.NotSolved):
        RigidContact(scene.model, max_work=1).step(data)
    np.testing.assert_array_equal(data.qpos, before)
    assert data.time == 0


def test_adhesive_contacts_are_refused_by_index():
    model, data = on_a_floor(BOX, adhesion=ADHESION)
    with pytest.raises(ValueError, match="contact 0 is adhesive"):
        RigidContact(model).step(data)


def test_the_callers_model_stays_as_it_is():
    model, data = on_a_floor(BOX)
    margin, cone = model.geom_margin.copy(), model.opt.cone
    RigidContact(model).step(data)
    np.testing.assert_array_equal(model.geom_margin, margin)
    assert model.opt.cone == cone


@pytest.fixture(scope="module", params=list(models.SCENES))
def scene_and_runs(request):
    scene = models.SCENES[request.param]()._replace(seconds=1.0)
    return scene, {name: compare.run(scene, compare.STEPPERS[name]) for name in ("MuJoCo", "mlcp")}


def test_a_second_of_a_scene_neither_sinks_nor_slides(scene_and_runs):
    scene, runs = scene_and_runs
    rigid, soft = runs["mlcp"], runs["MuJoCo"]
    assert rigid.depth.max() < 1e-7 < soft.depth.max()
    assert rigid.slip[-1] < 1e-6 < soft.slip[-1]
    late = len(rigid.time) // 2
    np.testing.assert_allclose(rigid.load[late:], scene.load, rtol=0.02)


def test_a_heap_of_many_shapes_is_solved_in_every_step():
    model = models.load("primitives.xml")
    data, contact = mujoco.MjData(model), RigidContact(model)
    assert all(result.solved for result in steps(contact, data, 120))
    assert contact.problem.contact_count > 100
