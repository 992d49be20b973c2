"""The figures that were promised for the library, each with what it must be and what was aimed at."""
from dataclasses import dataclass

import numpy as np

from . import families, library as lib, sequences, soft, soft_models, tables
from .problem import Problem

ROBOT, ROBOTS, SPHERES = "humanoid_fall", "humanoids22", "spheres_356"
PILE, LARGE_PILE = "pile 3000", "pile 30000"
GROWTH = {"pile": (100, 300, 1000, 3000, 10000, 30000), "rope": (100, 1000, 10000, 100000)}
DEFAULT = 0  # the method "auto"
TOLERANCE = 1e-9


@dataclass
class Figure:
    name: str
    must: str
    aim: str
    measured: str
    note: str = ""


def from_rows(rows):
    """The figures that the comparison itself gives."""
    groups = tables.by_problem(rows)
    yield _all_solved(groups)
    yield from _against_fastest(groups, PILE, "sphere pile, ~3000 contacts", {"cold": ("≥ 8", "≥ 16")})
    yield _against_ode(groups)
    yield from _against_fastest(groups, ROBOT, ROBOT, {"cold": ("≥ 1", "≥ 2"), "known": ("≥ 2", "≥ 5")})
    yield from _against_fastest(groups, ROBOTS, ROBOTS, {"cold": ("≥ 2", "≥ 4"), "known": ("≥ 5", "≥ 12")})
    yield from _against_fastest(groups, SPHERES, SPHERES, {"cold": ("≥ 5", "≥ 12")})
    yield from _geometric_means(groups)
    yield from _against_fastest(groups, LARGE_PILE, "pile of 30 000 contacts", {"cold": ("≥ 2", "≥ 8")})


def _all_solved(groups):
    real = [row for group in groups.values() if group[0].family == "real" for row in [tables.default_row(group)] if row]
    solved = [row for row in real if row.reached]
    missed = [f"{row.problem} ({row.note or f'{row.error:.0e}'})" for row in real if not row.reached]
    worst = max((row.error for row in solved), default=np.nan)
    return Figure("all symmetric frictionless real problems, default settings: solved at 1e-9", "all", "1e-12",
                  f"{len(solved)} of {len(real)}, largest error of these {worst:.0e}" if real else "left out: no real problems",
                  "not: " + ", ".join(missed) if missed else "")


def _best(group, how):
    """Our default row and the fastest peer by each of the two measures."""
    ours = tables.default_row(group)
    peers = [row for row in group if not tables.is_ours(row)]
    fastest = [next(iter(tables.counted(peers, how, reached)), None)
               for reached in (lambda row: row.reached, lambda row: row.reached_normwise)]
    return (ours if ours and ours.reached else None), *fastest


def _ratio(ours, peer, how):
    return getattr(peer, how) / getattr(ours, how) if ours and peer else np.nan


def _against_fastest(groups, name, title, wanted):
    for how, (must, aim) in wanted.items():
        title_how = f"{title}, {'known pattern' if how == 'known' else 'cold'}: fastest peer ÷ ours"
        if name not in groups:
            yield Figure(title_how, must, aim, f"left out: {name} was not run")
            continue
        ours, strict, normwise = _best(groups[name], how)
        if ours is None:
            yield Figure(title_how, must, aim, "not solved by ours")
            continue
        by_component = f"{_ratio(ours, strict, how):.2g} by component" if strict else "no peer reaches 1e-9 by component"
        by_norm = f"{_ratio(ours, normwise, how):.2g} by norm" if normwise else "no peer reaches it by norm"
        named = [strict] if strict is normwise else [strict, normwise]
        peers = " / ".join(f"{peer.solver} {tables.duration(getattr(peer, how))} ({peer.form}, {peer.setting}), {peer.memory:.0f} MB"
                           for peer in named if peer)
        yield Figure(title_how, must, aim, f"{by_component}; {by_norm}",
                     f"ours {tables.duration(getattr(ours, how))}, {ours.memory:.0f} MB; {peers}")


def _against_ode(groups):
    title = "same: ODE's Dantzig ÷ ours, cold"
    group = groups.get(PILE, [])
    ours = tables.default_row(group)
    finished = [row for row in group if row.solver == "ODE Dantzig" and np.isfinite(row.cold)]
    if not (ours and finished):
        return Figure(title, "≥ 200", "≥ 400", f"left out: {'it did not end' if ours else PILE + ' was not run'}")
    # where it gives up early it is fast and wrong
    settings = ", ".join(f"{row.setting}: {tables.duration(row.cold)}, {row.normwise:.0e}" for row in finished)
    ode = next(iter(tables.counted(finished, "cold", lambda row: row.reached_normwise)), None)
    if ode is None:
        return Figure(title, "≥ 200", "≥ 400", "left out: none of its settings was right within the limit", settings)
    return Figure(title, "≥ 200", "≥ 400", f"{ode.cold / ours.cold:.3g}",
                  f"{tables.duration(ode.cold)} with {ode.setting}, error {ode.normwise:.0e} by norm; {settings}")


def _geometric_means(groups):
    for how in ("cold", "known"):
        ratios = {"component": [], "norm": []}
        alone = 0
        for group in groups.values():
            ours, strict, normwise = _best(group, how)
            if ours is None:
                continue
            for name, peer in (("component", strict), ("norm", normwise)):
                if peer:
                    ratios[name].append(_ratio(ours, peer, how))
            alone += normwise is None
        text = "; ".join(f"{np.exp(np.mean(np.log(values))):.2g} by {name} over {len(values)}" for name, values in ratios.items() if values)
        yield Figure(f"geometric mean over all problems, {'known pattern' if how == 'known' else 'cold'}: fastest peer ÷ ours",
                     "≥ 2" if how == "cold" else "", "≥ 5" if how == "cold" else "", text or "left out: nothing was run",
                     f"on {alone} more no peer reaches 1e-9" if alone else "")


def measured_alone(library, native, problems, quick):
    """The figures that need no peer. native: a build for this CPU, or None; problems: folder of real ones, or None."""
    turns = 5 if quick else 31
    yield from _sequences(library, problems, quick)
    yield from _soft(library, turns)
    yield from _growth(library, quick)
    robots = _robots(library, problems)
    yield _threads(library, robots, turns)
    yield _native(library, native, robots, quick, turns)
    yield _allocations(library, robots, quick)
    yield from _candidate_rows(library, turns)


def _sequences(library, problems, quick):
    pile = families.Recording("pile", 100 if quick else 1000, 0)
    yield _warm_against_oracle(sequences.of_recording(library, pile, 10 if quick else families.STEPS)[0])
    title = "warm ÷ cold, medians over the steps of a recorded sequence"
    if problems is None:
        yield Figure(title, "≤ 0.5", "≤ 0.2", "left out: no real problems")
        return
    real = list(sequences.real(library, problems))
    yield Figure(title, "≤ 0.5", "≤ 0.2", f"{np.median([one.to_cold for one in real]):.2g}",
                 ", ".join(f"{one.name} {one.to_cold:.2g}" for one in real))


def _warm_against_oracle(pile):
    return Figure("pile, next step of the scene, warm: ours ÷ oracle", "≤ 1.5", "≤ 0.8", f"{pile.to_oracle:.2g}",
                  f"{pile.steps} steps, {pile.rows} contacts: warm {tables.duration(pile.warm)}, oracle {tables.duration(pile.oracle)} without analysis, "
                  f"warm ÷ cold {pile.to_cold:.2g}, largest error {pile.error:.0e}")


def _soft(library, turns):
    title = "MuJoCo's Newton, soft and with friction, ÷ our exact frictionless solve: {}"
    if why := soft.missing():
        yield Figure(title.format("all models"), "≥ 0.5", "≥ 2", f"left out: {why}")
        return
    for name, (make, steps) in soft_models.MODELS.items():
        model = make()
        newton, rows, iterations = soft.newton_seconds(model, steps, 10 * turns)
        problem = soft.exact_problem(library, name, model, steps)
        run = lib.Run(library, problem.handle, problem.n, problem.m, DEFAULT, TOLERANCE)
        cold, known = (float(np.median(run.time(how, turns))) for how in (lib.COLD, lib.KNOWN))
        answer = run.answer()
        yield Figure(title.format(name), "≥ 0.5", "≥ 2", f"{newton / cold:.2g} cold, {newton / known:.2g} known pattern",
                     f"MuJoCo {tables.duration(newton)}, {rows} rows, {iterations} iterations; ours {tables.duration(cold)} and "
                     f"{tables.duration(known)}, {problem.m} rows, error {problem.error(answer.v, answer.gamma).strict:.0e}")


def _growth(library, quick):
    for family, sizes in GROWTH.items():
        sizes = sizes[:2] if quick else sizes
        seconds = []
        for size in sizes:
            problem = families.scene(family, size).problem(library)
            run = lib.Run(library, problem.handle, problem.n, problem.m, DEFAULT, TOLERANCE)
            repeats = max(1, min(15, int(1 / max(float(run.time(lib.COLD, 1)[0]), 1e-6))))
            seconds.append(float(np.median(run.time(lib.COLD, repeats))))
        exponent = np.polyfit(np.log(sizes), np.log(seconds), 1)[0]
        must = "≤ 1.1" if family == "rope" else "reported"
        yield Figure(f"growth of time with contacts, {family}, {sizes[0]} to {sizes[-1]}: exponent", must, "", f"{exponent:.2f}",
                     ", ".join(f"{size}: {tables.duration(one)}" for size, one in zip(sizes, seconds)))


def _robots(library, problems):
    """Many islands of robot size: the real ones, or piles beside each other where there are none."""
    if problems is not None and (problems / ROBOTS).is_dir():
        return Problem(ROBOTS, "real", library, library.read(problems / ROBOTS))
    return families.scene("islands", 100).problem(library)


def _in_turns(runs, how, turns):
    """Medians of runs that take turns."""
    seconds = [[] for _ in runs]
    for run in runs:
        run.time(how, 2)
    for _ in range(turns):
        for run, kept in zip(runs, seconds):
            kept.append(float(np.median(run.time(how, 5))))
    return [float(np.median(kept)) for kept in seconds]


def _threads(library, problem, turns):
    title = f"two threads against one, {problem.name}: times faster"
    runs = [lib.Run(library, problem.handle, problem.n, problem.m, DEFAULT, TOLERANCE, threads) for threads in (1, 2)]
    one, two = _in_turns(runs, lib.KNOWN, turns)
    answers = [run.answer() for run in runs]
    same = all(np.array_equal(getattr(answers[0], part), getattr(answers[1], part)) for part in ("v", "gamma"))
    return Figure(title, "≥ 1.6", "same bits", f"{one / two:.2g}, {'the same bits' if same else 'DIFFERENT BITS'}",
                  f"{tables.duration(one)} and {tables.duration(two)} on a known pattern")


def _native(library, native, robots, quick, turns):
    title = "distributed build ÷ -march=native build"
    if native is None:
        return Figure(title, "≤ 1.1", "", "left out: not built")
    notes, ratios = [], []
    for problem, how in ((robots, lib.KNOWN), (families.scene("pile", 300 if quick else 3000).problem(library), lib.COLD)):
        same = [Problem(problem.name, problem.family, which, which.clone(problem)) for which in (library, native)]
        runs = [lib.Run(p.library, p.handle, p.n, p.m, DEFAULT, TOLERANCE) for p in same]
        distributed, tuned = _in_turns(runs, how, max(3, turns // 3))
        ratios.append(distributed / tuned)
        notes.append(f"{problem.name}: {tables.duration(distributed)} and {tables.duration(tuned)}")
    return Figure(title, "≤ 1.1", "", ", ".join(f"{ratio:.2f}" for ratio in ratios), "; ".join(notes))


def _allocations(library, robots, quick):
    counts = {problem.name: library.allocations(problem.handle)
              for problem in (robots, families.scene("pile", 300 if quick else 3000).problem(library))}
    return Figure("allocations in a solve on a known pattern", "0", "", ", ".join(f"{name}: {count}" for name, count in counts.items()))


def _candidate_rows(library, turns):
    problem = families.scene("pile", 1000).problem(library)
    for known in (False, True):
        masked, alone = library.candidate_rows(problem.handle, 20, known, 10 * turns)
        yield Figure(f"1000 candidate rows of which 50 are enabled ÷ only those 50, {'known pattern' if known else 'cold'}", "≤ 1.2", "1.05",
                     f"{masked / alone:.2f}", f"{tables.duration(masked)} and {tables.duration(alone)}")


def markdown(figures):
    return tables.markdown(["figure", "must be", "aim", "measured", ""],
                           [[f.name, f.must, f.aim, f.measured, f.note] for f in figures])
