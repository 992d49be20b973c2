"""Contacts with friction, which impulses are chosen, threads."""

import copy
import pickle

import numpy as np
import pytest

import mlcp
from mlcp import ContactState

gravity, step, slope_mu = 9.81, 0.01, 0.5


def block_on_a_slope(angle, model="coulomb", **given):
    """A block of 2 kg, without rotation, on a slope of this angle, in axes along and across it; one contact in space."""
    problem = mlcp.Problem()
    (body,) = problem.add_bodies(2.0 * np.eye(3))
    weight = 2.0 * gravity * step
    problem.set_momentum([weight * np.sin(angle), 0, -weight * np.cos(angle)])
    rows = problem.add_contacts(body_b=[body], jacobian_b=[[[0, 0, 1], [1, 0, 0], [0, 1, 0]]], mu=slope_mu, model=model, keys=[7], **given)
    assert rows == range(3)
    return problem


def test_a_block_on_a_gentle_slope_sticks():
    angle = np.arctan(0.9 * slope_mu)
    result = mlcp.Solver().solve(block_on_a_slope(angle))
    assert result.solved and list(result.contact_states) == [ContactState.STICKING]
    np.testing.assert_allclose(result.v, 0, atol=1e-12)
    weight = 2.0 * gravity * step
    np.testing.assert_allclose(result.gamma, [weight * np.cos(angle), -weight * np.sin(angle), 0], atol=1e-12)
    assert (result.counts.contacts_sticking, result.counts.contacts_sliding, result.counts.contacts_open) == (1, 0, 0)


def test_a_block_on_a_steep_slope_slides_by_coulombs_law():
    angle = np.arctan(2 * slope_mu)
    result = mlcp.Solver().solve(block_on_a_slope(angle))
    assert result.solved and list(result.contact_states) == [ContactState.SLIDING]
    speed = gravity * step * (np.sin(angle) - slope_mu * np.cos(angle))
    np.testing.assert_allclose(result.v, [speed, 0, 0], atol=1e-9)
    assert np.hypot(*result.gamma[1:]) == pytest.approx(slope_mu * result.gamma[0], rel=1e-8)
    assert result.errors.cone <= 1e-9 and result.errors.worst_contact == 0 and result.counts.contacts_sliding == 1
    assert result.contact_facets.shape == (1,) and result.contact_facets[0] == result.counts.facets > 0


def test_models_differ_as_they_should():
    angle = np.arctan(2 * slope_mu)
    normal, along = gravity * step * np.cos(angle), gravity * step * np.sin(angle)
    v = {model: mlcp.Solver().solve(block_on_a_slope(angle, model, bound=0.02)).v for model in ("none", "convex", "box", "findex")}
    np.testing.assert_allclose(v["none"], [along, 0, 0], atol=1e-12)
    np.testing.assert_allclose(v["box"], [along - 0.02 / 2, 0, 0], atol=1e-12)
    np.testing.assert_allclose(v["findex"], [along - slope_mu * normal, 0, 0], atol=1e-12)
    assert v["convex"][2] == pytest.approx(slope_mu * v["convex"][0], rel=1e-8)  # it opens by μ times the slip


def test_a_contact_that_leaves_is_open():
    problem = block_on_a_slope(0.0)
    problem.set_momentum([0, 0, 1.0])
    assert list(mlcp.Solver().solve(problem).contact_states) == [ContactState.OPEN]
    off = mlcp.Mask(3)
    off[0] = mlcp.RowState.DISABLED
    assert list(mlcp.Solver().solve(problem, enabled=off).contact_states) == [ContactState.DISABLED]


def test_contacts_are_told_and_changed():
    problem = block_on_a_slope(np.arctan(2 * slope_mu), facets=8)
    contacts = problem.contacts
    assert (contacts.row, contacts.dimension, contacts.model, contacts.mu, contacts.facets) == ([0], [3], ["coulomb"], [slope_mu], [8])
    np.testing.assert_array_equal(problem.keys, [7, 7, 7])
    problem.set_friction(mu=4 * slope_mu, model=["convex"], facets=0)
    assert (problem.contacts.model, problem.contacts.mu, problem.contacts.facets) == (["convex"], [4 * slope_mu], [0])
    assert list(mlcp.Solver().solve(problem).contact_states) == [ContactState.STICKING]
    for twin in (problem.copy(), pickle.loads(pickle.dumps(problem)), copy.deepcopy(problem)):
        assert twin.contact_count == 1 and twin.contacts.model == ["convex"] and twin.contacts.mu == [4 * slope_mu]


def test_contacts_in_the_plane_between_bodies_inside_a_wider_array():
    problem = mlcp.Problem()
    a, b = problem.add_bodies(np.stack([np.eye(2), 3 * np.eye(2)]))
    problem.set_momentum([0, 0, 0.3, -3.0])
    wide = np.zeros((2, 2, 5))
    flat = np.zeros((2, 11))
    view = flat[:, :4].reshape(2, 2, 2)
    view[:] = np.array([[0, 1.0], [1, 0]])
    blocks = {"body_a": [-1, a], "body_b": [a, b], "jacobian_a": -np.ascontiguousarray(view), "mu": [1.0, 0.2]}
    first = problem.copy()
    assert problem.add_contacts(jacobian_b=view, **blocks) == range(4)
    wide[..., :2] = view
    first.add_contacts(jacobian_b=wide[..., :2], **blocks)
    assert first.to_bytes() == problem.to_bytes()
    result = mlcp.Solver().solve(problem)
    assert result.solved and list(result.contact_states) == [ContactState.STICKING, ContactState.STICKING]
    np.testing.assert_allclose(result.v, 0, atol=1e-12)  # 0.3 N·s along, less than 0.2 of 3 N·s


def test_a_reduced_problem_declares_its_contacts():
    delassus = np.eye(3) / 2
    problem = mlcp.Problem.from_reduced(delassus, [-1.0, 3.0, 0.0])
    problem.declare_contacts([0], 3, mu=0.5)
    result = mlcp.Solver().solve(problem)
    assert result.solved and list(result.contact_states) == [ContactState.SLIDING]
    np.testing.assert_allclose(result.gamma, [2, -1, 0], atol=1e-8)


def test_findex_follows_the_normal():
    problem = mlcp.Problem.from_matrices(np.eye(2), [3.0, -2.0], [[0, 1], [1, 0]], lo=[0, -0.5], hi=[np.inf, 0.5])
    np.testing.assert_array_equal(problem.findex, [-1, -1])
    problem.set_findex([0], first=1)
    np.testing.assert_array_equal(problem.findex, [-1, 0])
    result = mlcp.Solver().solve(problem)
    np.testing.assert_allclose(result.gamma, [2, -1], atol=1e-12)
    with pytest.raises(mlcp.RangeError, match="findex"):
        problem.set_findex([1], first=1)


@pytest.mark.parametrize("change, error, text", [
    ({"model": "sticky"}, mlcp.ArgumentError, "model = 'sticky'"), ({"model": ["box", "no"]}, mlcp.ArgumentError, r"model\[1\]"),
    ({"mu": -1.0}, mlcp.ArgumentError, "mu"), ({"mu": [1.0, 2.0]}, mlcp.RangeError, "mu has shape"), ({"facets": 2}, mlcp.ArgumentError, "facets"),
    ({"r": [1.0]}, mlcp.RangeError, "r has shape"), ({"bound": -1.0, "model": "box"}, mlcp.ArgumentError, "bound"),
    ({"jacobian_b": np.zeros((1, 3))}, mlcp.RangeError, "count, dimension, d"), ({"jacobian_b": np.zeros((1, 3, 4))}, mlcp.RangeError, "3 velocities"),
    ({"jacobian_b": np.zeros((1, 4, 3))}, mlcp.Error, "dimension"), ({"jacobian_a": np.zeros((1, 3, 3))}, mlcp.ArgumentError, "body_a"),
    ({"keys": [-1]}, mlcp.ArgumentError, "keys")])
def test_bad_contacts_are_refused_by_name(change, error, text):
    problem = mlcp.Problem()
    problem.add_bodies(np.eye(3))
    with pytest.raises(error, match=text):
        problem.add_contacts(**{"body_b": [0], "jacobian_b": np.eye(3)[np.newaxis], **change})
    assert problem.rows == 0 and problem.contact_count == 0


def test_results_with_contacts_pickle_and_start_the_next_solve():
    problem = block_on_a_slope(np.arctan(2 * slope_mu))
    result = mlcp.Solver().solve(problem)
    other = pickle.loads(pickle.dumps(result))
    np.testing.assert_array_equal(other.contact_states, result.contact_states)
    np.testing.assert_array_equal(other.contact_facets, result.contact_facets)
    assert (other.errors, other.counts) == (result.errors, result.counts)
    assert other.mask == result.mask
    again = mlcp.Solver().solve(problem, other.mask)
    assert again.solved and again.counts.warm
    np.testing.assert_allclose(again.v, result.v, atol=1e-9)


def test_masks_carry_impulses():
    problem = block_on_a_slope(0.1, "none")
    mask = mlcp.Mask(3)
    assert mask.impulses is None
    mask.impulses = [1.0, 2.0, 3.0]
    np.testing.assert_array_equal(mask.impulses, [1, 2, 3])
    mask.take_keys(problem)
    np.testing.assert_array_equal(mlcp.Mask.carry(problem, mask).impulses, [1, 2, 3])
    with pytest.raises(mlcp.RangeError, match="impulses"):
        mask.impulses = [1.0]
    with pytest.raises(mlcp.ArgumentError, match="impulses"):
        mask.impulses = [1.0, np.nan, 0.0]
    result = mlcp.Solver().solve(problem)
    np.testing.assert_array_equal(result.mask.impulses, result.gamma)


def table():
    """A table on four legs: three rows would carry it, the fourth leaves a choice."""
    problem = mlcp.Problem()
    problem.add_bodies(np.diag([4.0, 1.0, 1.0]))  # up, and two rotations
    problem.set_momentum([-4.0, 0, 0])
    problem.add_rows(body_b=[0] * 4, jacobian_b=[[1, x, y] for x in (-1, 1) for y in (-1, 1)])
    return problem


@pytest.mark.parametrize("method", ["auto", "newton"])
def test_least_norm_gives_the_legs_of_a_table_equal_loads(method):
    result = mlcp.Solver(method=method, impulses="least_norm").solve(table())
    assert result.solved and result.counts.redundant_rows == 1
    np.testing.assert_allclose(result.gamma, 1.0, atol=1e-10)
    assert mlcp.Solver(method=method).solve(table()).gamma.sum() == pytest.approx(4.0)


def test_threads_give_the_same_bits():
    scene = mlcp.Scene("pile", 60, seed=3)
    scene.prepare()
    pile = scene.problem
    many = mlcp.Problem()
    for _ in range(8):
        body = many.add_sparse_body(pile.mass())
        many.set_momentum(pile.momentum * (1 + 0.01 * body), first=many.body_slice(body).start)
        matrix = pile.jacobian().tocoo()
        for row in range(pile.rows):
            at = matrix.row == row
            many.add_row(matrix.col[at] + many.body_slice(body).start, matrix.data[at], pile.r[row])
    alone = mlcp.Solver(num_threads=1).solve(many)
    assert alone.solved and alone.counts.islands > 4
    for threads in (2, 4, 0):
        together = mlcp.Solver(num_threads=threads).solve(many)
        for name in ("v", "gamma", "w"):
            np.testing.assert_array_equal(getattr(together, name), getattr(alone, name))


def test_exact_methods_agree_to_the_bit_when_canonical_and_gauss_seidel_within_its_tolerance():
    scene = mlcp.Scene("pile", 20, seed=2)
    scene.prepare()
    problem = scene.problem
    simplex, newton = (mlcp.Solver(method=method, canonical=True).solve(problem) for method in ("simplex", "newton"))
    assert (simplex.method, newton.method) == ("simplex", "newton")
    np.testing.assert_array_equal(simplex.v, newton.v)
    problem.set_momentum(np.random.default_rng(1).normal(size=problem.velocities))
    exact = mlcp.Solver().solve(problem)
    rough = mlcp.Solver(method="pgs", tolerance=1e-6, max_iterations=20000).solve(problem)
    assert rough.solved and rough.method == "pgs" and rough.errors.largest > exact.errors.largest
    np.testing.assert_allclose(rough.v, exact.v, atol=1e-3 * np.abs(exact.v).max())


def test_keys_start_the_next_solve_unless_told_not_to():
    scene = mlcp.Scene("pile", 20)
    scene.prepare()
    problem = scene.problem
    assert problem.keys.all()
    for warm_start in (True, False):
        solver = mlcp.Solver(warm_start=warm_start)
        assert not solver.solve(problem).counts.warm
        assert solver.solve(problem).counts.warm == warm_start
