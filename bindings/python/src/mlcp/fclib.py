"""FCLIB's HDF5 files, in which the codes that compute with Siconos and LMGC90 exchange frictional contact problems.

::

    global   M v = H r + G λ + f,  Gᵀv + b = 0,  u = Hᵀv + w
    local    Vᵀr + R λ + s = 0,  u = W r + V λ + q

The rows of λ come first and are bilateral, those of r follow, contact by contact, the normal first. Needs h5py, ``pip install
mlcp[fclib]``, which brings HDF5 along.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

from ._core import Problem
from .errors import FileError, FormatError, UnsupportedError
from .form import ProblemFile, ProblemForm, compressed_rows, form_of, make_problem

if TYPE_CHECKING:
    from ._core import Friction

__all__ = ["read_fclib", "write_fclib"]


def read_fclib(path: str | os.PathLike[str], problem_class: type[Problem] = Problem, *, friction: Friction | None = None) -> ProblemFile:
    """Read the problem of an FCLIB file.

    Parameters
    ----------
    path : path
        An HDF5 file with a group fclib_local or fclib_global.
    problem_class : type
        What to make, `Problem` or a subclass.
    friction : str, optional
        Model of all contacts, as in `Problem.add_contacts`. None: the frictionless problem, without tangent rows.

    Raises
    ------
    ImportError
        There is no h5py.
    FileError
        The file cannot be opened.
    FormatError
        It holds no FCLIB problem, or one whose sizes do not match.
    ArgumentError, RangeError
        The numbers are not a problem, e.g. W is not symmetric.
    """
    with _open(path, "r") as file:
        for name, read in (("fclib_local", _read_local), ("fclib_global", _read_global)):
            if name in file:
                return make_problem(read(_Reader(file[name])), problem_class, friction)
    raise FormatError(f"{path}: holds neither a local nor a global FCLIB problem")


def write_fclib(path: str | os.PathLike[str], problem: Problem) -> None:
    """Write a problem as a new FCLIB file, local if it is a reduced one, else global. Models of friction and keys have no place there.

    Parameters
    ----------
    path : path
        Of a file that is not there yet.
    problem : Problem
        Bilateral rows and contacts alone. The velocities of prescribed bodies go into b and w.

    Raises
    ------
    ImportError
        There is no h5py.
    UnsupportedError
        The problem has rows that are neither bilateral nor a contact's, compliance beside velocities, contacts in the plane and in space at
        once, or fixed bounds of friction.
    FileError
        The file is there already, or cannot be written.
    """
    form = form_of(problem)
    if form.contacts == 0 or form.end_of_contacts != len(form.shift):
        raise UnsupportedError("an FCLIB file holds bilateral rows and contacts, no plain unilateral rows")
    free, shift = form.bilateral, form.shift
    if form.a is not None:
        name = "fclib_local"
        matrices = {"W": form.a[free:, free:], "V": form.a[free:, :free], "R": form.a[:free, :free]}
        vectors = {"mu": form.mu, "q": shift[free:], "s": shift[:free]}
    else:
        name = "fclib_global"
        matrices = {"M": form.mass, "H": form.jacobian[free:].T, "G": form.jacobian[:free].T}
        vectors = {"mu": form.mu, "f": form.k, "w": shift[free:], "b": shift[:free]}
    with _open(path, "x") as file:
        group = file.create_group(name)
        group["spacedim"] = np.array([form.dimension], np.int32)
        for matrix, entries in matrices.items():
            if entries.shape[0] and entries.shape[1]:
                _write_matrix(group.create_group(matrix), entries)
        for vector, values in vectors.items():
            if len(values):
                group[f"vectors/{vector}"] = values


def _open(path: str | os.PathLike[str], mode: str) -> Any:
    try:
        import h5py
    except ImportError as error:
        raise ImportError(f"{error}; pip install 'mlcp[fclib]'") from None
    try:
        return h5py.File(path, mode)
    except OSError as error:
        raise FileError(f"{path}: {error}") from None


class _Reader:
    """What stands in a group of the file, by name."""

    def __init__(self, group: Any) -> None:
        self.group = group
        self.source = f"{group.file.filename}: {group.name}"
        if not hasattr(group, "keys"):
            raise FormatError(f"{self.source} is no group")

    def has(self, name: str) -> bool:
        return name in self.group

    def array(self, name: str, kind: str) -> NDArray[Any]:
        found = self.group.get(name)
        if not hasattr(found, "dtype"):
            raise FormatError(f"{self.source}/{name} is missing")
        values = np.ravel(found[()])
        if values.dtype.kind != kind:
            raise FormatError(f"{self.source}/{name} has dtype {values.dtype}")
        return values

    def number(self, name: str) -> int:
        values = self.array(name, "i")
        if len(values) != 1:
            raise FormatError(f"{self.source}/{name} is not a number")
        return int(values[0])

    def vector(self, name: str, size: int, *, needed: bool = False) -> NDArray[Any]:
        """Zeros where there is none and none is needed."""
        if not needed and not self.has(name):
            return np.zeros(size)
        values = self.array(name, "f")
        if len(values) != size:
            raise FormatError(f"{self.source}/{name} has {len(values)} entries, not {size}")
        return values.astype(np.float64)

    def matrix(self, name: str, shape: tuple[int | None, int | None] = (None, None)) -> Any:
        """CSR. nz ≥ 0: that many entries, p their rows and i their columns; −1: compressed columns; −2: compressed rows."""
        if not self.has(name):
            raise FormatError(f"{self.source}/{name} is missing")
        part = _Reader(self.group[name])
        m, n, nz = (part.number(size) for size in ("m", "n", "nz"))
        p, i, x = part.array("p", "i"), part.array("i", "i"), part.array("x", "f")
        try:
            if nz >= 0:
                found = scipy.sparse.coo_array((x[:nz], (p[:nz], i[:nz])), shape=(m, n))
            else:
                make = scipy.sparse.csc_array if nz == -1 else scipy.sparse.csr_array
                found = make((x[:p[-1]], i[:p[-1]], p), shape=(m, n))
                found.check_format(full_check=True)
        except (ValueError, IndexError) as error:
            raise FormatError(f"{part.source}: {error}") from None
        if any(size is not None and size != has for size, has in zip(shape, (m, n))):
            raise FormatError(f"{part.source} is {m} x {n}, not {'…' if shape[0] is None else shape[0]} x {'…' if shape[1] is None else shape[1]}")
        return compressed_rows(found, part.source)

    def matrix_or_none(self, name: str, shape: tuple[int | None, int | None]) -> Any:
        """Where there is none, one whose open sizes are 0."""
        return self.matrix(name, shape) if self.has(name) else scipy.sparse.csr_array(tuple(size or 0 for size in shape))


def _read_local(file: _Reader) -> ProblemForm:
    w = file.matrix("W")
    r = file.matrix_or_none("R", (None, None))
    v = file.matrix_or_none("V", (w.shape[0], r.shape[0]))
    a = scipy.sparse.block_array([[r, v.T], [v, w]], format="csr")
    return _with_contacts(file, ProblemForm(r.shape[0], _shift(file, "s", r.shape[0], "q", w.shape[0]), a=a))


def _read_global(file: _Reader) -> ProblemForm:
    mass = file.matrix("M")
    n = mass.shape[0]
    h, g = file.matrix("H", (n, None)), file.matrix_or_none("G", (n, None))
    return _with_contacts(file, ProblemForm(g.shape[1], _shift(file, "b", g.shape[1], "w", h.shape[1]), mass=mass,
                                            k=file.vector("vectors/f", n), jacobian=scipy.sparse.hstack([g, h]).T.tocsr()))


def _shift(file: _Reader, bilateral: str, free: int, contacts: str, rows: int) -> NDArray[Any]:
    return np.concatenate([file.vector("vectors/" + bilateral, free), file.vector("vectors/" + contacts, rows)])


def _with_contacts(file: _Reader, form: ProblemForm) -> ProblemForm:
    form.dimension = file.number("spacedim")
    rows = len(form.shift) - form.bilateral
    if form.dimension not in (2, 3) or rows % form.dimension:
        raise FormatError(f"{file.source}: {rows} rows are not contacts of dimension {form.dimension}")
    form.contacts = rows // form.dimension
    form.mu = file.vector("vectors/mu", form.contacts, needed=True)
    return form


def _write_matrix(group: Any, matrix: Any) -> None:
    """By entries, as the library's program does."""
    entries = matrix.tocoo()
    for name, number in (("m", matrix.shape[0]), ("n", matrix.shape[1]), ("nz", entries.nnz), ("nzmax", entries.nnz)):
        group[name] = np.array([number], np.int32)
    group["p"], group["i"], group["x"] = entries.row.astype(np.int32), entries.col.astype(np.int32), entries.data
