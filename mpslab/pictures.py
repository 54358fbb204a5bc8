"""Pictures of a run, drawn from the files of its folder alone."""

import tomllib
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from mpslab.snapshots import draw_breaker, draw_tank
from mpslab.tables import read_rows

# Okabe and Ito's colours, which stay apart for the colour-blind.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
STYLE = {
    "font.size": 11,
    "axes.titlesize": 11,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "lines.linewidth": 1.2,
    "legend.frameon": False,
    "savefig.dpi": 160,
    "savefig.bbox": "tight",
}


def draw_run(folder):
    """Draw the pictures of a run into ``pictures`` of its folder.

    ``tank.png`` and ``breaker.png`` (particles), ``gauges.png``, ``probes.png``, ``energy.png`` and
    ``solver.png``; a picture that the files hold nothing for is left out.

    Parameters
    ----------
    folder : str or Path
        A run folder.

    Returns
    -------
    list of Path
        The pictures.

    Raises
    ------
    ValueError
        If the folder holds no case, or its frames cannot be read.
    """
    folder = Path(folder)
    case = read_case(folder)
    target = folder / "pictures"
    target.mkdir(exist_ok=True)
    drawn = []
    with matplotlib.rc_context(STYLE):
        for name, figure in _figures(folder, case):
            drawn.append(target / f"{name}.png")
            figure.savefig(drawn[-1])
    return drawn


def _figures(folder, case):
    """Names and figures, one after the other, of what there is to see."""
    particles = folder / "particles.vtkhdf"
    if particles.exists():
        yield "tank", draw_tank(particles, case)
        breaker = draw_breaker(particles, case)
        if breaker:
            yield "breaker", breaker
    gauges = read_table(folder / "gauges.csv")
    if len(gauges) > 1:
        yield "gauges", draw_gauges(gauges, case)
    probes = read_table(folder / "probes.csv")
    if len(probes) > 1:
        yield "probes", draw_probes(probes, case)
    steps = read_table(folder / "steps.csv")
    if steps:
        yield "energy", draw_energy(steps, case)
        yield "solver", draw_solver(steps, case)


def read_case(folder):
    """The resolved case of a run folder, a dict; ValueError if there is none."""
    path = folder / "case.toml"
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ValueError(
            f"'{path}': cannot be read as a case ({error}); allowed: the folder of a run"
        ) from error


def read_table(path):
    """Columns of a table of the run folder.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    dict of str to ndarray
        Header to column, of numbers where all entries are numbers; empty if there is no file, or
        no row in it.
    """
    header, *rows = read_rows(path) or [[]]
    if not rows:
        return {}
    return {name: _column(entries) for name, *entries in zip(header, *rows, strict=True)}


def _column(entries):
    try:
        return np.array(entries, float)
    except ValueError:
        return np.array(entries)


def _stack(count, case, title, height=2.0):
    """Figure of panels above each other with a common axis of time."""
    figure = Figure(figsize=(9.0, 1.2 + height * count), layout="constrained")
    axes = figure.subplots(count, 1, sharex=True, squeeze=False)[:, 0]
    for ax in axes:
        ax.grid(color="0.9", linewidth=0.6)
    axes[-1].set_xlabel("time [s]")
    figure.suptitle(f"{case.get('title') or case['name']}\n{title}")
    return figure, axes


def draw_gauges(gauges, case):
    """Surface elevation above still water against time, one panel for each gauge.

    Parameters
    ----------
    gauges : dict of str to ndarray
        Columns of ``gauges.csv``.
    case : dict
        The case as its TOML file holds it.

    Returns
    -------
    matplotlib Figure
    """
    time, *names = gauges
    places = {f"{gauge['name']} [m]": gauge["x"] for gauge in case.get("gauge", ())}
    figure, axes = _stack(len(names), case, "Surface elevation above still water", height=1.6)
    for ax, name in zip(axes, names, strict=True):
        ax.axhline(0.0, color="0.6", linewidth=0.8)
        ax.plot(gauges[time], gauges[name] - case["tank"]["depth"])
        place = f", x = {places[name]:g} m" if name in places else ""
        ax.set_title(name.removesuffix(" [m]") + place, loc="left")
        ax.set_ylabel("elevation [m]")
    return figure


def draw_probes(probes, case):
    """Pressure against time, one panel for each probe.

    Parameters
    ----------
    probes : dict of str to ndarray
        Columns of ``probes.csv``.
    case : dict
        The case as its TOML file holds it.

    Returns
    -------
    matplotlib Figure
    """
    pressures = [name for name in probes if name.endswith(" pressure [Pa]")]
    figure, axes = _stack(len(pressures), case, "Pressure", height=1.6)
    for ax, name in zip(axes, pressures, strict=True):
        ax.plot(probes["time [s]"], probes[name])
        ax.set_title(name.removesuffix(" pressure [Pa]"), loc="left")
        ax.set_ylabel("pressure [Pa]")
    return figure


def draw_energy(steps, case):
    """Kinetic energy, and potential and total energy less the start's, against time.

    Parameters
    ----------
    steps : dict of str to ndarray
        Columns of ``steps.csv``.
    case : dict
        The case as its TOML file holds it.

    Returns
    -------
    matplotlib Figure
    """
    time, kinetic = steps["time [s]"], steps["kinetic_energy [J]"]
    gained = steps["potential_energy [J]"] - steps["potential_energy [J]"][0]
    figure, (ax,) = _stack(1, case, "Energy of the water", height=3.6)
    ax.plot(time, kinetic, label="kinetic")
    ax.plot(time, gained, label="potential, less that at the start", linestyle="--")
    ax.plot(time, kinetic + gained, label="sum", color="black", linewidth=1.6)
    ax.set_ylabel("energy [J]" if case["tank"]["width"] else "energy of 1 m of width [J]")
    ax.legend()
    return figure


def draw_solver(steps, case):
    """Iterations, time step with the limit that held, and run time of a step, against time.

    Parameters
    ----------
    steps : dict of str to ndarray
        Columns of ``steps.csv``.
    case : dict
        The case as its TOML file holds it.

    Returns
    -------
    matplotlib Figure
    """
    time, seconds = steps["time [s]"], steps["seconds"]
    title = f"{len(time)} steps in {seconds.sum():.4g} s: {seconds.mean():.3g} s a step"
    figure, (top, middle, bottom) = _stack(3, case, title)
    top.plot(time, steps["iterations"], linewidth=0.8)
    top.set_ylabel("iterations of the\npressure solver")
    _draw_time_step(middle, steps)
    bottom.plot(time, seconds, linewidth=0.8)
    bottom.set_ylabel("run time of\na step [s]")
    for ax in (top, bottom):
        ax.set_ylim(bottom=0)
    return figure


def _draw_time_step(ax, steps):
    """Time step as points, coloured by the limit that held."""
    limits, first = np.unique(steps["dt_limit"], return_index=True)
    for limit, colour in zip(limits[np.argsort(first)], COLOURS, strict=False):
        held = steps["dt_limit"] == limit
        ax.scatter(
            steps["time [s]"][held],
            1e3 * steps["dt [s]"][held],
            s=5,
            color=colour,
            label=limit,
            zorder=2,
        )
    ax.set_ylabel("time step [ms]")
    ax.set_ylim(bottom=0)
    ax.legend(title="limit", loc="center left", bbox_to_anchor=(1.0, 0.5), markerscale=3)
