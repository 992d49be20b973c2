"""The package itself: names, docstrings, what it says of itself."""

import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import repository

import mlcp
import mlcp.plot


def public():
    for module in (mlcp, mlcp.plot):
        for name in module.__all__:
            yield name, getattr(module, name)


def test_every_public_thing_is_documented():
    missing = []
    for name, thing in public():
        if name == "__version__" or isinstance(thing, dict):
            continue
        if not inspect.getdoc(thing):
            missing.append(name)
        if inspect.isclass(thing) and thing.__module__.startswith("mlcp"):
            missing += [f"{name}.{member}" for member, value in vars(thing).items()
                        if not member.startswith("_") and (callable(value) or isinstance(value, (property, classmethod)))
                        and not inspect.getdoc(getattr(thing, member))]
    assert not missing


def test_docstrings_name_every_parameter():
    wrong = []
    for name, thing in public():
        if inspect.isfunction(thing):
            text = inspect.getdoc(thing)
            wrong += [f"{name}({parameter})" for parameter in inspect.signature(thing).parameters
                      if not re.search(rf"(^|[ ,*]){parameter}\b", text, re.MULTILINE)]
    assert not wrong


def test_the_version_is_that_of_the_library():
    assert mlcp.__version__ == (repository / "VERSION").read_text().strip()


def test_matplotlib_is_needed_for_pictures_alone():
    script = "import sys, mlcp, mlcp.demo; assert 'matplotlib' not in sys.modules"
    subprocess.run([sys.executable, "-c", script], check=True)


def test_code_of_users_is_type_checked(tmp_path):
    """The stubs accept what is right and refuse what is wrong."""
    pytest.importorskip("mypy")
    program = tmp_path / "program.py"
    program.write_text(
        "import mlcp\n"
        "import numpy as np\n"
        "z: np.ndarray = mlcp.solve_lcp(np.eye(2), [1, 2])\n"
        "r: mlcp.Result = mlcp.solve_lcp(np.eye(2), [1, 2], full_output=True, tolerance=1e-8)\n"
        "solver = mlcp.Solver(method='simplex', progress=lambda p: p.seconds > 1)\n"
        "c: int = solver.solve(mlcp.Problem(), start=mlcp.Mask(3)).counts.pivots\n"
        "mlcp.Solver(method='magic')\n"
        "mlcp.Solver(speed=1)\n"
        "q: float = r.errors.worst\n")
    done = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", str(tmp_path / "cache"), "--config-file",
                           str(repository / "bindings" / "python" / "pyproject.toml"), str(program)], capture_output=True, text=True,
                          cwd=tmp_path)
    lines = sorted({int(line) for line in re.findall(r"program.py:(\d+): error", done.stdout)})
    assert lines == [7, 8, 9], done.stdout


def test_the_walkthrough_runs_from_top_to_bottom(tmp_path):
    done = subprocess.run([sys.executable, str(repository / "examples" / "python" / "walkthrough.py")], cwd=tmp_path, capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    assert "stands" in done.stdout and (tmp_path / "walkthrough.png").exists()


def test_the_readme_shows_what_it_says():
    text = Path(repository / "bindings" / "python" / "README.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    names = {}
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)
