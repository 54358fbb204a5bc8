"""What comes back from the piston after the end of a train of waves."""

import numpy as np

from mpslab.analysis.harmonics import harmonics
from mpslab.theory import absorption
from mpslab.theory.dispersion import group_velocity
from validation.comparison import Comparison

PERIODS = 2  # that the harmonic of the train is taken over
SETTLE = 1.0  # periods before its end, in which it fades out
TAIL = 2.5  # periods after the end of the train in which its slower waves come
WINDOW = 3.0  # spacings that the piston's gauge reaches
KH = np.linspace(0.2, 3.0, 57)


def compare(runs):
    """Reflection by depth, of a piston tuned to other waves, and the standing wave that lasts."""
    result = Comparison()
    trains = {name: _Train(name, run) for name, run in runs.items() if name != "standing"}
    tuned = [train for train in trains.values() if train.tuned]
    result.measure("reflection", 100.0 * max(train.reflected for train in tuned))
    others = [train.reflected - train.theory for train in trains.values() if not train.tuned]
    if others:
        result.measure("wrong", 100.0 * max(others, key=abs))
    _draw(result, [*trains.values()])
    if "standing" in runs:
        _last(result, runs["standing"])
    columns = ["run", "kh", "at the wall, in the train [mm]", "after it [mm]", "reflected [%]",
               "by linear theory [%]", "over periods"]  # fmt: skip
    result.table("First harmonic at the wall", columns, [
        [train.name, train.kh, 1e3 * train.before, 1e3 * train.after, 100.0 * train.reflected,
         100.0 * train.theory, train.whole] for train in trains.values()
    ])  # fmt: skip
    return result


def _draw(result, trains):
    figure = result.figure("Reflection of the piston", "kh", "reflected / came in")
    depth, gravity = trains[0].depth, trains[0].run.gravity
    rate = np.sqrt(gravity * KH / depth * np.tanh(KH))
    gauge = absorption.Gauge(rate, depth, gravity, WINDOW * 0.01)
    long = np.abs(gauge.reflection(lambda w: np.full(len(w), np.sqrt(gravity / depth)) + 0j))
    figure.dashed("law of long waves, linear theory", KH, long)
    figure.dashed("law tuned to the wave, linear theory", KH, 0.0 * KH)
    for label, is_tuned in (("tuned, measured", True), ("tuned to twice the period", False)):
        mine = [train for train in trains if train.tuned == is_tuned]
        if mine:
            points = [[train.kh for train in mine], [train.reflected for train in mine]]
            figure.points(label, *points)
    wrong = [train for train in trains if not train.tuned]
    if wrong:
        figure.points("tuned to twice the period, linear theory", [train.kh for train in wrong],
                      [train.theory for train in wrong])  # fmt: skip
    for train in trains:
        figure = result.figure(f"Level at the wall, {train.name}", "t / T", "level / h - 1")
        figure.line("level", train.time / train.period, train.level / train.depth)
        place = train.run.table("piston")
        figure.line("piston off its motion / h", place["time"] / train.period,
                    place["absorbing"] / train.depth)  # fmt: skip


def _last(result, run):
    """A standing wave of a hundred periods: its height, and the place of the piston."""
    period = run.case.wavemaker.period
    time, level = run.gauge("wall")
    height = {
        start: abs(harmonics(time, level - run.depth, period, start * period, 10)[1])
        for start in (10, 93)
    }
    result.measure("lasting", height[93] / height[10])
    table, stroke = run.table("piston"), run.preflight["wavemaker"]["stroke [m]"]
    start = table["time"] - 50.0 * period
    whole = np.floor(start[start >= 0.0] / period).astype(int)
    place = table["absorbing"][start >= 0.0]
    means = np.bincount(whole, place) / np.bincount(whole)
    result.measure("drift", 100.0 * np.abs(means).max() / stroke)
    figure = result.figure("A hundred periods", "t / T", "over h")
    figure.line("level at the wall", time / period, (level - run.depth) / run.depth)
    figure.line("piston off its motion", table["time"] / period, table["absorbing"] / run.depth)


class _Train:
    """A train at the wall: as it comes, and what comes again when it has ended.

    Attributes: before, after [m]; reflected, theory [-]; whole, periods that `after` is of.
    """

    def __init__(self, name, run):
        self.name, self.run, self.depth = name, run, run.depth
        self.tuned = name.startswith("kh")
        self.kh = float(name.partition("-")[2])
        rate = np.sqrt(run.gravity * self.kh / run.depth * np.tanh(self.kh))
        self.period = 2.0 * np.pi / rate
        self.time, level = run.gauge("wall")
        self.level = level - run.depth
        maker = run.preflight["wavemaker"]
        length = run.case.tank.length
        way = length / float(group_velocity(np.array([rate]), run.depth, run.gravity)[0])
        ended = maker["end [s]"] + way
        self.before = self._amplitude(ended - (SETTLE + PERIODS) * self.period, PERIODS)
        # The end of what the piston reflected is there one round trip after that of the train.
        self.whole = int(2.0 * way / self.period - TAIL)
        self.after = self._amplitude(ended + 2.0 * way - self.whole * self.period, self.whole)
        self.reflected = self.after / self.before
        self.theory = self._theory(rate)

    def _amplitude(self, start, periods):
        return abs(harmonics(self.time, self.level, self.period, start, periods)[1])

    def _theory(self, rate):
        case, window = self.run.case, WINDOW * self.run.spacing
        delay, own = 0.5 * case.time.maximum, 2.0 * np.pi / case.wavemaker.period
        law = absorption.tuned(
            absorption.Gauge(np.array([own]), self.depth, self.run.gravity, window), delay
        )
        gauge = absorption.Gauge(np.array([rate]), self.depth, self.run.gravity, window)
        return float(np.abs(gauge.reflection(law))[0])
