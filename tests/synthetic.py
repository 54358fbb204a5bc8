"""A run folder without a run: waves that were drawn, not computed."""

import numpy as np
from tanks import add_step, open_tables

from mpslab.core.kinds import PISTON as PISTON_FACE
from mpslab.core.particles import FACE, FILLER, FLUID, PISTON, TANK, WATER, make_particles
from mpslab.output.run_folder import RunFolder
from mpslab.output.vtkhdf import ParticleSeries

LENGTH, DEPTH = 0.8, 0.04
BED = [[0.0, 0.0], [0.2, 0.0], [0.8, 0.06]]

CASE = """\
name = "drawn"
title = "Plunging breaker on a slope of 1/10"

[tank]
length = {length}
depth = {depth}
width = {width}
bed = {bed}

[fluid]
density = 1000.0
gravity = 9.81

[initial]
type = "rest"
amplitude = 0.0

[wavemaker]
type = "linear"
height = 0.03
period = 0.777
stroke = 0.0

[particles]
spacing = {spacing}

[scheme]
recipe = "standard"
gradient = "corrected"

[output]
fields = ["velocity", "pressure"]
pictures = {pictures}

[[gauge]]
name = "g1"
x = 0.2

[[gauge]]
name = "g2"
x = 0.4

[[probe]]
name = "p1"
x = 0.2
y = 0.0
z = 0.01
"""


def bed_height(x):
    return np.interp(x, *np.transpose(BED))


def tank(time, spacing, breaks=True):
    """Wave that runs up the slope; after 1 s its crest throws a jet."""
    lattice = np.arange(-0.02, LENGTH + 0.02, spacing) + spacing / 2
    x, z = (a.ravel() for a in np.meshgrid(lattice, lattice[lattice < 0.14], indexing="ij"))
    crest = 0.12 + 0.42 * time
    height = 0.02 * min(time / 0.5, 1.0)
    level = DEPTH + height * np.exp(-(((x - crest) / 0.07) ** 2))
    bed, floor = bed_height(x), 4 * spacing
    role = np.full(len(x), -1)
    role[(z > bed) & (z < level) & (x > 0) & (x < LENGTH)] = FLUID
    if breaks and time > 1.0:
        role[_jet(x - crest - 0.04, z - DEPTH - 0.012, 0.10 * (time - 0.9))] = FLUID
    wall = (z < bed) | (x < 0) | (x > LENGTH)
    depth_in_wall = np.maximum(np.maximum(bed - z, -x), x - LENGTH)
    role[wall & (depth_in_wall < floor)] = FILLER
    role[wall & (depth_in_wall < spacing)] = FACE
    body = np.where(role == FLUID, WATER, TANK)
    body[wall & (x < 0) & (z > 0)] = PISTON
    keep = role >= 0
    place = np.column_stack([x, 0 * x, z])[keep]
    particles = make_particles(place, role[keep], body[keep])
    swirl = np.exp(-(((x - crest) / 0.07) ** 2))[keep] * particles.fluid * (0.5 + 10 * z[keep])
    particles.velocity[:, 0] = swirl
    return particles


def _jet(x, z, reach):
    """Sickle ahead of the crest, over air."""
    tongue = 0.010 - 6.0 * np.maximum(x, 0) ** 2
    return (x > -0.04) & (x < reach) & (z < tongue) & (z > tongue - 0.008)


def kinds_of(particles):
    """Kinds of the particles of the tank, (n,) int8."""
    beyond = PISTON_FACE - FACE
    return (particles.role + beyond * (particles.body == PISTON)).astype(np.int8)


def write_run(path, spacing=0.004, frames=26, breaks=True, pictures=(), width=0.0):
    """Run folder with all files that the pictures are drawn from."""
    folder = RunFolder.create(path)
    folder.write_case(
        CASE.format(
            length=LENGTH, depth=DEPTH, width=width, bed=BED, spacing=spacing, pictures=[*pictures]
        )
    )
    series = ParticleSeries(folder.particles, ["velocity", "pressure"])
    for time in np.linspace(0, 1.25, frames):
        particles = tank(time, spacing, breaks)
        series.append(time, particles, kinds_of(particles))
    _write_tables(folder)
    return folder


def _write_tables(folder):
    rng = np.random.default_rng(0)
    open_tables(folder, ["g1", "g2"], ["p1"])
    for step in range(1, 1001):
        time = 1.25e-3 * step
        eta = 0.01 * np.sin(8 * time) * min(time, 1.0)
        folder.add_rows("gauges", [(time, DEPTH + eta, DEPTH - eta if time < 1 else np.nan)])
        pressure = 390 + 9810 * eta + 10 * rng.normal()
        folder.add_rows("probes", [(time, pressure, eta, 0.0, -eta)])
        add_step(
            folder,
            step=step,
            time=time,
            dt=1.25e-3 * min(1.0, 1.1**step / 100) * (0.8 if time > 0.8 else 1.0),
            dt_limit="growth" if step < 50 else "courant" if time > 0.8 else "maximum",
            iterations=rng.integers(40, 60),
            residual=1e-7,
            seconds=0.2 + 0.02 * rng.random(),
            max_speed=eta,
            kinetic_energy=time**2 / 100,
            potential_energy=3 + 0.012 * time**2,
            volume=0.024,
            piston_force=30.0 + 9810.0 * eta,
            piston_work=1e-3 * eta,
            lost=0,
        )
    folder.close()
