"""What is written: every time as CSV, and Markdown tables for people."""
import csv
from dataclasses import asdict, fields

import numpy as np

from .candidates import OURS
from .rounds import Row


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(Row)] + ["wrong"])
        writer.writeheader()
        for row in rows:
            writer.writerow(asdict(row) | {"wrong": row.wrong})


def read_csv(path):
    """Rows as they were written."""
    types = {field.name: field.type for field in fields(Row)}
    read = {str: str, float: float, int: int, bool: lambda text: text == "True"}
    with open(path, newline="") as file:
        return [Row(**{name: read[types[name]](text) for name, text in line.items() if name in types}) for line in csv.DictReader(file)]


def by_problem(rows):
    groups = {}
    for row in rows:
        groups.setdefault(row.problem, []).append(row)
    return groups


def is_ours(row):
    return row.solver.startswith(OURS)


def counted(rows, how, reached):
    """The fastest setting of each solver that reached the tolerance, fastest solver first. how: "cold" or "known"."""
    best = {}
    for row in sorted((row for row in rows if reached(row) and np.isfinite(getattr(row, how))), key=lambda row: getattr(row, how)):
        best.setdefault(row.solver, row)
    return list(best.values())


def default_row(rows):
    """The library with its default settings."""
    return next((row for row in rows if row.solver == f"{OURS} auto" and row.setting == "1e-09"), None)


def duration(seconds):
    if not np.isfinite(seconds):
        return "—"
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-6:.2g} µs"


def markdown(head, lines):
    return "\n".join(["| " + " | ".join(row) + " |" for row in (head, ["---"] * len(head), *lines)]) + "\n"


def summary(rows):
    """A line a problem: ours and the fastest peer, cold and with a known pattern."""
    head = ["problem", "n", "rows", "libmlcp, cold", "known", "error", "fastest peer, cold", "its form and setting", "fastest peer, known",
            "peer ÷ ours, cold", "known", "memory, MB: ours, peer"]
    lines = []
    for name, group in by_problem(rows).items():
        ours = default_row(group)
        peers = [row for row in group if not is_ours(row)]
        cold, known = (next(iter(counted(peers, how, lambda row: row.reached_normwise)), None) for how in ("cold", "known"))
        good = ours is not None and ours.reached
        lines.append([
            name, str(group[0].n), str(group[0].m),
            duration(ours.cold) if good else "not solved", duration(ours.known) if good else "—", f"{ours.error:.0e}" if ours else "—",
            f"{cold.solver} {duration(cold.cold)}" if cold else "none", f"{cold.form} {cold.setting}" if cold else "—",
            f"{known.solver} {duration(known.known)}" if known else "none",
            f"{cold.cold / ours.cold:.2g}" if cold and good else "—", f"{known.known / ours.known:.2g}" if known and good else "—",
            f"{ours.memory:.0f}, {cold.memory:.0f}" if cold and ours else "—"])
    return markdown(head, lines)


def solvers(rows):
    """A line a solver: on how many problems its fastest setting reached 1e-9, and where it was wrong."""
    groups = by_problem(rows)
    lines = []
    for solver in dict.fromkeys(row.solver for row in rows):
        strict = sum(any(row.solver == solver and row.reached for row in group) for group in groups.values())
        normwise = sum(any(row.solver == solver and row.reached_normwise for row in group) for group in groups.values())
        asked = sum(any(row.solver == solver for row in group) for group in groups.values())
        wrong = sum(any(row.solver == solver and row.wrong for row in group) for group in groups.values())
        lines.append([solver, str(asked), str(strict), str(normwise), str(wrong)])
    return markdown(["solver", "problems", "1e-9 by component", "1e-9 by norm", "wrong, but claims success"], lines)


def wrong(rows):
    """Every answer that claims success and is not one."""
    lines = [[row.problem, row.solver, row.form, row.setting, f"{row.normwise:.0e}"] for row in rows if row.wrong and not is_ours(row)]
    return markdown(["problem", "solver", "form", "setting", "error by norm"], lines) if lines else "None.\n"
