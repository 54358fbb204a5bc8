"""Pictures of a run, drawn from the files of its folder alone."""

import matplotlib
import numpy as np

from mpslab.analysis import sheet
from mpslab.analysis.headings import heading
from mpslab.analysis.results import open_run
from mpslab.analysis.snapshots import draw_breaker, draw_tank
from mpslab.analysis.still import still_level

# Okabe and Ito's colours, which the colour-blind can tell apart.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
STYLE = {
    "font.size": 12,
    "axes.titlesize": 12,
    "axes.titley": 1.0,  # else matplotlib lays out all text to find the place of each title
    "figure.titlesize": 13,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "lines.linewidth": 1.2,
    "legend.frameon": False,
    "savefig.dpi": 160,
    "savefig.bbox": "tight",
}
NAMES = ("tank", "pressure", "breaker", "gauges", "probes", "energy", "solver")
PACKED = 1  # of a PNG: a fifth larger than at 6, in half the time
RESOLUTIONS = range(160, 60, -10)  # of pictures in documents, dots an inch
MEDIAN = 3  # readings whose median a reading is compared with
LIMITS = 1.8  # [inch] beside the panels, for the names of the limits of the time step
OUTLYING = 0.2  # times the range of these medians: a reading farther out is off the scale


def draw_run(folder):
    """Draw the pictures of a run into ``pictures`` of its folder.

    ``tank.png``, ``pressure.png`` and ``breaker.png`` (particles), ``gauges.png``, ``probes.png``,
    ``energy.png`` and ``solver.png``. A picture for which the files hold nothing is not drawn, and
    deleted if an earlier call drew it; so is the breaker if no wave overturns.

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
    run = open_run(folder)
    target = run.folder / "pictures"
    target.mkdir(exist_ok=True)
    drawn = []
    with matplotlib.rc_context(STYLE | {"savefig.bbox": "standard"}):
        for name, figure in _figures(run):
            drawn.append(target / f"{name}.png")
            figure.savefig(drawn[-1], pil_kwargs={"compress_level": PACKED})
    for path in {target / f"{name}.png" for name in NAMES} - set(drawn):
        path.unlink(missing_ok=True)
    return drawn


def save_small(figure, path, most):
    """Write a PNG for a document at the highest resolution at which it is small enough.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    path : Path
    most : int
        Bytes that it may have.

    Raises
    ------
    ValueError
        If it has more even at the lowest resolution; the file is then left at that.
    """
    for dpi in RESOLUTIONS:
        figure.savefig(path, dpi=dpi, pil_kwargs={"optimize": True}, metadata={"Software": None})
        if path.stat().st_size <= most:
            return
    raise ValueError(f"{path}: more than {most} bytes at {dpi} dots an inch")


def listed(drawn):
    """The pictures that were drawn, a line each, and why a breaker is missing, if it is."""
    lines = [str(path) for path in drawn]
    names = {path.stem for path in drawn}
    if "tank" in names and "breaker" not in names:
        lines.append("(no breaker.png: no wave is seen to overturn, or to have an upright front)")
    return lines


def _figures(run):
    """Name and figure of each picture that the files hold something for, one after the other."""
    case = run.tables
    if run.frames:
        yield "tank", draw_tank(run.frames, case)
        if "pressure" in case["output"]["fields"] and case["fluid"]["gravity"]:
            yield "pressure", draw_tank(run.frames, case, "pressure")
        breaker = draw_breaker(run.frames, case)
        if breaker:
            yield "breaker", breaker
    for name, draw in (("gauges", draw_gauges), ("probes", draw_probes)):
        series = getattr(run, name)
        if len(series) and len(series.dtype.names) > 1:
            yield name, draw(series, case)
    if len(run.steps):
        yield "energy", draw_energy(run.steps, case)
        yield "solver", draw_solver(run.steps, case)


def _stack(count, case, title, height=1.7, right=sheet.RIGHT):
    """Figure of panels above each other with a common axis of time."""
    figure, axes = sheet.make(count, 1, height, heading(case, title), right=right, sharex=True)
    for ax in axes[:, 0]:
        ax.grid(color="0.9", linewidth=0.6)
    axes[-1, 0].set_xlabel("time [s]")
    return figure, axes[:, 0]


def _draw_reading(ax, time, values, unit):
    """Readings of an instrument; what is off the scale of the others is marked at its edge."""
    ax.plot(time, values)
    low, high = _limits(values)
    if not low < high:
        return
    for beyond, edge, marker in ((values > high, high, "^"), (values < low, low, "v")):
        if beyond.any():
            extreme = float(f"{values[beyond].max() if edge == high else values[beyond].min():.3g}")
            ax.plot(time[beyond], np.full(np.count_nonzero(beyond), edge), marker, color=COLOURS[1],
                    markersize=6, linestyle="", clip_on=False,
                    label=f"off the scale, to {extreme:,g} {unit}",
                    )  # fmt: skip
    margin = 0.05 * (high - low)
    ax.set_ylim(low - margin, high + margin)


def _limits(values):
    """Least and largest reading, without single readings that are far from all medians."""
    values = values[np.isfinite(values)]
    if len(values) < MEDIAN:
        return (values.min(), values.max()) if len(values) else (0.0, 0.0)
    medians = np.median(np.lib.stride_tricks.sliding_window_view(values, MEDIAN), axis=1)
    low, high = medians.min(), medians.max()
    reach = OUTLYING * (high - low)
    inside = values[(values >= low - reach) & (values <= high + reach)]
    return inside.min(), inside.max()


def _place(instrument, case, axes):
    """Name and place of a gauge or probe, along the axes that the tank has."""
    axes = [axis for axis in axes if axis != "y" or case["tank"]["width"]]
    where = ", ".join(f"{axis} = {instrument[axis]:g} m" for axis in axes if axis in instrument)
    return f"{instrument['name']}, {where}"


def draw_gauges(gauges, case):
    """Surface elevation above still water against time, one panel for each gauge.

    If the case lays out boxes of water that do not stand at one level, the level above z = 0.

    Parameters
    ----------
    gauges : structured array (n,)
        As of `mpslab.analysis.results.Run` and of a Simulation.
    case : dict
        The case as its TOML file holds it.

    Returns
    -------
    matplotlib Figure
    """
    time, *names = gauges.dtype.names
    places = {gauge["name"]: _place(gauge, case, "xy") for gauge in case.get("gauge", ())}
    still = still_level(case)
    zero, what = (0.0, "level") if still is None else (still, "elevation")
    title = "Water level above z = 0" if still is None else "Surface elevation above still water"
    figure, axes = _stack(len(names), case, f"{title} at the gauges; no line where it is dry", 1.4)
    for ax, name in zip(axes, names, strict=True):
        ax.axhline(0.0, color="0.6", linewidth=0.8)
        _draw_reading(ax, gauges[time], gauges[name] - zero, "m")
        _name(ax, places.get(name, name))
        ax.set_ylabel(f"{what} [m]")
    return figure


def draw_probes(probes, case):
    """Pressure against time, one panel for each probe.

    Parameters
    ----------
    probes : structured array (n,)
        As of `mpslab.analysis.results.Run` and of a Simulation.
    case : dict
        The case as its TOML file holds it.

    Returns
    -------
    matplotlib Figure
    """
    places = {probe["name"]: _place(probe, case, "xyz") for probe in case.get("probe", ())}
    pressures = [name for name in probes.dtype.names if name.endswith(" pressure")]
    figure, axes = _stack(len(pressures), case, "Pressure at the probes", 1.4)
    for ax, name in zip(axes, pressures, strict=True):
        _draw_reading(ax, probes["time"], probes[name], "Pa")
        name = name.removesuffix(" pressure")
        _name(ax, places.get(name, name))
        ax.set_ylabel("pressure [Pa]")
    return figure


def _name(ax, text):
    """The panel's name, and the legend of what is off its scale, above its top edge."""
    ax.set_title(text, loc="left")
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.0, ncols=2)


def draw_energy(steps, case):
    """Kinetic energy, and gain of potential and total energy since the start, against time.

    Parameters
    ----------
    steps : structured array (steps,)
        As of `mpslab.analysis.results.Run` and of a Simulation.
    case : dict
        The case as its TOML file holds it.

    Returns
    -------
    matplotlib Figure
    """
    time, kinetic = steps["time"], steps["kinetic_energy"]
    gained = steps["potential_energy"] - steps["potential_energy"][0]
    figure, (ax,) = _stack(1, case, "Energy of the water", 3.6)
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
    steps : structured array (steps,)
        As of `mpslab.analysis.results.Run` and of a Simulation.
    case : dict
        The case as its TOML file holds it.

    Returns
    -------
    matplotlib Figure
    """
    time, seconds = steps["time"], steps["seconds"]
    title = f"{len(time)} steps in {seconds.sum():.4g} s: {seconds.mean():.3g} s a step"
    figure, (top, middle, bottom) = _stack(3, case, title, right=LIMITS)
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
            steps["time"][held],
            1e3 * steps["dt"][held],
            s=5,
            color=colour,
            label=limit,
            zorder=2,
        )
    ax.set_ylabel("time step [ms]")
    ax.set_ylim(bottom=0)
    ax.legend(title="limit", loc="center left", bbox_to_anchor=(1.0, 0.5), markerscale=3)
