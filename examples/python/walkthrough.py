"""libmlcp from Python, to be read from top to bottom: from a block on a table to a humanoid that stands.

    pip install ./bindings/python[plot]
    python examples/python/walkthrough.py        # prints, and writes walkthrough.png

In every step of a simulation we look for velocities v and impulses γ with

    M v − Jᵀ γ = k,    w = J v + Σ γ − r,    lo ≤ γ ≤ hi,    w > 0 only where γ = lo, w < 0 only where γ = hi.
"""

# %% A block rests on a table with two corners. Which impulses carry it through a step of 10 ms?
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import mlcp
import mlcp.plot

h, gravity = 0.01, 9.81
mass = np.diag([2.0, 2.0, 0.1])  # velocities x, y, angle: kg, kg, kg·m²
momentum = [0.0, -gravity * 2.0 * h, 0.0]  # k = M v + h Q: at rest, its weight
corners = [[0, 1, -0.2], [0, 1, 0.2]]  # how fast each corner rises: a row of J

result = mlcp.solve(mass, momentum, corners)
print(f"block: {result.status}, impulses {result.gamma} N·s, forces {result.gamma / h} N, error {result.errors.largest:.0e}")
assert np.isclose(result.gamma.sum(), 2.0 * gravity * h)

# %% A push to the side that lifts one corner: that contact opens by itself, its impulse is 0 and it moves away (w > 0).
result = mlcp.solve(mass, [0.0, momentum[1], 0.03], corners)
print(f"pushed: corners {' and '.join('closed' if closed else 'open' for closed in result.active)}, w = {result.w} m/s")
assert result.gamma[result.w > 1e-12].max(initial=0) == 0

# %% Rows that contradict each other: a press closes on a block faster than it can go. The certificate names them.
press = mlcp.solve(mass, momentum, [[0, 1, 0], [0, -1, 0]], r=[0.1, 0.1])
(certificate,) = press.certificates
print(f"press: {press.status}, rows {certificate.rows} contradict each other, multipliers {certificate.y}")
assert not press.solved and sorted(certificate.rows) == [0, 1]

# %% A simulation keeps a Problem and a Solver. Bodies stay, rows are made anew in each step; keys tell which one is which, so that
# a step starts from the contacts that were active in the last one. Here a ball of 1 kg falls on a table and stays there.
problem, solver = mlcp.Problem(), mlcp.Solver()
(ball,) = problem.add_bodies(np.eye(1)[np.newaxis])
height, v, mask = 0.2, np.zeros(1), mlcp.Mask()
for step in range(60):
    problem.set_timestep_momentum(h, v, -gravity)
    problem.clear_rows()
    if height < 0.05:  # near enough to touch in this step
        problem.add_rows(body_b=[ball], jacobian_b=[[1.0]], r=mlcp.timestep_rows(h, [height]), keys=[1])
    result = solver.solve(problem, mlcp.Mask.carry(problem, mask))
    v, mask = result.v, result.mask
    height += h * v[0]
print(f"ball: rests at {height:.1e} m after {step + 1} steps, carried by {result.gamma[0] / h:.2f} N")
assert abs(height) < 1e-12 and np.isclose(result.gamma[0], gravity * h)

# %% Where every nanosecond counts, arrays are bound once; then a call costs about a microsecond more than from C.
r = np.zeros(1)
bound = solver.bind(problem, r=r)
for speed in (0.0, 0.1, 0.2):  # the table rises
    r[0] = speed
    assert bound.solve(warm=True) == "solved" and np.isclose(bound.v[0], speed)

# %% A humanoid in the plane: torso, head, two arms, two legs of thigh, shin and foot: 10 bodies, 9 joints of two rows. Each joint has
# a motor that holds its angle with at most 200 N·m, which is a row with bounds ±200 h. Each foot stands on heel and toe. It trembles a
# little when the step begins; joints, motors and the ground stop that, and only a drift to the side stays, for there is no friction.
parts = {  # centre x, z; mass; length; angle from the vertical
    "torso": (0.0, 1.15, 35.0, 0.55, 0.0), "head": (0.0, 1.55, 5.0, 0.25, 0.0),
    "left arm": (-0.02, 1.12, 4.0, 0.6, 0.0), "right arm": (0.02, 1.12, 4.0, 0.6, 0.0),
    "left thigh": (0.0, 0.675, 8.0, 0.4, 0.0), "left shin": (0.0, 0.275, 4.0, 0.4, 0.0), "left foot": (0.05, 0.0375, 1.0, 0.25, np.pi / 2),
    "right thigh": (0.0, 0.675, 8.0, 0.4, 0.0), "right shin": (0.0, 0.275, 4.0, 0.4, 0.0), "right foot": (0.05, 0.0375, 1.0, 0.25, np.pi / 2),
}
joints = [("torso", "head", 0.0, 1.425), ("torso", "left arm", 0.0, 1.4), ("torso", "right arm", 0.0, 1.4),
          ("torso", "left thigh", 0.0, 0.875), ("torso", "right thigh", 0.0, 0.875),
          ("left thigh", "left shin", 0.0, 0.475), ("right thigh", "right shin", 0.0, 0.475),
          ("left shin", "left foot", 0.0, 0.075), ("right shin", "right foot", 0.0, 0.075)]
names = list(parts)
x, z, masses, lengths, _ = np.array(list(parts.values())).T
inertias = masses * lengths**2 / 12

humanoid = mlcp.Problem()
bodies = humanoid.add_bodies([np.diag([m, m, i]) for m, i in zip(masses, inertias)])
weight = np.zeros(humanoid.velocities)
weight[1::3] = -gravity * masses
tremble = np.random.default_rng(1).uniform(-0.01, 0.01, humanoid.velocities)
humanoid.set_timestep_momentum(h, tremble, weight)

for parent, child, px, pz in joints:
    a, b = names.index(parent), names.index(child)
    # the pin moves with (vx − ω (z − zc), vz + ω (x − xc)) of either body
    pin_a, pin_b = [[1, 0, -(pz - z[i])] for i in (a, b)], [[0, 1, px - x[i]] for i in (a, b)]
    humanoid.add_rows(bodies[a], bodies[b], -np.array([pin_a[0], pin_b[0]]), [pin_a[1], pin_b[1]], lo=-np.inf)
    humanoid.add_rows(bodies[a], bodies[b], [[0, 0, -1]], [[0, 0, 1]], lo=-200 * h, hi=200 * h)  # the motor
first_contact = humanoid.rows
for foot in ("left foot", "right foot"):
    i = names.index(foot)
    humanoid.add_rows(body_b=[bodies[i]] * 2, jacobian_b=[[0, 1, -0.125], [0, 1, 0.125]])  # heel and toe

solver = mlcp.Solver(method="simplex", trace=True)
result = solver.solve(humanoid)
ground = result.gamma[first_contact:] / h
print(f"humanoid: {humanoid!r}: {result}")
drift, rest = result.v[0::3], np.concatenate([result.v[1::3], result.v[2::3]])
print(f"humanoid: stands, drifts {drift.mean():.1e} m/s; heels and toes carry {np.round(ground, 1)} N, "
      f"together {ground.sum():.2f} N, its weight is {gravity * masses.sum():.2f} N less what the trembling brings")
assert result.solved and max(np.ptp(drift), np.abs(rest).max()) < 1e-14
assert np.isclose(h * ground.sum(), h * gravity * masses.sum() - masses @ tremble[1::3])

# %% With weak motors it cannot: the knees and ankles yield.
first_motor = 2
weak = humanoid.copy()
for motor in range(first_motor, first_contact, 3):
    weak.set_bounds([-1e-3 * h], [1e-3 * h], first=motor)
weak.set_momentum(humanoid.momentum + np.where(np.arange(humanoid.velocities) == 3 * names.index("head"), 5.0, 0.0))  # 5 N·s at its head
fallen = mlcp.Solver().solve(weak)
print(f"weak and pushed: {np.count_nonzero(fallen.mask[first_motor:first_contact:3] != mlcp.RowState.ACTIVE)} of {len(joints)} motors at "
      f"their limit, moves {np.abs(fallen.v).max():.2f} m/s")
assert np.abs(fallen.v).max() > 0.1

# %% Many problems at a time use all cores: how strong must a push be until a toe or heel lifts?
pushes = np.linspace(0.0, 30.0, 16)  # N·s, at the torso
many = []
for push in pushes:
    pushed = humanoid.copy()
    pushed.set_momentum(humanoid.momentum[:1] + push)
    many.append(pushed)
lifts = [int(np.count_nonzero(one.w[first_contact:] > 1e-9)) for one in mlcp.solve_many(many)]
print("contacts that lift, by push in N·s:", dict(zip(pushes.tolist(), lifts)))
assert lifts[0] == 0 < lifts[-1]

# %% What did the solver do? The matrix and its factor, the active set over the pivots, and where a wall carries its weight.
figure, axes = plt.subplots(2, 2, figsize=(11, 10), layout="constrained")
mlcp.plot.sparsity(humanoid, axes=axes[0])
mlcp.plot.active_set(result, axes=axes[1, 0])
wall = mlcp.Scene("wall", 5)
wall.prepare(h)
drawing = wall.draw()
mlcp.plot.contact_forces(drawing, wall.finish().gamma / h, axes=axes[1, 1])
figure.savefig("walkthrough.png", dpi=100)
print("wrote walkthrough.png")
