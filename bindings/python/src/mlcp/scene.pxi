"""The scenes of the C++ library's gallery, stepped and drawn from Python."""
from libcpp.memory cimport unique_ptr
from libcpp.vector cimport vector

cimport mlcp._scenes as _scenes

cdef object exhibit(const _scenes.Exhibit &shown):
    return records.Exhibit(shown.unit.decode(), shown.default_size, shown.film.steps, shown.film.every, shown.film.start)

# by name
scenes = {_scenes.gallery()[i].name.decode(): exhibit(_scenes.gallery()[i]) for i in range(_scenes.gallery().size())}


cdef object points(vector[_scenes.Point] &path):
    return np.array([[path[i][0], path[i][1], path[i][2]] for i in range(path.size())])


cdef class Scene:
    """A scene that steps itself: bodies, rows that are made anew at every step with keys, a solver that starts warm.

    Parameters
    ----------
    name : str
        One of `mlcp.scenes`.
    size : int, optional
        Number of spheres, links, boxes or bricks.
    seed : int
        For scenes that begin at random.
    design : mapping of str to float, optional
        Numbers that a designer chooses, by name. Of the gripper: friction of the pads, clearance between the open pads and a part on the axis
        (m), part_mass and finger_mass (kg). Other scenes have none.
    settings : keywords of `Solver` but `progress` and `parallel_for`
    """
    cdef unique_ptr[_scenes.CppScene] scene
    cdef readonly str name
    cdef readonly double time  # of the scene, s
    cdef bint prepared, finished

    def __init__(self, str name, size=None, *, unsigned seed=1, design=None, **settings):
        cdef vector[_scenes.Choice] choices
        cdef _scenes.Choice choice
        if name not in scenes:
            raise errors.ArgumentError(f"there is no scene {name!r}, but {', '.join(scenes)}")
        self.name = name
        self.time = 0
        cdef bytes which = name.encode()
        for chosen_name, value in (design or {}).items():
            choice.name, choice.value = chosen_name.encode(), value
            choices.push_back(choice)
        self.scene = _scenes.make_scene(which, size32(scenes[name].size if size is None else size, "size"), seed, choices)
        cdef mlcp_settings fields
        mlcp_settings_init(&fields, sizeof(mlcp_settings))
        write_settings(&fields, settings)
        self.scene.get().use(fields)

    def prepare(self, double h=0.01):
        """Makes the next step's problem, of length h in s."""
        self.scene.get().prepare(h)
        self.time += h
        self.prepared = True

    def finish(self):
        """Solves what was prepared and moves the bodies; returns the `Result`."""
        if not self.prepared:
            raise errors.StateError("prepare comes before finish")
        cdef const mlcp_report *report
        cdef _scenes.CppScene *scene = self.scene.get()
        with nogil:
            report = &scene.finish()
        self.prepared = False
        return Result.of(scene.solver(), report)

    def step(self, double h=0.01):
        """`prepare` and `finish`."""
        self.prepare(h)
        return self.finish()

    @property
    def problem(self):
        """A copy of the problem of the step that was prepared last."""
        cdef Problem problem = Problem.__new__(Problem)
        cdef mlcp_problem *handle = NULL
        check(mlcp_problem_clone(self.scene.get().problem(), &handle))
        mlcp_problem_destroy(problem.handle)
        problem.handle = handle
        return problem

    @property
    def start(self):
        """A copy of the mask from which the step that was prepared last starts; None in the first step."""
        cdef const mlcp_mask *start = self.scene.get().start()
        return None if start is NULL else Mask.take(start)

    @property
    def measures(self):
        """What the scene itself measures at the present positions, by name: of the gripper part_off_centre, part_slid and closed, m."""
        measured = self.scene.get().measures()
        return {measured[i].name.decode(): measured[i].value for i in range(measured.size())}

    def draw(self):
        """What there is to see at the present positions: a `Drawing`."""
        cdef _scenes.Drawing drawing
        cdef size_t i, c
        self.scene.get().draw(drawing)
        spheres = np.empty((drawing.spheres.size(), 4))
        boxes = np.empty((drawing.boxes.size(), 8, 3))
        actions = np.empty((drawing.actions.size(), 2, 3))
        for i in range(drawing.spheres.size()):
            at = drawing.spheres[i].centre
            spheres[i] = at[0], at[1], at[2], drawing.spheres[i].radius
        for i in range(drawing.boxes.size()):
            for c in range(8):
                corner = drawing.boxes[i][c]
                boxes[i, c] = corner[0], corner[1], corner[2]
        for i in range(drawing.actions.size()):
            point, direction = drawing.actions[i].point, drawing.actions[i].direction
            actions[i] = (point[0], point[1], point[2]), (direction[0], direction[1], direction[2])
        faces = [points(drawing.faces[i].corners) for i in range(drawing.faces.size())]
        sphere_roles = np.array([<int>drawing.spheres[i].role for i in range(drawing.spheres.size())], dtype=np.uint8)
        face_roles = np.array([<int>drawing.faces[i].role for i in range(drawing.faces.size())], dtype=np.uint8)
        eye = np.array([drawing.eye[0], drawing.eye[1], drawing.eye[2]])
        paths = [points(drawing.paths[i]) for i in range(drawing.paths.size())]
        return records.Drawing(spheres, boxes, paths, actions[:, 0], actions[:, 1], sphere_roles, faces, face_roles, eye)
