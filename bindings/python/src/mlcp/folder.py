"""Problems as folders of Matrix Market files, in the layout of Siconos and FCLIB.

::

    global   M v = k + Cᵀλ + Dᵀz,   C v + c = 0,   w = D v + d          C, c optional
    reduced  w = A z + b, the first nC rows free (w = 0, z free)

meta.json gives ``form``, ``nC``, ``contacts`` and ``dim``. Contacts come in groups of ``dim`` rows, the normal one first, with
their coefficients in mu. Without a model of friction the tangents are left out.
"""

from __future__ import annotations

import gzip
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import scipy.io
import scipy.sparse
from numpy.typing import NDArray

from ._core import Problem
from .errors import FileError, FormatError

if TYPE_CHECKING:
    from ._core import Friction

__all__ = ["ProblemFolder", "read_folder"]


class ProblemFolder(NamedTuple):
    """A problem and where its rows stand in the files."""

    problem: Problem
    file_rows: NDArray[np.int64]  #: of each row of the problem
    file_row_count: int  #: rows in the files, those of friction included

    def in_files(self, gamma: NDArray[np.float64]) -> NDArray[np.float64]:
        """Impulses in the order of the files, 0 for rows that were left out."""
        spread = np.zeros(self.file_row_count)
        spread[self.file_rows] = gamma
        return spread


def read_folder(path: str | os.PathLike[str], problem_class: type[Problem] = Problem, *, friction: Friction | None = None) -> ProblemFolder:
    """Read the problem of a folder.

    Parameters
    ----------
    path : path
        Holds meta.json and ``.mtx`` or ``.mtx.gz`` files.
    problem_class : type
        What to make, `Problem` or a subclass.
    friction : str, optional
        Model of all contacts, as in `Problem.add_contacts`. None: the frictionless problem, without tangent rows.

    Raises
    ------
    FileError
        The folder or a file in it is missing.
    FormatError
        A file is not what it should be; sizes do not match.
    ArgumentError, RangeError
        The numbers are not a problem, e.g. A is not symmetric.
    """
    folder = Path(path)
    meta = _read_meta(folder)
    read = _read_reduced if meta["form"] == "reduced" else _read_global
    return read(folder, meta, problem_class, friction)


def _read_meta(folder: Path) -> dict[str, Any]:
    try:
        meta = json.loads((folder / "meta.json").read_text())
    except OSError as error:
        raise FileError(f"{folder / 'meta.json'}: {error.strerror}") from None
    except ValueError as error:
        raise FormatError(f"{folder / 'meta.json'}: {error}") from None
    if not isinstance(meta, dict) or meta.get("form") not in ("global", "reduced"):
        raise FormatError(f'{folder / "meta.json"}: "form" is neither "global" nor "reduced"')
    counts = {name: meta.get(name) if meta.get(name) is not None else least for name, least in (("nC", 0), ("contacts", 0), ("dim", 1))}
    for (name, count), least in zip(counts.items(), (0, 0, 1)):
        if not isinstance(count, int) or count < least:
            raise FormatError(f'{folder / "meta.json"}: "{name}" = {count!r} is not a count')
    return {"form": meta["form"], "friction": meta.get("friction") is True, **counts}


def _read(folder: Path, name: str) -> Any:
    """A matrix as it is stored, or None where there is no file."""
    for suffix in (".mtx", ".mtx.gz"):
        path = folder / (name + suffix)
        if not path.exists():
            continue
        try:
            with gzip.open(path, "rb") if suffix.endswith("gz") else open(path, "rb") as file:
                return scipy.io.mmread(file, spmatrix=False)
        except OSError as error:
            raise FileError(f"{path}: {error}") from None
        except (ValueError, EOFError) as error:
            raise FormatError(f"{path}: {error}") from None
    return None


def _matrix(folder: Path, name: str, shape: tuple[int | None, int | None]) -> Any:
    matrix = _read(folder, name)
    if matrix is None:
        raise FileError(f"{folder / name}.mtx: no such file")
    if any(size is not None and size != found for size, found in zip(shape, matrix.shape)):
        raise FormatError(f"{folder / name}.mtx: is {matrix.shape[0]} x {matrix.shape[1]}, not {shape[0] or '…'} x {shape[1] or '…'}")
    return scipy.sparse.csr_array(matrix)


def _vector(folder: Path, name: str, size: int) -> NDArray[Any]:
    """A file of one row or column; zeros where there is none."""
    vector = _read(folder, name)
    if vector is None:
        return np.zeros(size)
    dense = np.asarray(vector.todense() if scipy.sparse.issparse(vector) else vector).ravel()
    if dense.shape != (size,):
        raise FormatError(f"{folder / name}.mtx: has {dense.size} entries, not {size}")
    return dense


def _keys(folder: Path, rows: int) -> NDArray[np.uint64]:
    """The file's plus one: there −1 means none, here 0."""
    return (_vector(folder, "key", rows) + 1).astype(np.uint64)


def _have_tangents(folder: Path, meta: dict[str, Any]) -> bool:
    return meta["dim"] > 1 and meta["contacts"] > 0 and (meta["friction"] or _read(folder, "mu") is not None)


def _choose_rows(folder: Path, meta: dict[str, Any], bilateral: int, rows: int, friction: Friction | None) -> NDArray[np.int64]:
    """All rows with friction, else all but the tangents of contacts."""
    end = bilateral + meta["contacts"] * meta["dim"] if _have_tangents(folder, meta) else bilateral
    if end > rows:
        raise FormatError(f"{folder / 'meta.json'}: contacts times dim is more than there are rows")
    index = np.arange(rows)
    if friction is not None:
        return index
    return np.flatnonzero((index < bilateral) | (index >= end) | ((index - bilateral) % meta["dim"] == 0))


def _declare_contacts(problem: Problem, folder: Path, meta: dict[str, Any], bilateral: int, friction: Friction | None) -> None:
    if friction is None or not _have_tangents(folder, meta):
        return
    count, dimension = meta["contacts"], meta["dim"]
    problem.declare_contacts(bilateral + dimension * np.arange(count), dimension, mu=_vector(folder, "mu", count), model=friction)


def _read_global(folder: Path, meta: dict[str, Any], problem_class: type[Problem], friction: Friction | None) -> ProblemFolder:
    mass = _matrix(folder, "M", (None, None))
    n = mass.shape[1]
    blocks = [_matrix(folder, name, (None, n)) for name in ("C", "D") if _read(folder, name) is not None]
    jacobian = scipy.sparse.vstack(blocks, format="csr") if blocks else scipy.sparse.csr_array((0, n))
    rows = jacobian.shape[0]
    bilateral = blocks[0].shape[0] if _read(folder, "C") is not None else 0
    shift = np.concatenate([_vector(folder, "c", bilateral), _vector(folder, "d", rows - bilateral)])
    chosen = _choose_rows(folder, meta, bilateral, rows, friction)
    problem = problem_class.from_matrices(mass, _vector(folder, "k", n), jacobian[chosen], -shift[chosen],
                                          np.where(chosen < bilateral, -np.inf, 0.0), keys=_keys(folder, rows)[chosen])
    _declare_contacts(problem, folder, meta, bilateral, friction)
    return ProblemFolder(problem, chosen, rows)


def _read_reduced(folder: Path, meta: dict[str, Any], problem_class: type[Problem], friction: Friction | None) -> ProblemFolder:
    matrix = _matrix(folder, "A", (None, None))
    rows, bilateral = matrix.shape[0], meta["nC"]
    if bilateral > rows:
        raise FormatError(f"{folder / 'meta.json'}: nC is more than there are rows")
    chosen = _choose_rows(folder, meta, bilateral, rows, friction)
    problem = problem_class.from_reduced(matrix[chosen][:, chosen], _vector(folder, "b", rows)[chosen],
                                         np.where(chosen < bilateral, -np.inf, 0.0), keys=_keys(folder, rows)[chosen])
    _declare_contacts(problem, folder, meta, bilateral, friction)
    return ProblemFolder(problem, chosen, rows)
