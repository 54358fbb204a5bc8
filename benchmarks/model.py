"""``python -m benchmarks.model``: what the paper's tank would cost on up to a rank a slab.

A step lasts as long as its busiest rank works, phase by phase, and then come the messages.  Who
owns what is not modelled: the tank is built and cut as the program does it.  The solver is
`deflated`, the default.  The constants of the machine stand in machine.toml.  Writes the figure and
the tables of docs/parallel.md.
"""

import bisect
import itertools
import math
import textwrap
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mpslab import load_case
from mpslab.parallel import balance
from mpslab.parallel.rebalance import SOLID
from mpslab.parallel.slabs import WIDTH, make_slabs
from mpslab.pressure import deflation, equation
from mpslab.pressure.groups import SIDE, keys, number_groups
from mpslab.solids import filling, layout
from mpslab.solids.piston import make_paddle

HERE = Path(__file__).parent
DOCS = HERE.parent / "docs"
SPACINGS = (0.002, 0.001, 0.0005)  # m
RANKS = tuple(2**k for k in range(11))

# Of `deflated` a step, mean over steps 4 to 15 of the breaker in 3-D; the same on any machine.  At
# 0.5 mm the factor of the band would cost too much, and cells are merged by two.
ITERATIONS = {0.004: 9.4, 0.003: 11.6, 0.002: 10.8, 0.0015: 11.3, 0.001: 13.0, 0.0005: 36.1}

# Messages of an iteration: rows for the product, and sums over the ranks: of two dots, a value a
# slab each, and of a third one with a value a group.
EXCHANGES, SUMS, DOTS = 1, 2, 3
# And of a step: rows and refreshed arrays; sums, with what all ranks tell each other as two each.
STEP_EXCHANGES, STEP_SUMS = 16, 39
# Solves for the groups, each with the sum of a value a group: one an iteration, and before the
# first and after the last.
STEP_SOLVES = 2
ROW_BYTES = 8  # of a value in messages and sums as well
# Of a ghost in a step: its arrays, position and velocity of the start, and what is refreshed.
GHOST_BYTES = 74 + 48 + 257


@dataclass(frozen=True)
class Tank:
    """The paper's tank with still water, slab by slab.

    Attributes
    ----------
    spacing : float [m]
    water, particles : (slabs,) int
        Water particles, and all.
    work : (slabs,) float
        By which ranks are cut; see `mpslab.parallel.rebalance.load`.
    groups : (slabs,) int
        Of the deflation; see `mpslab.pressure.deflation`.
    half : int
        Groups before a group that it may be coupled to: the coarse matrix is a band.
    """

    spacing: float
    water: np.ndarray
    particles: np.ndarray
    work: np.ndarray
    groups: np.ndarray
    half: int


def make_tank(spacing):
    """The tank at a spacing [m]: its slice in 2-D, as often as there are rows across."""
    case = load_case("plunging_breaker", {"particles.spacing": spacing})
    flat = load_case("plunging_breaker", {"particles.spacing": spacing, "tank.width": 0.0})
    backmost, across = make_paddle(flat).backmost, layout.rows_across(case)
    particles = layout.build_particles(flat, backmost)
    radius = spacing * flat.scheme.reach
    slabs = make_slabs(*layout.extent(flat, backmost), radius)
    slab, fluid = slabs.of(particles.position[:, 0]), particles.fluid
    # Rows across differ in where a column has a particle more.
    rows = np.concatenate([filling.section(case, row)[:, 0] for row in range(across)])
    water = np.bincount(slabs.of(rows), minlength=slabs.count)
    solid = across * np.bincount(slab[~fluid], minlength=slabs.count)
    groups, half = _groups(
        slab[fluid],
        _cell(particles.position[fluid, 2], flat),
        _cell((np.arange(across) + 0.5) * spacing, flat),
        water,
    )
    return Tank(
        spacing=spacing,
        water=water,
        particles=water + solid,
        work=water + SOLID * solid,
        groups=groups,
        half=half,
    )


def _cell(place, case):
    """Cell across the tank of places [m] in y or z, as wide as those of a pressure system."""
    radius = case.particles.spacing * case.scheme.laplacian_radius
    return equation.cells(place, WIDTH * radius)


def _groups(slab, up, aside, water):
    """Groups of each slab, (slabs,) int, and half the band, as the `Deflation` of a step has them.

    Where the factor would cost too much, cells are merged here, as they were before the deflation
    had a second level: what the model says of such a tank is too slow.

    Parameters
    ----------
    slab, up : (n,) int
        Slab of each water particle of a slice, and its cell in z.
    aside : (across,) int
        Cell of each slice in y.
    water : (slabs,) int
        Water particles.
    """
    # Which cells hold water decides, not how much: one row for each of them will do.
    wet, aside = np.unique(np.column_stack([slab, up]), axis=0), np.unique(aside)
    slab, up = np.repeat(wet, len(aside), axis=0).T
    cell, merged = np.column_stack([np.tile(aside, len(wet)), up]), 1
    while True:
        groups, number = number_groups([keys(slab, cell, merged)])
        half = _half(groups, number)
        if len(groups) * half**2 <= deflation.WORK * water.sum():
            return np.bincount(groups // SIDE**2, minlength=len(water)), half
        merged *= 2


def _half(groups, number):
    """Most groups from a group to one beside it, above it, or in the next slab."""
    half = 0
    slab, aside, up = groups // SIDE**2, groups // SIDE % SIDE, groups % SIDE
    first, count = aside.min(), np.ptp(aside) + 1
    for step in itertools.product((0, 1), (-1, 0, 1), (-1, 0, 1)):
        around = first + (aside - first + step[1]) % count
        beside = ((slab + step[0]) * SIDE + around) * SIDE + up + step[2]
        at = np.minimum(np.searchsorted(groups, beside), len(groups) - 1)
        half = max(half, np.max((number[at] - number)[groups[at] == beside], initial=0))
    return int(half)


def iterations(spacing):
    """Iterations of a step, between and beyond the measured spacings [m].

    Between them by a power of the spacing.  Beyond the finest as 1/d0, the root of the condition
    number inside a group: there cells are merged, and hold ever more particles across.
    """
    known = sorted(ITERATIONS)
    if spacing < known[0]:
        return ITERATIONS[known[0]] * known[0] / spacing
    counts = np.log([ITERATIONS[d] for d in known])
    return float(np.exp(np.interp(math.log(spacing), np.log(known), counts)))


@dataclass(frozen=True)
class Share:
    """What the ranks have, each (ranks,) int: water and particles owned, and seen as ghosts."""

    water: np.ndarray
    particles: np.ndarray
    ghost_water: np.ndarray
    ghosts: np.ndarray


def share_out(tank, ranks):
    """The `Share` of each rank with ``parallel.balance = "optimal"``.

    Raises
    ------
    ValueError
        If there are more ranks than slabs.
    """
    cuts = balance.cut("optimal", tank.work, ranks)
    return Share(
        water=np.add.reduceat(tank.water, cuts[:-1]),
        particles=np.add.reduceat(tank.particles, cuts[:-1]),
        ghost_water=_beside(tank.water, cuts),
        ghosts=_beside(tank.particles, cuts),
    )


def _beside(count, cuts):
    """Sums of the slab on either side of each rank."""
    walled = np.concatenate([[0], count, [0]])
    return walled[cuts[:-1]] + walled[cuts[1:] + 1]


def predict(machine, tank, share):
    """Seconds of a step.

    Parameters
    ----------
    machine : dict
        As `read_machine` gives it.
    tank : Tank
    share : Share

    Returns
    -------
    dict of str to float
        Of each phase the work of its busiest rank; ``solve`` without ``coarse``, the work for the
        groups; and ``messages``.
    """
    cost, alone = machine["work"], len(share.water) == 1
    slower, count = slowdown(machine, len(share.water)), iterations(tank.spacing)
    rows = (share.water + share.ghost_water / WIDTH).max()  # of ghosts within one radius
    counts = {
        "ghosts": 0 if alone else (share.particles + share.ghosts).max(),
        "neighbours": rows,
        "operators": rows,
        "assembly": rows,
        "solve": share.water.max() * count,
        "record": share.particles.max(),
        "rest": share.particles.max(),
    }
    step = {phase: slower * cost[phase] * many for phase, many in counts.items()}
    step["coarse"] = slower * coarse_work(cost, tank, count)
    step["messages"] = _messages(machine["message"], tank, share, count)
    return step


def slowdown(machine, ranks):
    """How much slower the ranks on a machine work: from none alone to all with every core busy."""
    most = machine["cores"] - 1
    return 1.0 + (machine["sharing"] - 1.0) * min(ranks - 1, most) / most


def coarse_work(cost, tank, count):
    """Seconds for the groups in a step of `count` iterations, the same on every rank.

    Each rank factors the whole band, and solves with it in every iteration.
    """
    solves = tank.groups.sum() * tank.half * (count + STEP_SOLVES)
    return cost["factor"] * tank.groups.sum() * tank.half**2 + cost["substitution"] * solves


def _messages(message, tank, share, count):
    """Seconds for messages to the neighbours and sums over all ranks, with `count` iterations."""
    beside = min(len(share.water) - 1, 2)
    exchanges = EXCHANGES * count + STEP_EXCHANGES
    size = EXCHANGES * count * ROW_BYTES * share.ghost_water.max()
    size += GHOST_BYTES * share.ghosts.max()
    return (
        beside * exchanges * message["latency"]
        + size / message["bandwidth"]
        + _sums(message, tank, len(share.water), count)
    )


def _sums(message, tank, ranks, count):
    """Seconds for sums of arrays over all ranks, in rounds: a value a slab or a group, the band."""
    groups = tank.groups.sum()
    number = SUMS * count + STEP_SUMS
    by_slab, by_group = DOTS * count + STEP_SUMS, count + STEP_SOLVES + tank.half + 1
    size = ROW_BYTES * (by_slab * len(tank.groups) + by_group * groups)
    rounds = math.ceil(math.log2(ranks))
    return rounds * (number * message["sum"] + size / message["bandwidth"])


def slabs_run_out(tank):
    """Most ranks the tank can be cut for: its slabs."""
    return len(tank.water)


def ghosts_outweigh(tank):
    """Fewest ranks that see as much water of others as they own, all taken together."""
    ranks = range(1, slabs_run_out(tank) + 1)
    return ranks[bisect.bisect_left(ranks, tank.water.sum(), key=lambda n: _seen(tank, n))]


def _seen(tank, ranks):
    return share_out(tank, ranks).ghost_water.sum()


def read_machine(path=HERE / "machine.toml"):
    """The constants of a machine, as the tables of its file."""
    with open(path, "rb") as file:
        return tomllib.load(file)


def scaling(machine, tank):
    """Rows (ranks, Share, seconds of a step by phase) for all ranks that the tank has slabs for."""
    most = slabs_run_out(tank)
    counts = [*(n for n in RANKS if n < most), most]
    shares = [share_out(tank, n) for n in counts]
    return [(n, s, predict(machine, tank, s)) for n, s in zip(counts, shares, strict=True)]


def report(machine, tanks, rows):
    """Markdown: measured against predicted, then a table of the rows of each tank's `scaling`."""
    lines = []
    if machine["provisional"]:
        lines += ["**Provisional**: the constants are not yet measured on a quiet machine.", ""]
    lines += ["| d0, mm | ranks | measured, s a step | predicted |", "|---|---|---|---|"]
    for one in sorted(machine["measured"], key=lambda one: (-one["spacing"], one["ranks"])):
        tank = make_tank(one["spacing"])
        step = sum(predict(machine, tank, share_out(tank, one["ranks"])).values())
        lines.append(f"| {one['spacing'] * 1e3:g} | {one['ranks']} | {one['seconds']:.3f} "
                     f"| {step:.3f} |")  # fmt: skip
    for tank, table in zip(tanks, rows, strict=True):
        lines += ["", _summary(tank), "", *_table(table)]
    return lines


def _summary(tank):
    most, water = slabs_run_out(tank), tank.water
    return textwrap.fill(
        f"d0 = {tank.spacing * 1e3:g} mm: {tank.particles.sum():,} particles, {water.sum():,} of "
        f"water in {tank.groups.sum():,} groups, {iterations(tank.spacing):.0f} iterations a step. "
        f"There are {most} slabs, {np.count_nonzero(water == 0)} of them dry, and no more ranks "
        f"than slabs; from {ghosts_outweigh(tank)} ranks on, the ranks see more water of others "
        f"than they own; the fullest slab holds 1/{water.sum() / water.max():.0f} of the water.",
        width=100,
    )


def _table(rows):
    lines = [
        "| ranks | most water of a rank | ghost water beside it | s a step | times as fast "
        "| efficiency | messages |",
        "|---|---|---|---|---|---|---|",
    ]
    alone = sum(rows[0][2].values())
    for ranks, share, step in rows:
        total, busiest = sum(step.values()), share.water.argmax()
        lines.append(
            f"| {ranks} | {share.water[busiest]:,} | {share.ghost_water[busiest]:,} | {total:.3g} "
            f"| {alone / total:.1f} | {alone / total / ranks:.0%} "
            f"| {step['messages'] / total:.0%} |"
        )
    return lines


def draw(machine, tanks, rows, path):
    """How many times as fast against ranks: a cross where measured, a dot where slabs run out."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.0, 4.2), layout="constrained")
    axes = figure.subplots()
    axes.plot(RANKS, RANKS, color="0.7", linestyle="--", label="ideal")
    for tank, table in zip(tanks, rows, strict=True):
        ranks = [n for n, _, _ in table]
        seconds = np.array([sum(step.values()) for _, _, step in table])
        (line,) = axes.plot(ranks, seconds[0] / seconds, label=f"d0 = {tank.spacing * 1e3:g} mm")
        axes.plot(ranks[-1], seconds[0] / seconds[-1], "o", color=line.get_color())
        axes.plot(*_measured(machine, tank.spacing), "x", color=line.get_color())
    axes.set(xscale="log", yscale="log", xlabel="ranks", ylabel="times as fast as one rank",
             xlim=(1, RANKS[-1]), ylim=(1, RANKS[-1]))  # fmt: skip
    axes.legend(title="predicted" + (", provisional" if machine["provisional"] else ""))
    figure.savefig(path, dpi=120)


def _measured(machine, spacing):
    """Ranks, and how many times as fast as one they were, where that was measured."""
    step = {m["ranks"]: m["seconds"] for m in machine["measured"] if m["spacing"] == spacing}
    many = [ranks for ranks in step if 1 in step and ranks > 1]
    return many, [step[1] / step[ranks] for ranks in many]


def put_between(text, begin, end, lines):
    """A text with the lines between two of its own in place of what stood there."""
    head, _, rest = text.partition(begin)
    _, _, tail = rest.partition(end)
    if not tail:
        raise ValueError(f"the text has no {begin} ... {end}")
    return "\n".join([head + begin, *lines, end + tail])


def main():
    """Write the figure and the tables; print the tables."""
    machine, tanks = read_machine(), [make_tank(spacing) for spacing in SPACINGS]
    rows = [scaling(machine, tank) for tank in tanks]
    lines, page = report(machine, tanks, rows), DOCS / "parallel.md"
    draw(machine, tanks, rows, DOCS / "scaling.png")
    page.write_text(put_between(page.read_text(), "<!-- model -->", "<!-- end of model -->", lines))
    print("\n".join(lines))


if __name__ == "__main__":
    main()
