"""Pictures: that they show what they say. How they look was looked at by people."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import pile, squeezed

import mlcp
import mlcp.plot
from mlcp import demo


@pytest.fixture(autouse=True)
def close():
    yield
    plt.close("all")


def test_sparsity_has_a_spot_for_every_entry_and_a_color_for_every_island():
    problem = squeezed()
    k, l = mlcp.plot.sparsity(problem)
    # islands: ball 0 with two rows; ball 1 with one
    assert len(k.collections[0].get_offsets()) == 5 + 2 * 3  # diagonal of M and Σ, J twice
    solver = mlcp.Solver()
    solver.analyze(problem)
    assert len(l.collections[0].get_offsets()) == 5 + len(solver.factor().rows)
    assert len(np.unique(l.collections[0].get_facecolors(), axis=0)) == 2
    assert "3 entries" in k.get_title() and k.get_xlabel() == "2 islands"
    figure, axes = plt.subplots(1, 2)
    assert mlcp.plot.sparsity(problem, enabled=mlcp.Mask([1, 0, 1]), axes=axes) is axes
    assert len(axes[0].collections[0].get_offsets()) == 4 + 2 * 2


def test_sparsity_of_cones_is_refused():
    problem = mlcp.Problem()
    (block,) = problem.add_bodies(np.eye(3)[np.newaxis])
    problem.add_contacts(body_b=[block], jacobian_b=[np.eye(3)], mu=0.5)
    with pytest.raises(mlcp.ArgumentError, match="cones"):
        mlcp.plot.sparsity(problem)
    problem.set_friction(model="none")
    assert "2 islands" not in mlcp.plot.sparsity(problem)[0].get_xlabel()


def test_islands_are_stacked_by_state_and_the_small_ones_share_a_bar():
    problem = mlcp.Problem.from_matrices(np.ones((60, 1, 1)), np.where(np.arange(60) % 3, -1.0, 1.0), np.eye(60))
    result = mlcp.Solver().solve(problem)
    axes = mlcp.plot.islands(result)
    heights = {bars.get_label(): [bar.get_height() for bar in bars] for bars in axes.containers}
    assert len(heights["active"]) == 40 and heights["active"][-1] + heights["at lower"][-1] == pytest.approx(1)
    assert "60 islands, 0 not solved" in axes.get_title()
    assert "1 not solved" in mlcp.plot.islands(mlcp.Solver().solve(squeezed())).get_title()


def test_steps_show_warm_and_cold():
    problem = pile(30)
    solver = mlcp.Solver()
    cold, warm = [solver.solve(problem)], [solver.solve(problem)]
    axes = mlcp.plot.steps(warm, cold)
    assert [line.get_label() for line in axes[1].lines] == ["warm", "cold"]
    assert axes[0].lines[0].get_ydata()[0] == problem.rows
    assert axes[1].lines[1].get_ydata()[0] == cold[0].counts.pivots


def test_active_set_ends_as_the_solve_did():
    problem = pile(60)
    result = mlcp.Solver(method="simplex", trace=True).solve(problem)
    (image,) = mlcp.plot.active_set(result).images
    states = image.get_array()
    np.testing.assert_array_equal(states[:, -1], result.mask.states)
    assert (states[:, 0] == mlcp.RowState.AT_LOWER).all() and states.shape[1] == 1 + len(result.trace)
    warm = mlcp.Solver(method="simplex", trace=True).solve(problem, result.mask)
    np.testing.assert_array_equal(mlcp.plot.active_set(warm, result.mask).images[0].get_array()[:, 0], result.mask.states)
    with pytest.raises(mlcp.ArgumentError, match="trace"):
        mlcp.plot.active_set(mlcp.Solver().solve(problem))
    with pytest.raises(mlcp.ArgumentError, match="simplex"):
        mlcp.plot.active_set(mlcp.Solver(method="newton", trace=True).solve(problem))


def test_work_precision_ends_with_the_solution():
    axes = mlcp.plot.work_precision(pile(60), points=4, repeats=1)
    (line,) = axes.lines
    assert line.get_ydata()[-1] < 1e-12 < line.get_ydata()[0] and axes.get_xscale() == axes.get_yscale() == "log"


@pytest.mark.parametrize("name", mlcp.scenes)
def test_every_scene_is_drawn_with_its_forces(name):
    scene = mlcp.Scene(name, 6)
    for _ in range(20):  # until something touches
        scene.step()
    scene.prepare()
    drawing = scene.draw()
    result = scene.finish()
    axes = mlcp.plot.contact_forces(drawing, result.gamma / 0.01)
    strong = np.abs(result.gamma) > 1e-6 * np.abs(result.gamma).max()
    assert len(axes.collections[-1].get_segments()) == strong.sum() > 0
    with pytest.raises(mlcp.ArgumentError, match="forces has shape"):
        mlcp.plot.contact_forces(drawing, np.zeros(len(drawing.points) + 1))


def test_scenes_step_and_refuse():
    scene = mlcp.Scene("tower", 4, tolerance=1e-8)
    with pytest.raises(mlcp.StateError):
        scene.finish()
    assert scene.start is None and scene.name == "tower"
    weight = scene.step().gamma[:4].sum()
    assert weight == pytest.approx(scene.step(0.01).gamma[:4].sum()) and scene.time == pytest.approx(0.02)
    scene.prepare()
    assert mlcp.Solver(method="simplex").solve(scene.problem, scene.start).counts.pivots == 0
    for bad in (lambda: mlcp.Scene("moon"), lambda: mlcp.Scene("pile", 0), lambda: mlcp.Scene("pile", 2**40),
                lambda: mlcp.Scene("pile", method="magic")):
        with pytest.raises(ValueError):
            bad()


def test_demo_writes_a_film_and_a_picture(tmp_path, capsys):
    film, picture = tmp_path / "film.gif", tmp_path / "picture.png"
    assert demo.main(["rope", "--size", "10", "--steps", "3", "--output", str(film)]) == 0
    assert film.read_bytes()[:6] == b"GIF89a"
    assert demo.main(["pile", "--size", "5", "--steps", "2", "--picture", str(picture)]) == 0
    assert picture.read_bytes()[:4] == b"\x89PNG"
    out = capsys.readouterr().out
    assert "solved" in out and f"wrote {film}" in out
    with pytest.raises(SystemExit):
        demo.main(["moon"])
    assert demo.main(["pile", "--size", "0"]) == 2 and "size = 0" in capsys.readouterr().err
    assert demo.main(["pile", "--steps", "1", "--output", str(tmp_path / "no" / "folder.gif")]) == 2
