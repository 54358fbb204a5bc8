"""``python -m benchmarks.model``: what the paper's tank would cost on up to 1,024 ranks.

A step lasts as long as its busiest rank works, phase by phase, and then come the messages.  Who
owns what is not modelled: the tank is built and cut as the program does it.  The constants of the
machine stand in machine.toml.  Writes the figure and the tables of docs/parallel.md.
"""

import bisect
import math
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mpslab import balance, geometry, load_case
from mpslab.piston import make_paddle
from mpslab.rebalance import load
from mpslab.slabs import make_slabs

HERE = Path(__file__).parent
DOCS = HERE.parent / "docs"
SPACINGS = (0.002, 0.001, 0.0005)  # m
RANKS = tuple(2**k for k in range(11))

# Of `piccg` a step, mean over steps 4 to 15 of the breaker in 3-D; the same on any machine.
ITERATIONS = {0.004: 21.1, 0.003: 32.0, 0.002: 52.8, 0.0015: 70.6, 0.001: 106.7}

# Messages of an iteration: rows for the product and twice for the preconditioner, three dots.
EXCHANGES, SUMS = 3, 3
# And of a step: rows and refreshed arrays; sums, with what all ranks tell each other as two each.
STEP_EXCHANGES, STEP_SUMS = 10, 26
ROW_BYTES = 8
# Of a ghost in a step: its arrays, position and velocity of the start, and what is refreshed.
GHOST_BYTES = 74 + 48 + 105


@dataclass(frozen=True)
class Tank:
    """The paper's tank with still water, slab by slab.

    Attributes
    ----------
    spacing : float [m]
    water, particles : (slabs,) int
        Water particles, and all.
    work : (slabs,) float
        By which ranks are cut; see `mpslab.rebalance.load`.
    """

    spacing: float
    water: np.ndarray
    particles: np.ndarray
    work: np.ndarray


def make_tank(spacing):
    """The tank at a spacing [m]: its slice in 2-D, as often as there are rows across."""
    case = load_case("plunging_breaker", {"particles.spacing": spacing})
    flat = load_case("plunging_breaker", {"particles.spacing": spacing, "tank.width": 0.0})
    backmost, across = make_paddle(flat).backmost, geometry.rows_across(case)
    particles = geometry.build_particles(flat, backmost)
    radius = spacing * max(flat.scheme.effective_radius, flat.scheme.laplacian_radius)
    slabs = make_slabs(*geometry.extent(flat, backmost), radius)
    slab, fluid = slabs.of(particles.position[:, 0]), particles.fluid
    return Tank(
        spacing=spacing,
        water=across * np.bincount(slab[fluid], minlength=slabs.count),
        particles=across * np.bincount(slab, minlength=slabs.count),
        work=across * load("optimal", fluid, slab, slabs.count),
    )


def iterations(spacing):
    """Iterations of a step, between and beyond the measured spacings [m].

    Between them by a power of the spacing.  Beyond the finest as 1/d0: the root of the condition
    number, which grows as 1/d0^2.  The measured power falls from 1.5 to 1.0 on the way there.
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


def predict(machine, spacing, share):
    """Seconds of a step.

    Parameters
    ----------
    machine : dict
        As `read_machine` gives it.
    spacing : float [m]
    share : Share

    Returns
    -------
    dict of str to float
        Of each phase the work of its busiest rank, and ``messages``.
    """
    cost, alone = machine["work"], len(share.water) == 1
    slowdown = 1.0 if alone else machine["sharing"]
    seen = (share.water + share.ghost_water).max()
    counts = {
        "ghosts": 0 if alone else (share.particles + share.ghosts).max(),
        "neighbours": seen,
        "operators": seen,
        "assembly": seen,
        "solve": share.water.max() * iterations(spacing),
        "record": share.particles.max(),
        "rest": share.particles.max(),
    }
    step = {phase: slowdown * cost[phase] * count for phase, count in counts.items()}
    step["messages"] = _messages(machine["message"], iterations(spacing), share)
    return step


def _messages(message, count, share):
    """Seconds for messages to the neighbours and sums over all ranks, with `count` iterations."""
    ranks = len(share.water)
    exchanges = EXCHANGES * count + STEP_EXCHANGES
    size = EXCHANGES * count * ROW_BYTES * share.ghost_water.max()
    size += GHOST_BYTES * share.ghosts.max()
    sums = (SUMS * count + STEP_SUMS) * math.ceil(math.log2(ranks))
    beside = min(ranks - 1, 2)
    return (
        beside * exchanges * message["latency"]
        + size / message["bandwidth"]
        + sums * message["sum"]
    )


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
    return [(n, s, predict(machine, tank.spacing, s)) for n, s in zip(counts, shares, strict=True)]


def report(machine, tanks, rows):
    """Markdown: measured against predicted, then a table of the rows of each tank's `scaling`."""
    lines = []
    if machine["provisional"]:
        lines += ["**Provisional**: the constants are not yet measured on a quiet machine.", ""]
    lines += ["| d0, mm | ranks | measured, s a step | predicted |", "|---|---|---|---|"]
    for one in machine["measured"]:
        share = share_out(make_tank(one["spacing"]), one["ranks"])
        step = sum(predict(machine, one["spacing"], share).values())
        lines.append(f"| {one['spacing'] * 1e3:g} | {one['ranks']} | {one['seconds']:.3f} "
                     f"| {step:.3f} |")  # fmt: skip
    for tank, table in zip(tanks, rows, strict=True):
        lines += ["", _summary(tank), "", *_table(table)]
    return lines


def _summary(tank):
    most, water = slabs_run_out(tank), tank.water
    return (
        f"d0 = {tank.spacing * 1e3:g} mm: {tank.particles.sum():,} particles, {water.sum():,} of "
        f"water, {iterations(tank.spacing):.0f} iterations a step. Slabs run out at {most} ranks, "
        f"{np.count_nonzero(water == 0)} of them dry; from {ghosts_outweigh(tank)} ranks on they "
        f"see more water of others than they own; the fullest slab holds 1/"
        f"{water.sum() / water.max():.0f} of the water."
    )


def _table(rows):
    lines = [
        "| ranks | most water of a rank | of it seen beside | s a step | times as fast "
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
    """Figure of how many times as fast against ranks; a dot where the slabs run out."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.0, 4.2), layout="constrained")
    axes = figure.subplots()
    axes.plot(RANKS, RANKS, color="0.7", linestyle="--", label="ideal")
    for tank, table in zip(tanks, rows, strict=True):
        ranks = [n for n, _, _ in table]
        seconds = np.array([sum(step.values()) for _, _, step in table])
        (line,) = axes.plot(ranks, seconds[0] / seconds, label=f"d0 = {tank.spacing * 1e3:g} mm")
        axes.plot(ranks[-1], seconds[0] / seconds[-1], "o", color=line.get_color())
    axes.set(xscale="log", yscale="log", xlabel="ranks", ylabel="times as fast as one rank",
             xlim=(1, RANKS[-1]), ylim=(1, RANKS[-1]))  # fmt: skip
    axes.legend(title="predicted" + (", provisional" if machine["provisional"] else ""))
    figure.savefig(path, dpi=120)


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
