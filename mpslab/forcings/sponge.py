"""Zones in which the water is led to rest, or to a wave: [[sponge]].

The force is - r (u - v), with v what the water is led to. r grows from 0, where the zone begins, as
the square of the way into it; where it ends it is `strength` times the wave's angular frequency. A
step takes no more than all of u - v, however large r is.
"""

import math

import numpy as np

from mpslab.core.keys import require
from mpslab.theory import sponge, stream_function


def make(case):
    """The zones of a case, None without any."""
    zones = [_zone(case, one) for one in case.sponge]
    if not zones:
        return None

    def lead(position, velocity, time):
        return sum(zone(position, velocity, time) for zone in zones)

    return lead


def _zone(case, one):
    largest, step = strength_of(case, one) * _rate(case, one), case.time.maximum
    wave = wave_of(case, one) if one.target == "wave" else None
    bed = case.tank.bed[0][1]

    def lead(position, velocity, time):
        share = (position[:, 0] - one.start) / (one.end - one.start)
        rate = -np.expm1(-largest * step * sponge.profile(share)) / step
        gone = velocity
        if wave:
            angle = wave.number * (position[:, 0] - wave.celerity * time)
            u, w = wave.velocity(angle, np.maximum(position[:, 2] - bed, 0.0))
            rise = min(time / wave.period, 1.0)
            rise = rise * rise * (3.0 - 2.0 * rise)
            gone = velocity - rise * np.column_stack([u, np.zeros(len(u)), w])
        return -rate[:, np.newaxis] * gone

    return lead


def period_of(case, one):
    """Period of the waves that a zone is for [s]."""
    return one.period or case.wavemaker.period


def _rate(case, one):
    return 2.0 * math.pi / period_of(case, one)


def wave_of(case, one):
    """The wave that a zone makes; ValueError if there is none such."""
    return stream_function.solve(
        one.height, period_of(case, one), case.tank.paddle_depth, case.fluid.gravity
    )


def strength_of(case, one):
    """Damping at the end of a zone in angular frequencies of the wave [-]."""
    return one.strength or sponge.best(*_before_a_wall(case, one))


def reflection(case, one):
    """What a zone reflects of its waves by linear theory [-]."""
    rate, depth, gravity, length, behind = _before_a_wall(case, one)
    largest = strength_of(case, one) * rate
    return sponge.reflection(rate, depth, gravity, length, largest, behind)


def _before_a_wall(case, one):
    """Frequency, depth, gravity, length of a zone, and the way from its end to the wall."""
    behind = case.tank.length - one.end if one.end > one.start else one.end
    depth = case.tank.depth - float(case.tank.bed_height(one.start))
    return _rate(case, one), depth, case.fluid.gravity, abs(one.end - one.start), behind


def check(case):
    """Raise CaseError if a zone does not fit its tank, or its waves are not known."""
    length = case.tank.length
    for i, one in enumerate(case.sponge):
        where = f"sponge.{i}"
        for name, value in (("from", one.start), ("to", one.end)):
            rule = f"from 0 to tank.length = {length:g} m"
            require(value <= length * (1.0 + 1e-9), f"{where}.{name}", value, rule)
        least = 3.0 * case.particles.spacing
        rule = f"{least:g} m or more away from {where}.from = {one.start:g} m, three spacings"
        require(abs(one.end - one.start) >= least * (1.0 - 1e-9), f"{where}.to", one.end, rule)
        rule = "> 0 s, or wavemaker.period > 0 s: the strength is told in frequencies of the wave"
        require(period_of(case, one) > 0.0, f"{where}.period", one.period, rule)
        dry = float(case.tank.bed_height(one.start)) >= case.tank.depth
        require(not dry, f"{where}.from", one.start, "where there is water at rest")
        gravity = case.fluid.gravity
        require(gravity > 0.0, "fluid.gravity", gravity, "> 0 with a [[sponge]]")
        if one.target == "wave":
            require(one.height > 0.0, f"{where}.height", one.height, "> 0 m for target = 'wave'")
            try:
                wave_of(case, one)
            except ValueError as error:
                require(False, f"{where}.height", one.height, f"that of a wave there is: {error}")
