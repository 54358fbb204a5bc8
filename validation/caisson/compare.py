"""Force of standing waves on an upright wall."""

import numpy as np

from mpslab.analysis import goda
from mpslab.analysis.harmonics import HARMONICS, harmonics
from mpslab.theory.dispersion import wave_numbers
from validation import potential_flow
from validation.comparison import Comparison
from validation.wave_analysis import separate

PERIODS = 4  # at the end of the run
WAVES = 4.0  # periods of potential flow


def compare(runs):
    """The finest run is judged."""
    result, rows = Comparison(), []
    figure = result.figure("Force on the wall, less that of still water", "t / T",
                           "force / (rho g H tanh(kh) / k)")  # fmt: skip
    for run in sorted(runs.values(), key=lambda run: -run.spacing):
        wall = _Wall(run)
        figure.line(run.label, wall.turn, wall.seen / wall.linear)
        figure.dashed("potential flow", wall.turn, wall.theory / wall.linear)
        seen, theory = wall.seen - wall.seen.mean(), wall.theory - wall.theory.mean()
        rows.append([run.label, 1e3 * wall.height, wall.height / run.case.wavemaker.height,
                     seen.max() / theory.max(), seen.min() / theory.min(),
                     wall.seen.max() / wall.goda,
                     wall.seen.mean(), wall.theory.mean()])  # fmt: skip
    for name, value in zip(("crest", "trough", "goda"), rows[-1][3:6], strict=True):
        result.measure(name, value)
    columns = ["run", "incident H [mm]", "over H asked for", "crest over potential flow",
               "trough", "crest over Goda", "mean [N/m]", "of potential flow"]  # fmt: skip
    result.table("Force on the wall", columns, rows)
    return result


class _Wall:
    """Force over a period [N/m] as it is seen, and by potential flow."""

    def __init__(self, run):
        case, gravity, depth = run.case, run.gravity, run.depth
        period, (box,) = case.wavemaker.period, case.obstacle
        start = case.time.end - PERIODS * period
        w = 2.0 * np.pi / period
        k = float(wave_numbers(w, depth, gravity))
        self.height = separate(run, case.gauge, start, PERIODS).incident_height
        weight = run.density * gravity
        self.linear = weight * self.height * np.tanh(k * depth) / k
        forces = run.table("forces")
        push = forces["wall fx"] - 0.5 * weight * depth**2
        self.turn = np.linspace(0.0, 1.0, 200, endpoint=False)
        self.seen = self._over_a_period(forces["time"], push, period, start, PERIODS)
        time, force = potential_flow.wall_force(
            float(self.height), float(np.pi / k), depth, gravity, w, WAVES
        )
        self.theory = self._over_a_period(time, weight * force, period, 0.0, int(WAVES))
        wall = goda.Wall(depth, depth, depth, box.end[2] - depth)
        self.goda = goda.load(wall, self.height, 2.0 * np.pi / k, run.density, gravity).force

    def _over_a_period(self, time, force, period, start, periods):
        """Force from its crest on, of the mean and the harmonics of these periods."""
        parts = harmonics(time, force, period, start, periods)
        parts[1:] *= np.exp(-1j * np.angle(parts[1]) * np.arange(1, HARMONICS + 1))
        turns = np.exp(2j * np.pi * np.outer(self.turn, np.arange(HARMONICS + 1)))
        return np.real(turns @ parts)
