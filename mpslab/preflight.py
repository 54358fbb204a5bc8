"""What a case will be like, worked out before any step: size, cost, and the wave it asks for."""

import math
from dataclasses import dataclass, field

import numpy as np

from mpslab import balance, breaking, filling, gates, geometry, memory, obstacles, waves
from mpslab import bed as beds
from mpslab.cases.doubts import warnings
from mpslab.cases.sizes import sizes
from mpslab.census import census
from mpslab.kinds import KIND_NAMES
from mpslab.output import PROBE_QUANTITIES, STEP_COLUMNS
from mpslab.piston import make_paddle
from mpslab.step import slabs_of, solver_of

# Measured on one core of a 2023 server processor with the recipe "standard".
SECONDS_PER_PARTICLE_STEP = {2: 2.4e-6, 3: 4.8e-6}
BYTES_PER_PARTICLE = {2: 900, 3: 2200}
BYTES_OF_PROGRAM = 120e6
BYTES_PER_ENTRY = 40  # of a table's row, in memory
# Of a particle in a frame on the disk, packed: its place (""), and each field that is not near to
# the same for all.
BYTES_PER_POINT = {"": 11.0, "velocity": 10.0, "pressure": 3.5, "number_density": 3.5}
BYTES_PER_NUMBER = 20.0  # of an entry of a table on the disk
LEAST_STROKE = 0.1  # spacings
REGULAR = ("linear", "second_order", "cnoidal")


@dataclass
class Preflight:
    """Findings about a case: lines of (name, value) under headings, and warnings."""

    sections: dict = field(default_factory=dict)
    warnings: list = field(default_factory=list)

    def text(self):
        """The findings as plain lines."""
        lines = []
        for heading, entries in self.sections.items():
            lines.append(heading)
            lines += [f"  {name:<28} {value}" for name, value in entries]
        lines += [f"Warning: {warning}" for warning in self.warnings]
        return "\n".join(lines)


def preflight(case):
    """Work out the findings for a case, from numbers alone: lays out nothing and runs no step.

    Raises
    ------
    ValueError
        If the wavemaker cannot make the wave, or the run is larger than any can be.
    """
    size = sizes(case)
    paddle = make_paddle(case)
    report = Preflight(warnings=list(warnings(case, paddle)))
    count = census(case, paddle.backmost if paddle else 0.0)
    report.sections["Particles"] = _particles(case, count)
    report.sections["Cost (one core, rough)"] = _cost(case, count.sum(), size, report.warnings)
    report.sections["Results (rough)"] = _results(case, count.sum(), size)
    if paddle:
        report.warnings += [*paddle.doubts, *_hardly_moves(case, paddle)]
    if paddle and paddle.stroke > 0.0:
        report.sections["Wavemaker"] = _wavemaker(case, paddle)
        if paddle.height > 0.0:
            describe = _regular_wave if case.wavemaker.type in REGULAR else _solitary_wave
            report.sections["Wave"] = describe(case, paddle.height, report.warnings)
    return report


def check_ranks(case, ranks):
    """Raise ValueError if a case cannot be shared out among so many ranks."""
    solver_of(case, ranks)
    if ranks > 1:
        slabs = slabs_of(case, make_paddle(case))
        # Of slabs that are alike, more than there are ranks change nothing.
        balance.cut(case.parallel.balance, np.ones(min(slabs.count, ranks + 1)), ranks)


def _particles(case, count):
    counts = np.round(count).astype(int)
    kinds = ", ".join(f"{n:,} {name}" for n, name in zip(counts, KIND_NAMES, strict=True) if n)
    spacing = case.particles.spacing
    size = f"{geometry.effective_length(case):.4g} m long"
    if case.tank.width > 0.0:
        size += f", {geometry.rows_across(case) * spacing:.4g} m wide"
    return [
        ("particles", f"{counts.sum():,} ({kinds})"),
        ("spacing", f"{spacing * 1e3:g} mm, {case.tank.deepest / spacing:.3g} over the depth"),
        ("tank in whole spacings", size),
        *_water(case),
        *_obstacles(case),
        *_gates(case),
    ]


def _water(case):
    """Faces of the boxes of water as they are laid out, where they are no whole spacings."""
    for i, box in enumerate(case.water):
        low, high = filling.laid(case, box.start, box.end)
        axes = [0, 1] if case.dim == 3 else [0]
        if any(abs(a - b) > 1e-6 * case.particles.spacing for k in axes
               for a, b in ((low[k], box.start[k]), (high[k], box.end[k]))):  # fmt: skip
            sides = [f"{'xy'[k]} {low[k]:.4g} m to {high[k]:.4g} m" for k in axes]
            yield f"water.{i} in whole spacings", ", ".join(sides)


def _obstacles(case):
    """Faces of the obstacles as they are laid out."""
    axes = "xyz" if case.dim == 3 else "x z"
    for i, (low, high) in enumerate(obstacles.blocks(case) * case.particles.spacing):
        sides = [
            f"{axis} {_face(low[k], axis)} to {_face(high[k], axis)}"
            for k, axis in enumerate(axes)
            if axis != " "
        ]
        yield f"obstacle.{i} in whole spacings", ", ".join(sides)


def _gates(case):
    """Faces of the gates as they are laid out."""
    for i, (low, high) in enumerate(gates.faces(case)):
        yield f"gate.{i} in whole spacings", f"x {low:.4g} m to {high:.4g} m"


def _face(place, axis):
    if np.isfinite(place):
        return f"{place:.4g} m"
    return "bed" if axis == "z" else "wall"


def _cost(case, n, size, notes):
    passes = size.steps + case.scheme.settling
    seconds = passes * n * SECONDS_PER_PARTICLE_STEP[case.dim]
    needed = BYTES_OF_PROGRAM + n * BYTES_PER_PARTICLE[case.dim]
    needed += BYTES_PER_ENTRY * sum(_entries(case, size).values())
    there = memory.physical()
    if there and needed > there:
        notes.append(
            f"the run needs about {needed / 1e9:,.0f} GB of memory, and this machine has "
            f"{there / 1e9:,.0f} GB"
        )
    return [
        ("expected time step", f"{size.step:.2g} s"),
        ("limit of the time step", size.limit),
        ("expected steps", f"{size.steps:,} to t = {case.time.end:g} s"),
        ("expected run time", _duration(seconds)),
        ("expected memory", f"{needed / 1e6:,.0f} MB"),
    ]


def _entries(case, size):
    """Entries of the tables of a run, by name."""
    return {
        "steps": size.steps * len(STEP_COLUMNS),
        "gauges": size.readings * (1 + len(case.gauge)),
        "probes": size.readings * (1 + len(PROBE_QUANTITIES) * len(case.probe)),
    }


def _results(case, n, size):
    """Number and size of what the run writes."""
    fields = ("", *case.output.fields)
    frame = n * sum(BYTES_PER_POINT.get(name, 0.1) for name in fields)
    tables = BYTES_PER_NUMBER * sum(_entries(case, size).values())
    return [
        ("frames", f"{size.frames:,} of {_bytes(frame)}, {_bytes(size.frames * frame)}"),
        ("tables", f"{size.steps:,} rows of steps, {size.readings:,} of gauges, {_bytes(tables)}"),
    ]


def _bytes(number):
    for unit, size in (("GB", 1e9), ("MB", 1e6)):
        if number >= size:
            return f"{number / size:,.1f} {unit}"
    return f"{number / 1e3:.0f} kB"


def _duration(seconds):
    if seconds < 120.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200.0 else f"{seconds / 3600:.1f} h"


def _hardly_moves(case, paddle):
    if case.wavemaker.type != "still" and paddle.stroke < LEAST_STROKE * case.particles.spacing:
        yield (
            f"the piston moves by {paddle.stroke:.2g} m only until time.end = {case.time.end:g} s, "
            "less than a tenth of particles.spacing"
        )


def _wavemaker(case, paddle):
    return [
        ("type", case.wavemaker.type),
        ("stroke", f"{paddle.stroke * 1e3:.3g} mm"),
        ("theory", paddle.note),
        *paddle.facts,
    ]


def _regular_wave(case, height, notes):
    depth, gravity, period = case.tank.paddle_depth, case.fluid.gravity, case.wavemaker.period
    length = waves.wavelength(period, depth, gravity)
    lines = [
        ("height H", f"{height * 1e3:.3g} mm, {height / case.particles.spacing:.3g} spacings"),
        ("wavelength L", f"{length:.4g} m (linear theory)"),
        ("kh", f"{2 * math.pi * depth / length:.3g}"),
        ("H/h, H/L", f"{height / depth:.3g}, {height / length:.3g}"),
        ("Ursell number H L^2/h^3", f"{waves.ursell(height, length, depth):.3g}"),
        ("second order piston theory", _madsen(height, length, depth)),
    ]
    return lines + _beach(case, height, notes)


def _madsen(height, length, depth):
    limit = f"H L^2/h^3 < {breaking.MADSEN_URSELL_LIMIT:.3g}"
    inside = breaking.madsen_in_range(height, length, depth)
    return f"in range ({limit})" if inside else f"out of range ({limit}); cnoidal regime"


def _beach(case, height, notes):
    slope = waterline_slope(case)
    if slope <= 0.0:
        return []
    depth, gravity, period = case.tank.paddle_depth, case.fluid.gravity, case.wavemaker.period
    deep_height = height / waves.shoaling_coefficient(period, depth, gravity)
    deep_length = waves.deep_wavelength(period, gravity)
    xi = breaking.surf_similarity(slope, deep_height, deep_length)
    kind = breaking.breaker_type(xi)
    lines = [("surf similarity", f"{xi:.3g} on the slope of {slope:.3g}: {kind}")]
    if kind == "surging":
        return lines
    steep = breaking.GODA_STEEPEST
    outside = "" if slope <= steep * (1.0 + 1e-9) else (
        f"; outside of its range, slopes up to {steep:g}")  # fmt: skip
    at, breaker = breaking.breaking_point(deep_height, period, slope, gravity)
    runup = breaking.hunt_runup(deep_height, period, slope, gravity)
    lines.append(
        (
            "breaking point (Goda 2010)",
            f"depth {at * 1e3:.3g} mm, height {breaker * 1e3:.3g} mm{outside}",
        )
    )
    lines.append(("run-up (Hunt)", f"{runup * 1e3:.3g} mm above still water"))
    top = max(z for _, z in case.tank.bed)
    highest = case.tank.depth + runup
    if top < highest:
        notes.append(
            f"run-up of {highest:.4g} m would reach over the beach, whose top is at {top:g} m"
        )
    if at < 5.0 * case.particles.spacing:
        notes.append(
            f"the wave breaks in a depth of {at / case.particles.spacing:.2g} spacings; a clear "
            f"plunging jet wants 5 or more (particles.spacing <= {at / 5:.2g} m)"
        )
    return lines


def _solitary_wave(case, height, notes):
    depth, gravity = case.tank.paddle_depth, case.fluid.gravity
    celerity = waves.solitary_celerity(height, depth, gravity)
    lines = [
        ("height H", f"{height * 1e3:.3g} mm, {height / case.particles.spacing:.3g} spacings"),
        ("H/h", f"{height / depth:.3g}"),
        ("celerity", f"{celerity:.3g} m/s"),
    ]
    slope = waterline_slope(case)
    if slope > 0.0:
        breaks = breaking.synolakis_breaks(height, depth, slope)
        lines.append(
            ("run-up on the beach", "breaks" if breaks else "does not break (Synolakis 1987)")
        )
    return lines


def waterline_slope(case):
    """Slope of the bed where the still water meets it [-]; 0 where it meets the end wall."""
    x, z = np.array(case.tank.bed).T
    dry = np.flatnonzero(z > case.tank.depth)
    if len(dry) == 0:
        return 0.0
    return float(beds.slope(case.tank.bed, x[dry[0]] - 1e-9))
