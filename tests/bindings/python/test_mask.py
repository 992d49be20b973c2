"""Mask: states, keys, carrying over."""

import numpy as np
import pytest
from conftest import ball_and_joint

import mlcp
from mlcp import RowState


def test_made_from_a_length_or_states():
    assert len(mlcp.Mask()) == 0
    np.testing.assert_array_equal(mlcp.Mask(3).states, [1, 1, 1])
    np.testing.assert_array_equal(mlcp.Mask(2, RowState.DISABLED).states, [0, 0])
    mask = mlcp.Mask([RowState.ACTIVE, RowState.AT_UPPER, 0])
    np.testing.assert_array_equal(mask.states, [2, 3, 0])
    np.testing.assert_array_equal(mask.active, [True, False, False])
    np.testing.assert_array_equal(np.asarray(mask), [2, 3, 0])
    assert repr(mask) == "<mlcp.Mask: 3 rows, 1 active, 0 at lower, 1 at upper, 1 disabled>"


def test_items():
    mask = mlcp.Mask(4)
    mask[1] = RowState.ACTIVE
    mask[2:] = [3, 0]
    assert mask[1] is RowState.ACTIVE and mask[-1] is RowState.DISABLED
    np.testing.assert_array_equal(mask[1:3], [2, 3])
    mask[np.array([True, False, False, False])] = 2
    assert mask.count(RowState.ACTIVE) == 2
    assert mask == mlcp.Mask([2, 2, 3, 0]) and mask != mlcp.Mask(4) and mask != "mask"
    mask.resize(5, RowState.AT_UPPER)
    np.testing.assert_array_equal(mask.states, [2, 2, 3, 0, 3])
    with pytest.raises(IndexError):
        mask[7]
    with pytest.raises(TypeError):
        hash(mask)


@pytest.mark.parametrize("bad", [lambda m: mlcp.Mask([4]), lambda m: mlcp.Mask([-1]), lambda m: mlcp.Mask(2, 9), lambda m: mlcp.Mask(-1),
                                 lambda m: mlcp.Mask([[1]]), lambda m: mlcp.Mask([0.5]), lambda m: m.count(4), lambda m: m.resize(-1),
                                 lambda m: m.__setitem__(0, 4), lambda m: m.take_keys(mlcp.Problem())])
def test_bad_input(bad):
    with pytest.raises(mlcp.Error):
        bad(mlcp.Mask(2))


def test_carried_over_by_key():
    problem = ball_and_joint()
    mask = mlcp.Mask([2, 3])
    mask.take_keys(problem)
    problem.clear_rows()
    problem.add_rows(r=np.zeros(3), keys=[6, 77, 5])
    carried = mlcp.Mask.carry(problem, mask, otherwise=RowState.DISABLED)
    np.testing.assert_array_equal(carried.states, [3, 0, 2])
    np.testing.assert_array_equal(mlcp.Mask.carry(problem, mask).states, [3, 1, 2])


def test_copies_are_deep():
    mask = mlcp.Mask([1, 2])
    copy = mask.copy()
    copy[0] = 3
    assert mask[0] == 1 and copy[0] == 3
