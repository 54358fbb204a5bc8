"""Force of waves on a pile, and the level before it."""

import numpy as np

from mpslab.theory.dispersion import wave_numbers
from validation.comparison import Comparison
from validation.cylinder_in_waves import theory
from validation.wave_analysis import last_harmonic

PERIODS = 2  # at the end of the run


def compare(runs):
    """The finest run is judged; `empty-NAME` is the run without the pile."""
    result, rows = Comparison(), []
    names = sorted((name for name in runs if not name.startswith("empty")),
                   key=lambda name: -runs[name].spacing)  # fmt: skip
    figure = result.figure("Force on the pile", "t / T", "force / (rho g A h a)")
    for name in names:
        pile = _Pile(runs[name], runs[f"empty-{name}"])
        figure.line(runs[name].label, pile.time / pile.period, pile.force / pile.unit)
        rows.append([runs[name].label, 1e3 * pile.wave, pile.size, pile.lead, pile.crest])
    found = pile.theory[0] * runs[name].density * runs[name].gravity * pile.wave / pile.unit
    figure.dashed("amplitude in linear theory", [0.0, pile.time[-1] / pile.period], [found] * 2)
    result.measure("force", rows[-1][2])
    result.measure("lead", rows[-1][3])
    result.measure("crest", rows[-1][4])
    columns = ["run", "amplitude of the waves [mm]", "force over theory", "lead - theory [periods]",
               "level before the pile over theory"]  # fmt: skip
    result.table("Pile", columns, rows)
    return result


class _Pile:
    """What a run with a pile and one without it find, and linear theory of these waves."""

    def __init__(self, run, empty):
        wavemaker, (solid,) = run.case.wavemaker, run.case.solid
        self.period, depth = wavemaker.period, run.depth
        k = float(wave_numbers(2.0 * np.pi / self.period, depth, run.gravity))
        self.theory = theory.force(k, solid.radius, depth, run.case.tank.width)
        forces, gauges = run.table("forces"), run.table("gauges")
        self.time, self.force = forces["time"], forces["pile fx"]
        end = min(run.case.time.end, empty.case.time.end)
        clear = empty.table("gauges")
        wave = last_harmonic(clear["time"], clear["axis"], self.period, end, PERIODS)
        push = last_harmonic(self.time, self.force, self.period, end, PERIODS)
        front = last_harmonic(gauges["time"], gauges["front"], self.period, end, PERIODS)
        self.wave = abs(wave)
        self.unit = run.density * run.gravity * self.wave * depth * solid.radius
        self.size = abs(push / wave) / (run.density * run.gravity) / self.theory[0]
        lead = np.angle(push / wave) - self.theory[1]
        self.lead = lead / (2.0 * np.pi)
        (place,) = (gauge.x for gauge in run.case.gauge if gauge.name == "front")
        high = theory.level(k, solid.radius, place - solid.center[0])
        self.crest = abs(front / wave) / high
