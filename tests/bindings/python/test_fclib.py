"""FCLIB files: what is written comes back, with and without joints; the library's own program and the real file agree."""

import os
import shutil
import subprocess

import h5py
import numpy as np
import pytest
import scipy.sparse as sp

import mlcp


def joints_and_contacts(reduced, dimension=3):
    """Two joints, two contacts; in an order that the file does not have."""
    random = np.random.default_rng(3)
    rows = 2 + 2 * dimension
    lo = np.zeros(rows)
    lo[[0, rows - 1]] = -np.inf
    if reduced:
        root = random.normal(size=(rows, rows))
        problem = mlcp.Problem.from_reduced(root @ root.T + np.eye(rows), random.normal(size=rows), lo)
    else:
        root = random.normal(size=(7, 7))
        mass = root @ root.T + np.eye(7)
        problem = mlcp.Problem.from_matrices((mass + mass.T) / 2, random.normal(size=7), random.normal(size=(rows, 7)), random.normal(size=rows), lo)
    problem.declare_contacts([1, 1 + dimension], dimension, mu=[0.5, 0.25])
    return problem


@pytest.mark.parametrize("reduced", [False, True])
@pytest.mark.parametrize("dimension", [2, 3])
def test_what_is_written_comes_back(tmp_path, reduced, dimension):
    problem, path = joints_and_contacts(reduced, dimension), tmp_path / "problem.hdf5"
    problem.to_fclib(path)
    found = mlcp.read_fclib(path, friction="coulomb")
    order = [0, problem.rows - 1, *range(1, problem.rows - 1)]  # of the file: joints first
    again = found.problem
    np.testing.assert_array_equal(again.r, problem.r[order])
    np.testing.assert_array_equal(again.lo, problem.lo[order])
    for matrix in ("mass", "jacobian", "compliance_matrix"):
        expected = getattr(problem, matrix)().toarray()
        if matrix != "mass":
            expected = expected[order][:, order] if matrix == "compliance_matrix" else expected[order]
        np.testing.assert_array_equal(getattr(again, matrix)().toarray(), expected)
    np.testing.assert_array_equal(again.momentum, problem.momentum)
    np.testing.assert_array_equal(again.contacts.row, [2, 2 + dimension])
    np.testing.assert_array_equal(again.contacts.mu, [0.5, 0.25])
    expected = mlcp.Solver(tolerance=1e-10).solve(problem)
    result = mlcp.Solver(tolerance=1e-10).solve(again)
    assert expected.solved and result.solved
    np.testing.assert_allclose(found.in_files(result.gamma), expected.gamma[order], atol=1e-8)
    frictionless = mlcp.read_fclib(path)
    np.testing.assert_array_equal(frictionless.file_rows, [0, 1, 2, 2 + dimension])
    assert mlcp.Problem.from_file(path).to_bytes() == frictionless.problem.to_bytes() == mlcp.Problem.from_fclib(str(path)).to_bytes()
    with pytest.raises(mlcp.FileError, match="problem.hdf5"):
        mlcp.write_fclib(path, problem)


def test_velocities_of_prescribed_bodies_go_into_the_shift(tmp_path):
    problem = mlcp.Problem()
    ball, table = problem.add_bodies([np.eye(3), np.eye(3)])
    problem.set_momentum([0, 0, -1, 0, 0, 0])
    problem.add_contacts([table], [ball], -np.roll(np.eye(3), 1, axis=0)[np.newaxis], np.roll(np.eye(3), 1, axis=0)[np.newaxis], mu=0.5)
    problem.set_prescribed(table, [0.0, 0, 0.25])
    problem.to_fclib(tmp_path / "lift.hdf5")
    again = mlcp.Problem.from_fclib(tmp_path / "lift.hdf5", friction="coulomb")
    assert again.velocities == 3
    expected, result = mlcp.Solver().solve(problem), mlcp.Solver().solve(again)
    np.testing.assert_allclose(result.v, expected.v[:3], atol=1e-12)
    np.testing.assert_allclose(result.v[2], 0.25)


def entries(group, matrix, form):
    compressed = sp.csc_array(matrix) if form == "csc" else sp.csr_array(matrix)
    part = group.create_group("W")
    part["m"], part["n"], part["nzmax"] = matrix.shape[0], matrix.shape[1], compressed.nnz  # single numbers, as other writers have them
    part["nz"] = {"csc": -1, "csr": -2}[form]
    part["p"], part["i"], part["x"] = compressed.indptr.astype(np.int32), compressed.indices.astype(np.int32), compressed.data


@pytest.mark.parametrize("form", ["csc", "csr"])
def test_compressed_columns_and_rows_are_read(tmp_path, form):
    w = np.array([[2.0, 0, 1], [0, 3, 0], [1, 0, 4]])
    with h5py.File(tmp_path / "w.hdf5", "w") as file:
        local = file.create_group("fclib_local")
        entries(local, w, form)
        local["spacedim"] = 3
        local["vectors/q"], local["vectors/mu"] = np.array([-1.0, 0, 0]), np.array([0.5])
    problem = mlcp.Problem.from_fclib(tmp_path / "w.hdf5", friction="convex")
    np.testing.assert_array_equal(problem.compliance_matrix().toarray(), w)
    np.testing.assert_array_equal(problem.r, [1, 0, 0])
    assert problem.contacts.model == ["convex"]


def damage(path, name, value=None):
    with h5py.File(path, "r+") as file:
        del file[name]
        if value is not None:
            file[name] = value


@pytest.mark.parametrize("name, value, text", [
    ("fclib_local", None, "neither a local nor a global"), ("fclib_local", 3.0, "/fclib_local is no group"),
    ("fclib_local/W", None, "W is missing"),
    ("fclib_local/W/x", None, "W/x is missing"), ("fclib_local/W/nz", [1, 2], "nz is not a number"),
    ("fclib_local/W/p", np.full(36, 99, np.int32), "W"), ("fclib_local/W/p", np.zeros(36, np.int32), "comes twice"),
    ("fclib_local/V/m", [7], "V is 7 x 2, not 6 x 2"), ("fclib_local/V/m", [5], "/fclib_local/V: "),
    ("fclib_local/vectors/mu", None, "mu is missing"), ("fclib_local/vectors/mu", [0.5], "mu has 1 entries, not 2"),
    ("fclib_local/vectors/q", [1, 2], "q has dtype int64"), ("fclib_local/spacedim", [4], "6 rows are not contacts of dimension 4")])
def test_damaged_files_are_refused_by_name(tmp_path, name, value, text):
    path = tmp_path / "damaged.hdf5"
    joints_and_contacts(True).to_fclib(path)
    damage(path, name, value)
    with pytest.raises(mlcp.FormatError, match=text) as caught:
        mlcp.read_fclib(path)
    assert "damaged.hdf5" in str(caught.value)


def test_what_is_no_fclib_file_is_refused(tmp_path):
    (tmp_path / "text.hdf5").write_text("nonsense")
    for name in ("text.hdf5", "none.hdf5"):
        with pytest.raises(mlcp.FileError, match=name):
            mlcp.read_fclib(tmp_path / name)
    path = tmp_path / "asymmetric.hdf5"
    joints_and_contacts(True).to_fclib(path)
    with h5py.File(path, "r+") as file:
        file["fclib_local/W/x"][1] = 77.0
    with pytest.raises(mlcp.ArgumentError):
        mlcp.read_fclib(path, friction="coulomb")


def test_what_the_form_cannot_hold_is_not_written(tmp_path):
    contacts = joints_and_contacts(False)
    box, soft, plain, plane, none = (contacts.copy() for _ in range(5))
    box.set_friction(model="box", bound=1.0)
    soft.set_compliance([0.5])
    plain.add_row([0], [1.0], lo=-1.0, hi=1.0)
    plane.add_contacts(jacobian_b=np.ones((1, 2, 7)), body_b=plane.bodies)
    none.clear_rows()
    limit = contacts.copy()
    limit.add_row([0], [1.0])
    for problem, text in ((box, "fixed bounds of contact 0"), (soft, "compliance"), (plain, "row 8"), (plane, "in the plane and in space"),
                          (none, "no plain unilateral rows"), (limit, "no plain unilateral rows")):
        with pytest.raises(mlcp.UnsupportedError, match=text):
            problem.to_fclib(tmp_path / "never.hdf5")
    assert not (tmp_path / "never.hdf5").exists()


def numbers(problem):
    return (*(getattr(problem, name)().toarray() for name in ("mass", "jacobian", "compliance_matrix")),
            problem.momentum, problem.r, problem.lo, problem.contacts.row, problem.contacts.mu)


@pytest.fixture
def program():
    """The library's own, built with FCLIB."""
    path = os.environ.get("MLCP_PROGRAM") or shutil.which("mlcp")
    if path is None:
        pytest.skip("no program mlcp that was built with FCLIB; MLCP_PROGRAM names one")
    return path


def test_the_program_reads_what_python_writes_and_writes_what_python_reads(tmp_path, program):
    for reduced in (False, True):
        path = tmp_path / f"python_{reduced}.hdf5"
        joints_and_contacts(reduced).to_fclib(path)
        subprocess.run([program, "convert", path, tmp_path / f"{reduced}.mlcp"], check=True)
        subprocess.run([program, "convert", tmp_path / f"{reduced}.mlcp", tmp_path / f"program_{reduced}.hdf5"], check=True)
        mine = mlcp.Problem.from_fclib(path, friction="coulomb")
        for other in (mlcp.Problem.from_file(tmp_path / f"{reduced}.mlcp"),
                      mlcp.Problem.from_fclib(tmp_path / f"program_{reduced}.hdf5", friction="coulomb")):
            for a, b in zip(numbers(mine), numbers(other)):
                np.testing.assert_array_equal(a, b)


def test_the_real_file_is_solved_and_comes_back(shared_problems, tmp_path):
    path = shared_problems / "fclib_local_problem.hdf5"
    found = mlcp.read_fclib(path, friction="coulomb")
    assert found.problem.contact_count == 48 and found.file_row_count == 144
    result = mlcp.Solver(tolerance=1e-8).solve(found.problem)
    assert result.solved and result.errors.cone < 1e-8
    found.problem.to_fclib(tmp_path / "copy.hdf5")
    again = mlcp.read_fclib(tmp_path / "copy.hdf5", friction="coulomb").problem
    np.testing.assert_array_equal(mlcp.Solver(tolerance=1e-8).solve(again).gamma, result.gamma)


def test_the_real_file_is_to_python_what_it_is_to_the_program(shared_problems, tmp_path, program):
    path = shared_problems / "fclib_local_problem.hdf5"
    subprocess.run([program, "convert", path, tmp_path / "real.mlcp"], check=True)
    for a, b in zip(numbers(mlcp.Problem.from_file(tmp_path / "real.mlcp")), numbers(mlcp.Problem.from_fclib(path, friction="coulomb"))):
        np.testing.assert_array_equal(a, b)
