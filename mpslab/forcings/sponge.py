"""Zones in which the water is brought to rest: [[sponge]].

The acceleration is - r u. r grows from 0, where the zone begins, with the square of the distance
into it; where the zone ends, r is `strength` times the wave's angular frequency. However large r
is, a step takes no more than all of u.
"""

import math

import numpy as np

from mpslab.core.keys import require
from mpslab.theory import sponge


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

    def lead(position, velocity, time):
        share = (position[:, 0] - one.start) / (one.end - one.start)
        rate = -np.expm1(-largest * step * sponge.profile(share)) / step
        return -rate[:, np.newaxis] * velocity

    return lead


def period_of(case, one):
    """Period of the waves that a zone is for [s]."""
    return one.period or case.wavemaker.period


def _rate(case, one):
    return 2.0 * math.pi / period_of(case, one)


def strength_of(case, one):
    """r at the end of a zone, in angular frequencies of the wave [-]."""
    return one.strength or sponge.best(*_before_a_wall(case, one))


def reflection(case, one):
    """What a zone reflects of its waves by linear theory [-]."""
    rate, depth, gravity, length, behind = _before_a_wall(case, one)
    largest = strength_of(case, one) * rate
    return sponge.reflection(rate, depth, gravity, length, largest, behind)


def _before_a_wall(case, one):
    """Frequency, depth, gravity, length of a zone, and the distance from its end to the wall."""
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
