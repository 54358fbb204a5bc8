"""Incident and reflected waves before a sponge, and what is left of them in it."""

import numpy as np

from mpslab.analysis.harmonics import harmonics
from mpslab.analysis.reflection import separate
from mpslab.theory import sponge
from mpslab.theory.dispersion import wave_numbers
from validation.comparison import Comparison

PERIODS = 4  # that the harmonics are taken over, the last of the run
KH = np.linspace(0.3, 3.0, 28)


def compare(runs):
    """Reflection by depth, and the waves along each sponge."""
    result = Comparison()
    found = [_Zone(run) for run in runs.values()]
    result.measure("reflection", 100.0 * max(zone.reflected for zone in found))
    _draw(result, found)
    columns = ["kh", "strength", "goes in [mm]", "comes back [mm]", "reflected [%]",
               "by linear theory [%]", "at the wall [%]", "off the fit [mm]"]  # fmt: skip
    result.table("First harmonic", columns, [
        [zone.kh, zone.strength, 1e3 * zone.incident, 1e3 * zone.incident * zone.reflected,
         100.0 * zone.reflected, 100.0 * zone.theory, 100.0 * zone.behind, 1e3 * zone.residual]
        for zone in found
    ])  # fmt: skip
    return result


def _draw(result, found):
    figure = result.figure("Reflection of one wavelength of sponge", "kh", "comes back / goes in")
    depth, gravity = found[0].run.depth, found[0].run.gravity
    rates = np.sqrt(gravity * KH / depth * np.tanh(KH))
    best = []
    for kh, rate in zip(KH, rates, strict=True):
        length = 2.0 * np.pi * depth / kh
        strength = sponge.best(rate, depth, gravity, length)
        best.append(sponge.reflection(rate, depth, gravity, length, strength * rate))
    figure.dashed("linear theory, best strength", KH, best)
    figure.points("measured", [z.kh for z in found], [z.reflected for z in found])
    figure = result.figure("First harmonic along the tank", "(x - from) / L", "over what goes in")
    for zone in found:
        figure.points(f"kh = {zone.kh:.2g}", zone.along, np.abs(zone.first) / zone.incident)


class _Zone:
    """The waves of a run.

    Attributes: kh, strength; incident, residual [m]; reflected, theory, behind [-]; along (n,) in
    wavelengths from the beginning of the sponge, and first (n,) complex128 [m] at the gauges.
    """

    def __init__(self, run):
        self.run, period = run, run.case.wavemaker.period
        rate = 2.0 * np.pi / period
        (k,) = wave_numbers(np.array([rate]), run.depth, run.gravity)
        start = run.case.time.end - PERIODS * period
        gauges = run.case.gauge
        self.first = np.array([
            harmonics(time, level - run.depth, period, start, PERIODS)[1]
            for time, level in (run.gauge(gauge.name) for gauge in gauges)
        ])  # fmt: skip
        free = np.array([gauge.name.startswith("free") for gauge in gauges])
        x = np.array([gauge.x for gauge in gauges])
        incident, reflected, residual, _ = separate(
            self.first[free, np.newaxis], x[free], np.array([k])
        )
        (told,) = run.preflight["sponges"]
        self.kh, self.incident = float(k * run.depth), float(abs(incident[0]))
        self.reflected = float(abs(reflected[0])) / self.incident
        self.residual = float(np.sqrt(residual[0]))
        self.behind = float(abs(self.first[-1])) / self.incident
        self.theory, self.strength = told["reflection"], told["strength"]
        self.along = (x - told["from [m]"]) * k / (2.0 * np.pi)
