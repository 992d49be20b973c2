#!/usr/bin/env python3
"""Whether the benchmark measures what it says, on tiny problems and without a look at the clock. Peers take part where they are installed.

    harness_test.py BUILD     BUILD: where mlcp_bench_all was built. Ends with "N passed, N failed". Needs numpy and scipy.
"""
import os
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
import scipy.sparse as sp

sys.path.insert(0, str(Path(__file__).parent))
from compare import candidates, families, figures, library, rounds, sequences, tables  # noqa: E402
from compare.errors import Measure  # noqa: E402
from compare.peers import Outcome, all_peers, native  # noqa: E402
from compare.problem import Problem  # noqa: E402

build = Path(sys.argv.pop())
native.folder = build / "lib"
LIBRARY = library.Library(native.folder / "libmlcp_bench.so")
BUDGET = rounds.Budget(seconds=0, limit=20, turns=1)


def session(cold):
    """A candidate that does what `cold(problem)` does."""
    class Session:
        def __init__(self, problem):
            self._problem = problem

        def cold(self):
            return cold(self._problem)

        def known(self):
            return None
    return candidates.Candidate("probe", "", "", 0.0, Session)


class Errors(unittest.TestCase):
    def setUp(self):
        # a body of 2 kg on a floor that lets it down at 1 m/s: v = −1, γ = 2 · (−1) − k
        matrices = sp.csc_matrix([[2.0]]), sp.csr_matrix([[1.0]]), sp.csc_matrix((1, 1))
        self.measure = Measure(*matrices, *(np.array([x]) for x in (-3.0, -1.0, 0.0, np.inf)))

    def test_the_solution_has_none(self):
        errors = self.measure.largest(np.array([-1.0]), np.array([1.0]))
        self.assertEqual((errors.strict, errors.normwise), (0, 0))

    def test_momentum_is_relative_to_its_terms(self):
        self.assertAlmostEqual(self.measure.momentum(np.array([-1.0]), np.array([1.1])).strict, 0.1 / 6.1)

    def test_constraints_are_a_median_relative_to_their_terms(self):
        # w = −0.5, a γ = 0.5: neither w nor γ is at home; the scale is |v| + |k/M| + |r|
        self.assertAlmostEqual(self.measure.constraints(np.array([-1.5]), np.array([1.0])).strict, 0.5 / 4)

    def test_what_is_not_finite_is_infinite(self):
        self.assertEqual(self.measure.largest(np.array([np.nan]), np.array([1.0])).normwise, np.inf)


class Forms(unittest.TestCase):
    def test_the_dual_is_J_inverse_M_JT(self):
        for source in (families.scene("wall", 2), families.scene("rope", 5), families.scene("islands", 2)):
            with self.subTest(source.name):
                problem = source.problem(LIBRARY)
                J, inverse = problem.J.toarray(), np.linalg.inv(problem.M.toarray())
                np.testing.assert_allclose(problem.dual.H.toarray(), J @ inverse @ J.T, rtol=1e-10, atol=1e-12)
                np.testing.assert_allclose(problem.dual.g, J @ inverse @ problem.k - problem.r, rtol=1e-10, atol=1e-12)

    def test_a_problem_put_together_from_matrices_is_the_same(self):
        problem = families.scene("rope", 5).problem(LIBRARY)
        copy = LIBRARY.clone(problem)
        self.assertEqual((LIBRARY.matrix(copy, "jacobian") != problem.J).nnz, 0)
        self.assertEqual((LIBRARY.matrix(copy, "mass") != problem.M).nnz, 0)
        LIBRARY.destroy(copy)


class Machines(unittest.TestCase):
    """Steps of scenes with contacts and prescribed bodies, as every solver takes them."""

    def steps(self, scene, size, first, facets, count=1, h=0.01):
        return [Problem(scene, "machine", LIBRARY, handle) for handle in families.Recording(scene, size, first, h=h).steps(LIBRARY, facets, count=count)]

    def test_a_facet_is_the_normal_and_mu_times_its_direction(self):
        normals, = self.steps("wall_of_boxes", 2, 3, 0)
        pyramids, = self.steps("wall_of_boxes", 2, 3, 4)
        self.assertEqual(pyramids.m, 4 * normals.m)
        J, opposite = pyramids.J.toarray().reshape(normals.m, 4, -1), normals.J.toarray()
        for facet in (0, 1):
            np.testing.assert_allclose((J[:, facet] + J[:, facet + 2]) / 2, opposite, atol=1e-15)
        across = np.linalg.norm(J[:, 0] - J[:, 2], axis=1)
        self.assertGreater(across.min(), 0)
        self.assertTrue(np.all(pyramids.lo == 0) and np.all(np.isinf(pyramids.hi)))

    def test_prescribed_bodies_go_into_the_rows(self):
        problem, = self.steps("bottles", 6, 10, 0)  # a shaft turns the wheel
        self.assertEqual(problem.n, 3 * 7)
        row, = rounds.compare(problem, list(candidates.ours(LIBRARY))[:1], BUDGET)
        self.assertTrue(row.reached, row)

    def test_compliant_pyramids_keep_the_compliance_of_their_contacts(self):
        problem, = self.steps("gripper", 3, 60, 4)  # elastic pads
        S = problem.S.toarray()
        np.testing.assert_array_equal(S, S.T)
        self.assertGreater(np.count_nonzero(S - np.diag(np.diag(S))), 0)
        self.assertGreaterEqual(np.linalg.eigvalsh(S).min(), -1e-12 * np.abs(S).max())

    def test_a_pyramid_gives_the_velocities_of_the_scenes_own_law(self):
        # the scene solves convex pyramids of 8 facets as contacts: where a body is in the next step tells its velocity
        before, after = (self.steps("wall_of_boxes", 2, first, families.FACETS)[0] for first in (5, 6))
        run = library.Run(LIBRARY, before.handle, before.n, before.m, 0, 1e-12)
        run.time(library.COLD, 1)
        falls = np.zeros(before.n)
        falls[2::6] = -9.81 * 0.01  # k = M v + h Q, and boxes turn too slowly for gyroscopic terms to matter
        np.testing.assert_allclose(np.linalg.solve(after.M.toarray(), after.k) - falls, run.answer().v, atol=2e-4)

    def test_scenes_beside_each_other_share_nothing(self):
        problem, = (Problem("piles", "machine", LIBRARY, handle) for handle in families.Recording("pile", 4, 0, count=3).steps(LIBRARY, 0, count=1))
        self.assertEqual(problem.n, 3 * 12)
        parts = sp.csgraph.connected_components(abs(problem.M) + abs(problem.J.T @ problem.J), directed=False)[0]
        self.assertGreaterEqual(parts, 3)


class Comparison(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.rows, cls.peers = [], [peer for peer in all_peers() if peer.available()]
        for source in (families.scene("pile", 12), families.scene("rope", 5)):
            problem = source.problem(LIBRARY)
            contestants = list(candidates.ours(LIBRARY))
            for peer in cls.peers:
                contestants += candidates.of_peer(peer, problem)
            cls.rows += rounds.compare(problem, contestants, BUDGET)

    def test_default_settings_solve_and_are_timed(self):
        for group in tables.by_problem(self.rows).values():
            row = tables.default_row(group)
            self.assertTrue(row.reached, row)
            self.assertTrue(row.cold > 0 and row.known > 0, row)

    def test_every_installed_peer_in_double_precision_solves_the_rope(self):
        for peer in self.peers:
            with self.subTest(peer.name):
                best = min(row.normwise for row in self.rows if row.solver == peer.name and row.problem == "rope 5")
                self.assertLess(best, 1e-4 if peer.name == "Bullet Dantzig" else 1e-7)

    def test_csv_reads_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "times.csv"
            tables.write_csv(path, self.rows)
            again = tables.read_csv(path)
        self.assertEqual([str(row) for row in again], [str(row) for row in self.rows])

    def test_tables_name_every_problem_and_solver(self):
        for name in ("pile 12", "rope 5"):
            self.assertIn(name, tables.summary(self.rows))
        for row in self.rows:
            self.assertIn(row.solver, tables.solvers(self.rows))

    def test_figures_say_what_was_left_out(self):
        text = figures.markdown(figures.from_rows(self.rows))
        self.assertIn("left out: humanoids22 was not run", text)
        self.assertIn("left out: no real problems", text)


class FiguresWithoutPeers(unittest.TestCase):
    def test_each_is_measured_or_says_why_not(self):
        measured = list(figures.measured_alone(LIBRARY, LIBRARY, None, quick=True))
        self.assertGreaterEqual(len(measured), 9)
        for figure in measured:
            with self.subTest(figure.name):
                self.assertRegex(figure.measured, r"\d|^left out: \w")
                self.assertNotIn("nan", figure.measured)


class Workers(unittest.TestCase):
    def setUp(self):
        self.problem = families.scene("pile", 12).problem(LIBRARY)

    def row(self, cold, limit=20):
        return next(rounds.compare(self.problem, [session(cold)], rounds.Budget(0, limit, 1)))

    def test_one_that_does_not_end_is_stopped(self):
        self.assertEqual(self.row(lambda problem: time.sleep(1000), limit=0.2).note, "more than 0.2 s")

    def test_one_that_crashes_stops_nothing(self):
        self.assertEqual(self.row(lambda problem: os.abort()).note, "crashed")

    def test_one_that_throws_is_quoted(self):
        def throw(problem):
            raise ValueError("no such thing")
        self.assertEqual(self.row(throw).note, "ValueError: no such thing")

    def test_a_false_claim_of_success_is_wrong(self):
        row = self.row(lambda problem: Outcome(1, 1, True, None, np.zeros(problem.m)))
        self.assertTrue(row.wrong)

    def test_an_honest_failure_is_not(self):
        row = self.row(lambda problem: Outcome(1, 1, False, None, np.zeros(problem.m)))
        self.assertFalse(row.wrong or row.reached)


class Sequences(unittest.TestCase):
    def test_warm_steps_solve_as_cold_ones_do(self):
        steps = families.Recording("pile", 10, 0).steps(LIBRARY, 0, count=4)
        for warm in (True, False):
            _, errors, outcomes, oracle = LIBRARY.sequence(steps, 0, 1e-9, warm, oracle=True)
            self.assertTrue(np.all(outcomes == library.SOLVED))
            self.assertLess(np.max(errors), 1e-9)
            self.assertTrue(np.all(oracle > 0))
        for step in steps:
            LIBRARY.destroy(step)

    def test_the_table_has_a_line_for_every_variant(self):
        recording = families.Recording("gripper", 3, 60, rubs=True)
        measured = sequences.of_recording(LIBRARY, recording, 3)
        self.assertEqual([one.name for one in measured], ["gripper 3", "gripper 3, friction"])
        for one in measured:
            self.assertEqual((one.steps, one.unsolved), (3, 0))
            self.assertLess(one.error, 1e-9)
        self.assertIn("| gripper 3, friction | 3 |", sequences.table(measured))

    def test_candidate_rows_and_allocations_are_measured(self):
        problem = families.scene("pile", 60).problem(LIBRARY)
        self.assertTrue(all(seconds > 0 for seconds in LIBRARY.candidate_rows(problem.handle, 20, True, 2)))
        self.assertGreaterEqual(LIBRARY.allocations(problem.handle), 0)


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    bad = len(result.failures) + len(result.errors)
    print(f"{result.testsRun - bad} passed, {bad} failed")
    sys.exit(bad > 0)
