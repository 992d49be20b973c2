"""What happens to the caller's arrays: which are read in place, which are copied, which refused; nothing is written to."""

import gc
import sys
import tracemalloc

import numpy as np
import pytest
import scipy.sparse as sp
from conftest import ball_and_joint

import mlcp


def locked(array):
    array = np.array(array)
    array.flags.writeable = False
    return array


def test_read_only_arrays_are_accepted():
    problem = mlcp.Problem()
    problem.add_bodies(locked(np.eye(2)[np.newaxis]))
    problem.set_momentum(locked([1.0, 2.0]))
    jacobian = sp.csr_array(np.eye(2))
    for part in (jacobian.data, jacobian.indices, jacobian.indptr):
        part.flags.writeable = False
    problem.add_matrix_rows(jacobian, locked([0.0, 0.0]), keys=locked(np.array([1, 2], np.uint64)))
    problem.add_rows(locked(np.array([0], np.int32)), None, locked([[1.0, 2.0]]))
    mask = mlcp.Mask(locked(np.array([1, 2, 3], np.uint8)))
    assert mlcp.Solver().solve(problem, mask).solved


def unsorted_csr():
    matrix = sp.csr_array((np.array([1.0, 2, 3, 4, 5]), np.array([2, 0, 1, 2, 0]), np.array([0, 2, 4, 5])), shape=(3, 3))
    assert not matrix.has_sorted_indices
    return matrix


@pytest.mark.parametrize("index", [np.int32, np.int64])
def test_nothing_of_the_caller_is_sorted_or_changed(index):
    matrix = unsorted_csr()
    matrix.indices, matrix.indptr = matrix.indices.astype(index), matrix.indptr.astype(index)
    before = [part.copy() for part in (matrix.data, matrix.indices, matrix.indptr)]
    problem = mlcp.Problem.from_matrices(np.eye(3), 0.0, matrix)
    np.testing.assert_array_equal(problem.jacobian().toarray(), matrix.toarray())
    for part, old in zip((matrix.data, matrix.indices, matrix.indptr), before):
        assert part.dtype == old.dtype
        np.testing.assert_array_equal(part, old)


def test_wide_indices_are_copied_when_they_fit_and_refused_when_not():
    problem = ball_and_joint()
    assert problem.add_row(np.array([0, 1], np.int64), [1, 1]) == 2
    assert problem.add_row(np.array([0, 1], np.uint16), [1, 1]) == 3
    with pytest.raises(mlcp.RangeError, match=r"columns\[1\] = 4294967296 does not fit into 32 bits"):
        problem.add_row(np.array([0, 2**32], np.int64), [1, 1])
    matrix = sp.csr_array(np.eye(2))
    matrix.indices = np.array([0, 2**32 + 1], np.int64)
    with pytest.raises(mlcp.RangeError, match=r"jacobian.indices\[1\]"):
        problem.add_matrix_rows(matrix)


def test_indptr_beyond_the_entries_is_refused():
    matrix = sp.csr_array(np.eye(2))
    matrix.indptr = np.array([0, 1, 5], np.int32)
    with pytest.raises(mlcp.RangeError, match="ends with 5"):
        ball_and_joint().add_matrix_rows(matrix)


def test_duplicate_entries_are_refused_not_summed():
    matrix = sp.csr_array((np.ones(2), np.array([0, 0]), np.array([0, 2])), shape=(1, 2))
    with pytest.raises(mlcp.ArgumentError, match="column"):
        ball_and_joint().add_matrix_rows(matrix)


@pytest.mark.parametrize("values", [np.array([1, 2]), np.array([1, 2], np.float32), [True, False], np.array([1.0, 2], ">f8"),
                                    np.arange(4.0)[::2], np.arange(2.0)[::-1], np.frombuffer(b"\0" * 17, np.uint8)[1:].view("f8")])
def test_other_dtypes_and_layouts_are_copied(values):
    problem = ball_and_joint()
    problem.set_momentum(values)
    np.testing.assert_array_equal(problem.momentum, np.asarray(values, float))


def test_jacobian_rows_are_read_wherever_they_lie():
    wide = np.arange(40.0).reshape(4, 10)
    for view in (wide[:, 2:4], wide[::2, 2:4], wide[::-1, 2:4], wide[:, 2:6:2], np.asfortranarray(wide)[:, 2:4],
                 np.broadcast_to([1.0, 2.0], (4, 2)), wide[:, 2:4].astype(np.float32), wide[:, 2:4].astype(int)):
        problem = mlcp.Problem()
        problem.add_bodies([np.eye(2)])
        problem.add_rows(0, None, view)
        np.testing.assert_array_equal(problem.jacobian().toarray(), view)


def allocated(call):
    """The most bytes that NumPy held at a time during a call."""
    gc.collect()
    tracemalloc.start()
    try:
        call()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_arrays_that_match_are_not_copied():
    n = 200_000
    problem = mlcp.Problem.from_matrices(sp.identity(n, format="csc"), 0.0)
    jacobian = sp.csr_array(sp.identity(n, format="csr"))
    lo, r, keys = np.zeros(n), np.zeros(n), np.zeros(n, np.uint64)
    assert jacobian.indices.dtype == np.int32
    assert allocated(lambda: problem.set_momentum(lo)) < 20_000
    assert allocated(lambda: problem.add_matrix_rows(jacobian, r, lo, lo, compliance=lo, keys=keys)) < 20_000
    assert allocated(lambda: problem.set_r(r)) < 20_000
    problem.clear_rows()
    blocks = np.zeros((n, 3))
    other = mlcp.Problem()
    ids = other.add_bodies(np.broadcast_to(np.eye(2), (n, 2, 2)))
    assert allocated(lambda: other.add_rows(ids, None, blocks[:, :2], r=r, lo=lo, hi=lo, compliance=lo, keys=keys)) < 20_000
    # and a copy is seen, so that the figures above mean something
    assert allocated(lambda: problem.set_momentum(lo.astype(np.float32))) > 8 * n


def test_matrices_are_lent_without_a_copy():
    problem = ball_and_joint()
    for lend in (problem.jacobian, problem.mass, problem.compliance_matrix):
        lent, again = lend(copy=False), lend(copy=False)
        if lent.nnz:
            assert lent.data.__array_interface__["data"] == again.data.__array_interface__["data"]
            assert not lent.data.flags.writeable and not lent.indices.flags.writeable
        assert lend().data.flags.writeable


def test_what_is_lent_keeps_its_owner_alive():
    problem = ball_and_joint()
    jacobian = problem.jacobian(copy=False)
    states = mlcp.Mask(np.full(1000, 2, np.uint8)).states
    del problem
    gc.collect()
    filler = [ball_and_joint() for _ in range(100)]  # would take the memory, if it were free
    np.testing.assert_array_equal(jacobian.toarray(), np.eye(2))
    assert (states == 2).all() and len(filler) == 100


def test_what_is_lent_holds_its_owner_still():
    problem = ball_and_joint()
    jacobian = problem.jacobian(copy=False)
    for edit in (problem.clear_rows, problem.trim, lambda: problem.set_r(0), lambda: problem.add_row([0], [1])):
        with pytest.raises(BufferError, match="arrays look into its memory"):
            edit()
    values = jacobian.data  # the last one that looks
    del jacobian
    with pytest.raises(BufferError):
        problem.clear_rows()
    del values
    problem.clear_rows()
    mask = mlcp.Mask(3)
    states = mask.states
    mask[1] = 2
    np.testing.assert_array_equal(states, [1, 2, 1])
    with pytest.raises(BufferError):
        mask.resize(5)
    with pytest.raises(ValueError):
        states[0] = 1


def test_results_outlive_problem_and_solver_and_stay_as_they_are():
    problem, solver = ball_and_joint(), mlcp.Solver()
    first = solver.solve(problem)
    v, gamma = first.v.copy(), first.gamma.copy()
    problem.set_momentum([1, 1])
    second = solver.solve(problem)
    assert not np.array_equal(second.v, v)
    del problem, solver
    gc.collect()
    np.testing.assert_array_equal(first.v, v)
    np.testing.assert_array_equal(first.gamma, gamma)
    assert sys.getrefcount(first.v) <= 3
