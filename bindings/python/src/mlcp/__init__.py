"""Exact solver for rigid-body contact: the mixed linear complementarity problem of multibody systems, in NumPy and SciPy terms.

`solve`, `solve_lcp` and `solve_qp` take matrices and solve. `Problem`, `Solver`, `Mask` and `Result` are for simulations, where one
solver lives over many steps. `solve_many` uses the cores. `mlcp.plot` (``pip install mlcp[plot]``) draws; ``python -m mlcp.demo``
runs a scene.
"""

from ._core import (
    BoundProblem,
    Mask,
    Problem,
    Result,
    Scene,
    Solver,
    Work,
    dumps,
    load,
    loads,
    save,
    scenes,
    timestep_erp_cfm,
    timestep_rows,
    timestep_restitution,
    timestep_spring,
)
from ._core import version as __version__
from .errors import (
    ArgumentError,
    Error,
    FileError,
    FormatError,
    InternalError,
    NotSolved,
    RangeError,
    StateError,
    UnsupportedError,
)
from .fclib import read_fclib, write_fclib
from .folder import read_folder
from .form import ProblemFile
from .many import solve_many
from .one_line import QPSolution, solve, solve_lcp, solve_qp
from .records import Certificate, Contacts, ContactState, Counts, Drawing, Errors, Factor, Outcome, Progress, RowState, Snapshot, Times

__all__ = [
    "ArgumentError",
    "BoundProblem",
    "Certificate",
    "ContactState",
    "Contacts",
    "Counts",
    "Drawing",
    "Error",
    "Errors",
    "Factor",
    "FileError",
    "FormatError",
    "InternalError",
    "Mask",
    "NotSolved",
    "Outcome",
    "Problem",
    "ProblemFile",
    "Progress",
    "QPSolution",
    "RangeError",
    "Result",
    "RowState",
    "Scene",
    "Snapshot",
    "Solver",
    "StateError",
    "Times",
    "UnsupportedError",
    "Work",
    "__version__",
    "dumps",
    "load",
    "loads",
    "read_fclib",
    "read_folder",
    "save",
    "scenes",
    "solve",
    "solve_lcp",
    "solve_many",
    "solve_qp",
    "timestep_erp_cfm",
    "timestep_rows",
    "timestep_restitution",
    "timestep_spring",
    "write_fclib",
]
