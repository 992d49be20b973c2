"""A small sweep on a cluster of two processes on loopback: the same bits as in this process."""

import csv
import subprocess
import sys

import dask.distributed as dd
import pytest
import sweep

chosen = sweep.designs(friction=[0.0, 0.2], clearance=[0.014, 0.016])


@pytest.fixture(scope="module")
def client():
    with dd.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster, dd.Client(cluster) as client:
        yield client


def test_outcomes_are_the_same_bits_wherever_they_ran(client):
    there = sweep.sweep(client, chosen, steps=12)
    here = [sweep.simulate(design, steps=12) for design in chosen]
    assert [outcome.design for outcome in there] == chosen
    for a, b in zip(there, here):
        assert a[:-1] == b[:-1]
        assert a.hardest[0].to_bytes() == b.hardest[0].to_bytes()
    assert all(outcome.unsolved == 0 and outcome.error < 1e-9 for outcome in there)
    assert len({outcome.digest for outcome in there}) == len(chosen)


def test_problems_and_solvers_cross_the_border(client):
    outcomes = [sweep.simulate(design, steps=8) for design in chosen[:2]]
    there = sweep.least_norm(client, outcomes)
    solver = sweep.mlcp.Solver(impulses="least_norm")
    assert there == [abs(solver.solve(*outcome.hardest).gamma).max() for outcome in outcomes]


def test_the_program_on_a_cluster_that_runs_already(client, tmp_path, capsys):
    arguments = ["--scheduler", client.scheduler.address, "--friction", "0.1", "--clearance", "0.016", "--part-mass", "0.7", "2", "--steps", "5",
                 "--csv", str(tmp_path / "sweep.csv")]
    assert sweep.main(arguments) == 0
    assert "2 designs on 2 workers" in capsys.readouterr().out
    with open(tmp_path / "sweep.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["part_mass"]) for row in rows] == [0.7, 2.0] and all(len(row["digest"]) == 64 for row in rows)


def test_the_program_as_the_readme_calls_it(tmp_path):
    """As a program the module is __main__, which no worker has."""
    table = tmp_path / "sweep.csv"
    done = subprocess.run([sys.executable, sweep.__file__, "--friction", "0.2", "--clearance", "0.016", "--part-mass", "0.7", "2.0", "--steps", "5",
                           "--workers", "1", "--csv", str(table)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert len(table.read_text().splitlines()) == 3
