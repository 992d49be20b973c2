"""The problems: real ones from a folder, scenes of any size."""
import csv
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from .problem import Problem

SCENES = {
    "pile": (30, 100, 300, 1000, 3000, 10000, 30000),   # contacts
    "rope": (100, 1000, 10000, 100000),                 # links, a contact at each
    "wall": (5, 10, 20),                                # courses, as many bricks wide
    "tower": (10, 50),                                  # boxes
    "islands": (100, 400),                              # piles of 30 contacts beside each other
}
QUICK = ("mug", "humanoid_fall", "pile 30", "pile 300", "rope 100", "wall 5", "islands 10")


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


def pile_steps(library, spheres, steps):
    """Handles of consecutive steps of a settled pile."""
    with tempfile.TemporaryDirectory() as folder:
        library.record_pile(spheres, steps, folder)
        return [library.read(path) for path in sorted(Path(folder).glob("*.mlcp"))]
