"""What a case will be like, worked out before any step: size, cost, and the wave it asks for."""

import math
from dataclasses import dataclass

import numpy as np

from mpslab import instruments
from mpslab.cases.doubts import warnings
from mpslab.cases.sizes import sizes
from mpslab.core import bed as beds
from mpslab.core import memory
from mpslab.core.kinds import KIND_NAMES
from mpslab.core.lattice import effective_length, rows_across
from mpslab.forcings import sponge
from mpslab.parallel import balance
from mpslab.run.flow import slabs_of, solver_of
from mpslab.run.preflight_bodies import bodies
from mpslab.run.preflight_frame import tank_motion
from mpslab.run.preflight_solids import gaps, solids
from mpslab.run.preflight_text import sections
from mpslab.run.preflight_waters import waters
from mpslab.solids import filling, gates, obstacles
from mpslab.solids.absorption import SEAS
from mpslab.solids.census import census
from mpslab.solids.piston import make_paddle
from mpslab.theory import breaking, waves

# Measured on one core of a 2023 server processor with the recipe "standard".
SECONDS_PER_PARTICLE_STEP = {2: 2.4e-6, 3: 4.8e-6}
BYTES_PER_PARTICLE = {2: 900, 3: 2200}
BYTES_OF_PROGRAM = 120e6
BYTES_PER_ENTRY = 40  # of a table's row, in memory
# Of a particle in a frame on the disk, compressed: its place (""), and each field that differs from
# particle to particle.
BYTES_PER_POINT = {"": 11.0, "velocity": 10.0, "pressure": 3.5, "number_density": 3.5}
BYTES_PER_NUMBER = 20.0  # of an entry of a table on the disk
LEAST_STROKE = 0.1  # spacings
MUCH = 0.05  # that a sponge reflects
REGULAR = ("linear", "second_order", "cnoidal", "stream_function")
LAYER, THICK = 0.2, 4.0  # of the layer on a crest: over the run-up above it, and spacings wanted
SHORTEST_WAVE = 8.0  # spacings: shorter waves are damped soon


@dataclass(frozen=True)
class Preflight:
    """Findings about a case.

    Attributes
    ----------
    findings : dict
        Numbers, words, and dicts and lists of them, as JSON holds them and ``run.json`` has them
        under "preflight"; a unit stands in the name, "stroke [m]". What the case has nothing of,
        such as a wave, is left out.

        - "particles": how many of each kind; "spacing [m]", "spacings_over_depth"; "tank_length
          [m]" and "tank_width [m]" in whole spacings; "laid_out": faces of the boxes of water,
          obstacles and gates, {"gate.0": {"x [m]": [low, high]}}, None for the bed or a wall;
          "solids": of each by name its "shape", "x [m]" and so on, "thinnest [m]", "volume [m3]"
          (in 2-D "area [m2]") and, of a mesh, what was "mended" of its surface; "waters": volumes
          [m3], in 2-D areas [m2], of bodies of water that solids keep apart, where there are two;
        - "time_step [s]", "time_step_limit" (what holds it), "largest_time_step [s]", "end [s]",
          "steps", "run_time [s]" (on one core), "memory [B]";
        - "frames", "frame [B]", "readings" (rows of gauges.csv), "tables [B]";
        - "wavemaker": "type", "theory" (and its range, in a line), "paddle_depth [m]", "stroke
          [m]", "wave_height [m]" that the theory expects (of a sea Hm0), and the `facts` of the
          motion;
        - "wave": "height [m]", "height_over_depth" and, of regular waves, "wavelength [m]" (linear
          theory), "kh", "height_over_length", "ursell_number", "second_order_in_range"; of a
          solitary one "celerity [m/s]"; on a beach its "slope" and what becomes of the wave there:
          "surf_similarity", "breaker_type", "breaking_depth [m]", "breaking_height [m]",
          "breaking_in_range", "runup [m]", or of a solitary wave "breaks";
        - "tank_motion", of a tank that moves: "type", how far it goes, "sway [m]", "heave [m]" and
          "roll [deg]", "period [s]" of a sine, "largest_acceleration [m/s2]" of a place where its
          water stands; where nothing else stands in it, "natural_period [s]" of the water and, by
          linear theory, its "rise [m]" at the walls, with the "room [m]" above it;
        - "bodies", free ones by name, as `mpslab.run.preflight_bodies` finds them;
        - of an absorbing piston among the wavemaker's: "absorption" (tuned to a wave, or fitted to
          a sea), "absorption_period [s]", "reflection_at_peak", "reflection_over_spectrum", "room
          [m]";
        - "sponges": of each zone "from [m]", "to [m]", "period [s]", "wavelengths" that it is
          long, "strength" and "reflection", by linear theory;
        - "warnings": what the run may suffer from, a line each.
    """

    findings: dict

    @property
    def warnings(self):
        """What the run may suffer from, a list of lines."""
        return self.findings["warnings"]

    @property
    def sections(self):
        """The findings in words: lines of (name, value) by their heading."""
        return sections(self.findings)

    def text(self):
        """The findings as plain lines."""
        lines = []
        for heading, entries in self.sections.items():
            lines.append(heading)
            lines += [f"  {name:<28} {value}" for name, value in entries]
        lines += [f"Warning: {warning}" for warning in self.warnings]
        return "\n".join(lines)


def preflight(case):
    """Work out the findings for a case from numbers alone, without laying out a particle.

    Returns
    -------
    Preflight

    Raises
    ------
    ValueError
        If the wavemaker cannot make the wave, or the run is larger than any can be.
    """
    size = sizes(case)
    paddle = make_paddle(case)
    notes = [*warnings(case, paddle), *gaps(case)]
    count = census(case, paddle.backmost if paddle else 0.0)
    found = {
        **_particles(case, count),
        **waters(case, notes),
        **_cost(case, count.sum(), size, notes),
        **_results(case, count.sum(), size),
    }
    if paddle:
        notes += [*paddle.doubts, *_hardly_moves(case, paddle), *_unresolved(case, paddle)]
        found["wavemaker"] = _wavemaker(case, paddle)
    if case.frame.type != "none":
        found["tank_motion"] = tank_motion(case, notes)
    found |= bodies(case, notes)
    if case.sponge:
        found["sponges"] = [_sponge(case, one) for one in case.sponge]
        notes += _reflects_much(found["sponges"])
    kind = case.wavemaker.type
    if paddle and paddle.stroke > 0.0 and paddle.height > 0.0:
        if kind in (*REGULAR, *SEAS):
            period = paddle.facts.get("peak_period [s]", case.wavemaker.period)
            found["wave"] = _regular_wave(case, paddle.height, period, notes)
        elif kind == "solitary":
            found["wave"] = _solitary_wave(case, paddle.height)
    return Preflight(_plain({**found, "warnings": notes}))


def _plain(value):
    """The findings as JSON holds them, without numpy's numbers."""
    if isinstance(value, dict):
        return {name: _plain(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    return value.item() if isinstance(value, np.generic) else value


def check_ranks(case, ranks):
    """Raise ValueError if a case cannot be shared out among so many ranks."""
    solver_of(case, ranks)
    if ranks > 1:
        slabs = slabs_of(case, make_paddle(case))
        # More slabs than ranks make no difference, as these are all alike.
        balance.cut(case.parallel.balance, np.ones(min(slabs.count, ranks + 1)), ranks)


def _particles(case, count):
    spacing = case.particles.spacing
    across = rows_across(case) * spacing if case.tank.width > 0.0 else 0.0
    return {
        "particles": dict(zip(KIND_NAMES, np.round(count).astype(int), strict=True)),
        "spacing [m]": spacing,
        "spacings_over_depth": case.tank.deepest / spacing,
        "tank_length [m]": effective_length(case),
        "tank_width [m]": across,
        "laid_out": {**_water(case), **_obstacles(case), **_gates(case)},
        "solids": solids(case),
    }


def _water(case):
    """Faces of the boxes of water as they are laid out, where they are no whole spacings."""
    found = {}
    for i, box in enumerate(case.water):
        low, high = filling.laid(case, box.start, box.end)
        axes = [0, 1] if case.dim == 3 else [0]
        if any(abs(a - b) > 1e-6 * case.particles.spacing for k in axes
               for a, b in ((low[k], box.start[k]), (high[k], box.end[k]))):  # fmt: skip
            found[f"water.{i}"] = {f"{'xy'[k]} [m]": [low[k], high[k]] for k in axes}
    return found


def _obstacles(case):
    """Faces of the obstacles as they are laid out; None for the bed or a wall."""
    axes = [0, 1, 2] if case.dim == 3 else [0, 2]
    return {
        f"obstacle.{i}": {
            f"{'xyz'[k]} [m]": [face if np.isfinite(face) else None for face in (low[k], high[k])]
            for k in axes
        }
        for i, (low, high) in enumerate(obstacles.blocks(case) * case.particles.spacing)
    }


def _gates(case):
    """Faces of the gates as they are laid out."""
    return {f"gate.{i}": {"x [m]": list(faces)} for i, faces in enumerate(gates.faces(case))}


def _cost(case, n, size, notes):
    passes = size.steps + case.scheme.settling
    needed = BYTES_OF_PROGRAM + n * BYTES_PER_PARTICLE[case.dim]
    needed += BYTES_PER_ENTRY * sum(_entries(case, size).values())
    there = memory.physical()
    if there and needed > there:
        notes.append(
            f"the run needs about {needed / 1e9:,.0f} GB of memory, and this machine has "
            f"{there / 1e9:,.0f} GB"
        )
    return {
        "time_step [s]": size.step,
        "time_step_limit": size.limit,
        "largest_time_step [s]": case.time.maximum,
        "end [s]": case.time.end,
        "steps": size.steps,
        "run_time [s]": passes * n * SECONDS_PER_PARTICLE_STEP[case.dim],
        "memory [B]": needed,
    }


def _entries(case, size):
    """Entries of the tables of a run that grow with it, by name."""
    return {
        name: (size.readings if one.interval else size.steps) * len(one.columns)
        for name, one in instruments.of(case).items()
        if one.interval is not None
    }


def _results(case, n, size):
    """Number and size of what the run writes."""
    fields = ("", *case.output.fields)
    return {
        "frames": size.frames,
        "frame [B]": n * sum(BYTES_PER_POINT.get(name, 0.1) for name in fields),
        "readings": size.readings,
        "tables [B]": BYTES_PER_NUMBER * sum(_entries(case, size).values()),
    }


def _sponge(case, one):
    """Place, length and period of a zone, and what it reflects."""
    period = sponge.period_of(case, one)
    return {
        "from [m]": one.start,
        "to [m]": one.end,
        "period [s]": period,
        "wavelengths": abs(one.end - one.start) / waves.wavelength(
            period, case.tank.paddle_depth, case.fluid.gravity
        ),
        "strength": sponge.strength_of(case, one),
        "reflection": sponge.reflection(case, one),
    }  # fmt: skip


def _reflects_much(zones):
    for i, zone in enumerate(zones):
        reflected = zone["reflection"]
        if reflected > MUCH:
            yield (
                f"sponge.{i}: reflects {100 * reflected:.2g} % of waves of {zone['period [s]']:.4g}"
                f" s by theory; it is {zone['wavelengths']:.2g} wavelengths long, and longer ones "
                "reflect less"
            )


def _hardly_moves(case, paddle):
    if case.wavemaker.type != "still" and paddle.stroke < LEAST_STROKE * case.particles.spacing:
        yield (
            f"the piston moves by {paddle.stroke:.2g} m only until time.end = {case.time.end:g} s, "
            "less than a tenth of particles.spacing"
        )


def _unresolved(case, paddle):
    shortest = paddle.facts.get("shortest_wavelength [m]", math.inf)
    if shortest < SHORTEST_WAVE * case.particles.spacing:
        yield (
            f"wavemaker.band: the shortest waves of the sea, {shortest:.3g} m, are only "
            f"{shortest / case.particles.spacing:.2g} particles long, fewer than {SHORTEST_WAVE:g} "
            "damp them; a lower end of the band leaves them out"
        )


def _wavemaker(case, paddle):
    return {
        "type": case.wavemaker.type,
        "theory": paddle.note,
        "paddle_depth [m]": case.tank.paddle_depth,
        "stroke [m]": paddle.stroke,
        "wave_height [m]": paddle.height,
        **paddle.facts,
    }


def _regular_wave(case, height, period, notes):
    depth, gravity = case.tank.paddle_depth, case.fluid.gravity
    length = waves.wavelength(period, depth, gravity)
    return {
        "height [m]": height,
        "wavelength [m]": length,
        "kh": 2 * math.pi * depth / length,
        "height_over_depth": height / depth,
        "height_over_length": height / length,
        "ursell_number": waves.ursell(height, length, depth),
        "second_order_in_range": breaking.madsen_in_range(height, length, depth),
        **(_beach(case, height, period, notes) if case.wavemaker.type in REGULAR else {}),
    }


def _beach(case, height, period, notes):
    slope = waterline_slope(case)
    if slope <= 0.0:
        return {}
    depth, gravity = case.tank.paddle_depth, case.fluid.gravity
    deep_height = height / waves.shoaling_coefficient(period, depth, gravity)
    deep_length = waves.deep_wavelength(period, gravity)
    xi = breaking.surf_similarity(slope, deep_height, deep_length)
    kind = breaking.breaker_type(xi)
    found = {"slope": slope, "surf_similarity": xi, "breaker_type": kind}
    if kind == "surging":
        return found
    at, breaker = breaking.breaking_point(deep_height, period, slope, gravity)
    runup = breaking.hunt_runup(deep_height, period, slope, gravity)
    top = max(z for _, z in case.tank.bed)
    highest = case.tank.depth + runup
    if top < highest and not case.overtopping:
        notes.append(
            f"run-up of {highest:.4g} m would reach over the beach, whose top is at {top:g} m"
        )
    notes += _thin_layers(case, runup)
    if at < 5.0 * case.particles.spacing:
        notes.append(
            f"the wave breaks in a depth of {at / case.particles.spacing:.2g} spacings; a clear "
            f"plunging jet wants 5 or more (particles.spacing <= {at / 5:.2g} m)"
        )
    return found | {
        "breaking_depth [m]": at,
        "breaking_height [m]": breaker,
        "breaking_in_range": slope <= breaking.GODA_STEEPEST * (1.0 + 1e-9),
        "runup [m]": runup,
    }


def _thin_layers(case, runup):
    """Crests over which the water would come too thin, as EurOtop (2018) expects on 1:3."""
    for i, plane in enumerate(case.overtopping):
        crest = max([z for x, z in case.tank.bed if x <= plane.x])
        layer = LAYER * (case.tank.depth + runup - crest) / case.particles.spacing
        if 0.0 < layer < THICK * (1.0 - 1e-9):
            yield (
                f"overtopping.{i}: the layer on the crest would be about {layer:.2g} spacings; "
                f"{THICK:g} or more resolve it, particles.spacing <= "
                f"{layer / THICK * case.particles.spacing:.2g} m"
            )


def _solitary_wave(case, height):
    depth, gravity = case.tank.paddle_depth, case.fluid.gravity
    found = {
        "height [m]": height,
        "height_over_depth": height / depth,
        "celerity [m/s]": waves.solitary_celerity(height, depth, gravity),
    }
    slope = waterline_slope(case)
    if slope > 0.0:
        found |= {"slope": slope, "breaks": breaking.synolakis_breaks(height, depth, slope)}
    return found


def waterline_slope(case):
    """Slope of the bed where the still water meets it [-]; 0 where it meets the end wall."""
    x, z = np.array(case.tank.bed).T
    dry = np.flatnonzero(z > case.tank.depth)
    if len(dry) == 0:
        return 0.0
    return float(beds.slope(case.tank.bed, x[dry[0]] - 1e-9))
