"""The problems: real ones from a folder, scenes of any size."""
import csv
from dataclasses import dataclass, field

from .problem import Problem

SCENES = {
    "pile": (30, 100, 300, 1000, 3000, 10000, 30000),   # contacts
    "rope": (100, 1000, 10000, 100000),                 # links, a contact at each
    "wall": (5, 10, 20),                                # courses, as many bricks wide
    "tower": (10, 50),                                  # boxes
    "islands": (100, 400),                              # piles of 30 contacts beside each other
}
STEPS = 100   # of a recorded sequence
FACETS = 8    # of the pyramid that peers know a friction cone as; scenes have the same by default
QUICK = ("mug", "humanoid_fall", "pile 30", "pile 300", "rope 100", "wall 5", "islands 10", "gripper 8, friction")


@dataclass
class Source:
    """A problem that is not read or made yet."""
    name: str
    family: str
    make: object = field(repr=False)  # library -> handle

    def problem(self, library):
        return Problem(self.name, self.family, library, self.make(library))


def scene(family, size):
    return Source(f"{family} {size}", family, lambda library: library.scene(family, size))


def scenes():
    return [scene(family, size) for family, sizes in SCENES.items() for size in sizes] + [scene("islands", 10)]


def shared(folder):
    """The symmetric problems that INDEX.tsv lists."""
    with open(folder / "INDEX.tsv", newline="") as file:
        names = [row["name"] for row in csv.DictReader(file, delimiter="\t") if row["symmetry"] == "symmetric"]
    return [Source(name, "real", lambda library, path=folder / name: library.read(path)) for name in names]


def recorded(folder, library):
    """Name -> handles of the steps of every sequence in the folder; the caller owns them."""
    for sequence in sorted(folder.glob("sequence_*")):
        yield sequence.name, [library.read(step) for step in sorted(sequence.iterdir()) if step.is_dir()]


@dataclass(frozen=True)
class Recording:
    """STEPS steps of a scene of examples/scenes, from where it does what it is for."""
    scene: str
    size: int
    first: int
    h: float = 0.01     # s
    count: int = 1      # scenes beside each other that begin differently
    rubs: bool = False  # has contacts with friction

    @property
    def name(self):
        return f"{self.scene} {self.size}" if self.count == 1 else f"{self.count} times {self.scene} {self.size}"

    def steps(self, library, facets, first=0, count=STEPS):
        """Handles of steps first .. first + count − 1 of the recording; the caller owns them."""
        scenes = [library.record(self.scene, self.size, seed, self.h, self.first + first, count) for seed in range(1, self.count + 1)]
        steps = []
        for together in zip(*scenes):
            plain = [library.plain(one, facets) for one in together]
            steps.append(library.join(plain) if self.count > 1 else plain[0])
            for handle in (*together, *(plain if self.count > 1 else ())):
                library.destroy(handle)
        return steps


# machines are driven, what falls has met what it falls on
MACHINES = (Recording("gripper", 8, 60, rubs=True), Recording("bottles", 24, 300, rubs=True), Recording("cascade", 100, 100, rubs=True),
            Recording("wall_of_boxes", 5, 20, rubs=True), Recording("linkage", 1, 20), Recording("table", 1, 10), Recording("rope_over_pegs", 30, 40))
SEQUENCES = (Recording("pile", 1000, 0), Recording("pile", 10, 0, count=100), Recording("rope", 1000, 0, h=1e-3), Recording("wall", 10, 0),
             Recording("tower", 10, 0), *MACHINES)


def variants(recording):
    """Name and facets: without friction, and with where there is some."""
    yield recording.name, 0
    if recording.rubs:
        yield f"{recording.name}, friction", FACETS


def machines():
    """The step in the middle of each recording."""
    def make(library, recording, facets):
        return recording.steps(library, facets, STEPS // 2, 1)[0]
    return [Source(name, "machine", lambda library, recording=recording, facets=facets: make(library, recording, facets))
            for recording in MACHINES for name, facets in variants(recording)]
