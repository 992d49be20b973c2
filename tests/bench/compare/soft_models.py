"""Models for MuJoCo: the humanoid that the package mujoco-mjx ships, a crowd of them, one in a hammock, and boxes in a corner."""
import importlib.util
from pathlib import Path

IN_A_ROW = 5           # humanoids
NET = (11, 9)          # knots of the hammock
MESH = 0.2             # m between them


def humanoid_file():
    """Where its XML is, or None."""
    spec = importlib.util.find_spec("mujoco")
    path = spec and Path(spec.origin).parent / "mjx" / "test_data" / "humanoid" / "humanoid.xml"
    return path if path and path.exists() else None


def crowd(count):
    """Humanoids on one floor, apart from each other."""
    import mujoco
    spec = mujoco.MjSpec.from_file(str(humanoid_file()))
    for i in range(1, count):
        other = mujoco.MjSpec.from_file(str(humanoid_file()))
        for plane in [geom for geom in other.worldbody.geoms if geom.type == mujoco.mjtGeom.mjGEOM_PLANE]:
            other.delete(plane)
        place = spec.worldbody.add_frame(pos=[i % IN_A_ROW * 1.5, i // IN_A_ROW * 1.5, 0])
        spec.attach(other, prefix=f"h{i}_", frame=place)
    return spec.compile()


def hammock():
    """A humanoid falls on a net of point masses: threads of fixed length between neighbours, the four corners fixed."""
    import mujoco
    spec = mujoco.MjSpec.from_file(str(humanoid_file()))
    columns, rows = NET
    for x in range(columns):
        for y in range(rows):
            knot = spec.worldbody.add_body(pos=[(x - (columns - 1) / 2) * MESH, (y - (rows - 1) / 2) * MESH, 0.9])
            knot.add_site(name=f"knot {x} {y}")
            if (x, y) in ((0, 0), (0, rows - 1), (columns - 1, 0), (columns - 1, rows - 1)):
                continue
            knot.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.095, 0, 0], condim=3)
            for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1]):
                knot.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis, damping=[10, 0, 0])
    threads = [((x, y), (x + dx, y + dy)) for x in range(columns) for y in range(rows) for dx, dy in ((1, 0), (0, 1))
               if x + dx < columns and y + dy < rows]
    for i, ends in enumerate(threads):
        thread = spec.add_tendon(name=f"thread {i}")
        for x, y in ends:
            thread.wrap_site(f"knot {x} {y}")
        spec.add_equality(type=mujoco.mjtEq.mjEQ_TENDON, objtype=mujoco.mjtObj.mjOBJ_TENDON, name1=f"thread {i}")
    return spec.compile()


def boxes():
    """Two layers of nine cubes, side by side in a corner into which gravity leans."""
    import mujoco
    spec = mujoco.MjSpec()
    spec.option.gravity = [-4, -4, -10]
    half = 0.05
    for axis in range(3):
        size, pos = [0.5, 0.5, 0.5], [0.4, 0.4, 0.4]
        size[axis], pos[axis] = 0.1, -0.1
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=size, pos=pos)
    for x in range(3):
        for y in range(3):
            for z in range(2):
                cube = spec.worldbody.add_body(pos=[half * (2 * i + 1) for i in (x, y, z)])
                cube.add_freejoint()
                cube.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[half, half, half], friction=[0.4, 0.005, 0.0001])
    return spec.compile()


# name -> how it is made, steps until it is looked at
MODELS = {"humanoid": (lambda: crowd(1), 250), "22 humanoids": (lambda: crowd(22), 800), "hammock": (hammock, 500),
          "stacked boxes": (boxes, 300)}
