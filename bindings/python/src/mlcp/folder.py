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
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.io
import scipy.sparse
from numpy.typing import NDArray

from ._core import Problem
from .errors import FileError, FormatError
from .form import ProblemFile, ProblemForm, compressed_rows, make_problem

if TYPE_CHECKING:
    from ._core import Friction

__all__ = ["read_folder"]


def read_folder(path: str | os.PathLike[str], problem_class: type[Problem] = Problem, *, friction: Friction | None = None) -> ProblemFile:
    """Read the problem of a folder.

    Parameters
    ----------
    path : path
        Holds meta.json and ``.mtx`` or ``.mtx.gz`` files.
    problem_class : type
        What to make, `Problem` or a subclass.
    friction : str, optional
        Model of all contacts, as in `Problem.add_contacts`. None: the frictionless problem, without tangent rows. Rows of rolling
        friction are left out.

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
    form = _read_reduced(folder, meta) if meta["form"] == "reduced" else _read_global(folder)
    _read_contacts(folder, meta, form)
    form.keys = _keys(folder, len(form.shift))
    return make_problem(form, problem_class, friction)


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
    return compressed_rows(matrix, f"{folder / name}.mtx")


def _vector(folder: Path, name: str, size: int, *, needed: bool = False) -> NDArray[Any]:
    """A file of one row or column; zeros where there is none and none is needed."""
    vector = _read(folder, name)
    if vector is None:
        if needed:
            raise FileError(f"{folder / name}.mtx: no such file")
        return np.zeros(size)
    dense = np.asarray(vector.todense() if scipy.sparse.issparse(vector) else vector).ravel()
    if dense.shape != (size,):
        raise FormatError(f"{folder / name}.mtx: has {dense.size} entries, not {size}")
    return dense


def _keys(folder: Path, rows: int) -> NDArray[np.uint64]:
    """The file's plus one: there −1 means none, here 0."""
    return (_vector(folder, "key", rows) + 1).astype(np.uint64)


def _read_contacts(folder: Path, meta: dict[str, Any], form: ProblemForm) -> None:
    """Contacts of the file, if its rows come in groups."""
    if meta["dim"] < 2 or meta["contacts"] == 0 or not (meta["friction"] or _read(folder, "mu") is not None):
        return
    form.contacts, form.dimension = meta["contacts"], meta["dim"]
    if form.end_of_contacts > len(form.shift):
        raise FormatError(f"{folder / 'meta.json'}: contacts times dim is more than there are rows")
    form.mu = _vector(folder, "mu", form.contacts, needed=True)


def _read_global(folder: Path) -> ProblemForm:
    mass = _matrix(folder, "M", (None, None))
    n = mass.shape[1]
    c, d = (_matrix(folder, name, (None, n)) if _read(folder, name) is not None else scipy.sparse.csr_array((0, n)) for name in "CD")
    shift = np.concatenate([_vector(folder, "c", c.shape[0]), _vector(folder, "d", d.shape[0])])
    return ProblemForm(c.shape[0], shift, mass=mass, k=_vector(folder, "k", n), jacobian=scipy.sparse.vstack([c, d], format="csr"))


def _read_reduced(folder: Path, meta: dict[str, Any]) -> ProblemForm:
    matrix = _matrix(folder, "A", (None, None))
    if meta["nC"] > matrix.shape[0]:
        raise FormatError(f"{folder / 'meta.json'}: nC is more than there are rows")
    return ProblemForm(meta["nC"], _vector(folder, "b", matrix.shape[0]), a=matrix)
