"""Problems from folders of Matrix Market files: small ones made here, the real ones where they are found."""

import csv
import gzip
import importlib.util
import json

import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp
from conftest import natural_residual

import mlcp

meta = {"form": "global", "nC": 0, "contacts": 2, "dim": 3, "friction": True}


def write(folder, meta, **parts):
    folder.mkdir(exist_ok=True)
    (folder / "meta.json").write_text(json.dumps(meta))
    for name, value in parts.items():
        value = np.asarray(value).reshape(-1, 1) if np.ndim(value) == 1 else value
        scipy.io.mmwrite(folder / f"{name}.mtx", sp.coo_array(value) if sp.issparse(value) else value)
    return folder


@pytest.fixture
def contacts(tmp_path):
    """Two contacts of three rows each between three joint coordinates, a joint before them and a limit after them."""
    random = np.random.default_rng(1)
    return write(tmp_path / "contacts", meta, M=sp.diags_array([2.0, 3, 4]), k=[1.0, -2, -3], C=sp.csr_array([[1.0, 0, 0]]), c=[0.5],
                 D=sp.csr_array(random.normal(size=(7, 3))), d=random.normal(size=7), mu=[0.5, 0.5],
                 key=np.array([-1, 10, 11, 12, 20, 21, 22, 30]))


def test_the_frictionless_problem_of_a_folder(contacts):
    found = mlcp.read_folder(contacts)
    np.testing.assert_array_equal(found.file_rows, [0, 1, 4, 7])
    assert found.file_row_count == 8
    problem = found.problem
    np.testing.assert_array_equal(problem.keys, [0, 11, 21, 31])
    np.testing.assert_array_equal(problem.lo, [-np.inf, 0, 0, 0])
    assert problem.r[0] == -0.5
    jacobian = scipy.io.mmread(contacts / "D.mtx").toarray()
    np.testing.assert_array_equal(problem.jacobian().toarray()[1:], jacobian[[0, 3, 6]])
    np.testing.assert_array_equal(found.in_files(np.array([1.0, 2, 3, 4])), [1, 2, 0, 0, 3, 0, 0, 4])
    result = mlcp.Solver().solve(problem)
    assert result.solved and max(natural_residual(problem, result)) < 1e-12
    for other in (mlcp.Problem.from_folder(contacts), mlcp.Problem.from_file(str(contacts))):
        assert other.to_bytes() == problem.to_bytes()


def test_a_folder_with_its_friction(contacts):
    found = mlcp.read_folder(contacts, friction="coulomb")
    np.testing.assert_array_equal(found.file_rows, np.arange(8))
    told = found.problem.contacts
    np.testing.assert_array_equal(told.row, [1, 4])
    np.testing.assert_array_equal(told.dimension, [3, 3])
    np.testing.assert_array_equal(told.mu, [0.5, 0.5])
    assert told.model == ["coulomb"] * 2 and mlcp.Problem.from_folder(contacts, friction="box").contacts.model == ["box"] * 2
    none = mlcp.Solver().solve(mlcp.Problem.from_folder(contacts, friction="none"))
    frictionless = mlcp.Solver().solve(mlcp.Problem.from_folder(contacts))
    np.testing.assert_allclose(none.v, frictionless.v, atol=1e-12)
    with pytest.raises(mlcp.ArgumentError, match="sticky"):
        mlcp.read_folder(contacts, friction="sticky")


def test_compressed_files_and_reduced_problems(tmp_path):
    folder = write(tmp_path / "lcp", {"form": "reduced", "nC": 1}, A=sp.csr_array([[2.0, 1], [1, 2]]), b=[-5.0, -6])
    (folder / "A.mtx.gz").write_bytes(gzip.compress((folder / "A.mtx").read_bytes()))
    (folder / "A.mtx").unlink()
    problem = mlcp.Problem.from_folder(folder)
    np.testing.assert_array_equal(problem.lo, [-np.inf, 0])
    np.testing.assert_allclose(mlcp.Solver().solve(problem).gamma, [4 / 3, 7 / 3])


def test_damaged_folders_are_refused_by_name(contacts, tmp_path):
    def refused(error, text, **changes):
        folder = tmp_path / "damaged"
        for path in contacts.iterdir():
            folder.mkdir(exist_ok=True)
            (folder / path.name).write_bytes(path.read_bytes())
        for name, content in changes.items():
            (folder / name.replace("_", ".")).write_text(content) if content is not None else (folder / name.replace("_", ".")).unlink()
        with pytest.raises(error, match=text):
            mlcp.read_folder(folder)

    refused(mlcp.FileError, "meta.json", meta_json=None)
    refused(mlcp.FileError, "M.mtx: no such file", M_mtx=None)
    refused(mlcp.FormatError, "meta.json", meta_json="{")
    refused(mlcp.FormatError, '"form"', meta_json='{"form": "square"}')
    refused(mlcp.FormatError, '"nC" = -1', meta_json='{"form": "global", "nC": -1}')
    refused(mlcp.FormatError, "contacts times dim", meta_json=json.dumps({**meta, "contacts": 9}))
    refused(mlcp.FormatError, "k.mtx: has 1 entries, not 3", k_mtx="%%MatrixMarket matrix array real general\n1 1\n1\n")
    refused(mlcp.FormatError, "D.mtx", D_mtx="nonsense")
    refused(mlcp.FormatError, "C.mtx: is 1 x 2", C_mtx="%%MatrixMarket matrix array real general\n1 2\n1\n1\n")
    refused(mlcp.RangeError, "square", M_mtx="%%MatrixMarket matrix array real general\n2 3\n1\n1\n1\n1\n1\n1\n")
    with pytest.raises(mlcp.FileError):
        mlcp.read_folder(tmp_path / "nowhere")


def test_real_problems_are_solved_by_an_independent_check(shared_problems):
    """Every one but those that are not symmetric, which are refused, and those that no exact method can promise."""
    spec = importlib.util.spec_from_file_location("verify", shared_problems / "verify.py")
    verify = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(verify)
    with open(shared_problems / "INDEX.tsv", newline="") as file:
        listed = [(row["name"], row["symmetry"] == "symmetric") for row in csv.DictReader(file, delimiter="\t")]
    listed += [(f"{folder.name}/000", True) for folder in sorted(shared_problems.glob("sequence_*"))]
    symmetric, problems, folders = [], [], []
    for name, is_symmetric in listed:
        folder = shared_problems / name
        if not is_symmetric:
            with pytest.raises(mlcp.ArgumentError):
                mlcp.read_folder(folder)
            continue
        symmetric.append(name)
        folders.append(mlcp.read_folder(folder))
        problems.append(folders[-1].problem)
    wrong = {}
    for name, found, result in zip(symmetric, folders, mlcp.solve_many(problems)):
        answer = {"v": result.v, "gamma": found.in_files(result.gamma)}
        error = verify.errors(shared_problems / name, answer, "none", None)["largest"]
        about = json.loads((shared_problems / name / "meta.json").read_text())
        may_refuse = name == "mm_cvxqp1m" or about.get("indefinite")  # singular or indefinite mass
        if not (result.solved and error < 1e-12) and not (may_refuse and not result.solved):
            wrong[name] = (result.status, error)
    assert not wrong and len(symmetric) > 0
