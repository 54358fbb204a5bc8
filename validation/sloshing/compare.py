"""Sloshing: free modes, forced ones, and a slow roll, against linear theory."""

import numpy as np
from scipy.integrate import solve_ivp

from mpslab.forcings.frame import motion_of
from mpslab.theory.waves import standing_wave_frequency
from validation.comparison import Comparison
from validation.wave_analysis import modes

FREE = {"mode-1": "period_1", "mode-1-fine": "period_1_fine", "mode-2": "period_2"}
FORCED = {"sway": "sway", "roll-low": "roll_low", "roll-high": "roll_high"}
SETTLED = 2.0  # [s] from when on the forced motion is judged, two whole periods
FADED = 2.0  # [s] from when on the slow roll is judged


def compare(runs):
    """Periods of free modes, amplitude and phase of forced ones, level of a slow roll."""
    result = Comparison()
    for name, metric in FREE.items():
        if name in runs:
            _free(result, runs[name], metric)
    for name, metric in FORCED.items():
        run = runs[name]
        time, mode = modes(run, 1)
        theory = first_mode(run.case, time)
        ratio = response(run.case, time, mode) / response(run.case, time, theory)
        result.measure(metric, abs(ratio))
        result.measure(f"{metric}_phase", -np.angle(ratio) / (2.0 * np.pi))
        figure = result.figure(f"First mode, {name}", "t [s]", "first mode / depth")
        figure.line("mpslab", time, mode / run.depth)
        figure.dashed("linear theory", time, theory / run.depth)
        result.hold(f"first mode, {name} [depths], [s]", time, mode / run.depth, time,
                    theory / run.depth)  # fmt: skip
    _slow_roll(result, runs["slow-roll"])
    return result


def _free(result, run, metric):
    tank, initial = run.case.tank, run.case.initial
    time, mode = modes(run, initial.mode)
    frequency = standing_wave_frequency(initial.mode, tank.length, run.depth, run.gravity)
    natural = 2.0 * np.pi / frequency
    result.measure(metric, period(time, mode) / natural)
    title = f"Free mode {initial.mode}, {run.label}"
    figure = result.figure(title, "t / T", "mode / amplitude")
    figure.line("mpslab", time / natural, mode / initial.amplitude)


def period(time, mode):
    """Twice the mean distance of the passes through zero [s]."""
    i = np.flatnonzero(mode[:-1] * mode[1:] < 0.0)
    passes = time[i] + mode[i] / (mode[i] - mode[i + 1]) * (time[i + 1] - time[i])
    return 2.0 * np.polyfit(np.arange(len(passes)), passes, 1)[0]


def first_mode(case, time):
    """First mode of linear potential flow from rest at t = 0 in a tank that moves, (n,) [m].

    With k = pi / l, the axis of roll z_c above the still level, displacement X and angle a::

        b'' + g k tanh(kh) b = (4 / (l k)) tanh(kh) [X'' + g a + a'' (z_c + (2 / k) tanh(kh / 2))]

    README.md says where it comes from.
    """
    tank, gravity, motion = case.tank, case.fluid.gravity, motion_of(case.frame)
    k = np.pi / tank.length
    tanh, above = np.tanh(k * tank.depth), motion.center[1] - tank.depth
    arm = above + 2.0 / k * np.tanh(0.5 * k * tank.depth)

    def rate(t, state):
        x, a, spin = motion(t, 2)[0], motion(t)[2], motion(t, 2)[2]
        push = 4.0 / (tank.length * k) * tanh * (x + gravity * a + spin * arm)
        return [state[1], push - gravity * k * tanh * state[0]]

    out = solve_ivp(rate, (0.0, time[-1]), [0.0, 0.0], t_eval=time, rtol=1e-9, atol=1e-12)
    return out.y[0]


def response(case, time, mode):
    """Complex amplitude at the period of the motion, once it has faded in [m]."""
    late = time >= SETTLED
    phase = 2.0 * np.pi / case.frame.period * time[late]
    terms = np.stack([np.ones_like(phase), np.cos(phase), np.sin(phase)], axis=1)
    _, cosine, sine = np.linalg.lstsq(terms, mode[late], rcond=None)[0]
    return cosine - 1j * sine


def _slow_roll(result, run):
    tank, motion = run.case.tank, motion_of(run.case.frame)
    middle = 0.5 * tank.length
    rows = [(t, x[:, 0].mean()) for t, x, _ in run.water()]
    time, place = np.array(rows).T
    # A wedge of slope s moves the centre of mass of the water by s l^2 / 12 h.
    slope = (place - middle) * 12.0 * run.depth / tank.length**2
    level = np.array([-np.tan(motion(t)[2]) for t in time])
    late = time >= FADED
    result.measure("slope", slope[late] @ level[late] / (level[late] @ level[late]))
    figure = result.figure("Slow roll", "t [s]", "slope of the surface in the tank")
    figure.line("mpslab", time, slope)
    figure.dashed("level in the earth's frame", time, level)
    off = []
    for gauge in run.case.gauge:
        time, height = run.gauge(gauge.name)
        late = time >= time[-1] - 1.0
        plane = [run.depth - np.tan(motion(t)[2]) * (gauge.x - middle) for t in time[late]]
        off.append(float(np.mean(height[late] - plane)) / run.spacing)
    result.measure("level", max(off, key=abs))
    rows = [[gauge.x, value] for gauge, value in zip(run.case.gauge, off, strict=True)]
    result.table("Distance from level at gauges", ["x [m]", "spacings"], rows)
