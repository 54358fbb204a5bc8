"""A picture of what the wavemaker of a case will do: its motion, and the spectrum of its waves."""

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from mpslab.analysis.pictures import STYLE
from mpslab.solids.piston import make_paddle
from mpslab.theory import dispersion, spectra

SAMPLES = 40  # to the shortest period
MOST = 200_000
HIGHEST = 4.0  # times the peak frequency: the spectrum is drawn up to there


def draw(case, path):
    """Draw displacement and speed of the piston until the end of the run, and a spectrum.

    The spectrum is that of the waves that the motion makes over the whole run, by linear theory.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    path : str or Path
        File to write, such as wavemaker.png.

    Raises
    ------
    ValueError
        If the case has no wavemaker.
    """
    paddle = make_paddle(case)
    if paddle is None:
        raise ValueError("wavemaker.type = 'none': must be another one, or nothing is to draw")
    end, period = case.time.end, paddle.facts.get("peak_period [s]", case.wavemaker.period)
    shortest = period / HIGHEST or end / 100.0
    times = np.linspace(0.0, end, min(int(SAMPLES * end / shortest), MOST) + 2)
    place = np.array([paddle.displacement(t) for t in times])
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(9.0, 7.5), layout="constrained")
        upper, middle, lower = figure.subplots(3)
        upper.plot(times, 1e3 * place)
        upper.set(ylabel="displacement [mm]", title=f"{case.name}: {paddle.note}".split(":")[0])
        middle.plot(times, np.gradient(place, times), color="C1")
        middle.set(ylabel="speed [m/s]", xlabel="time [s]")
        middle.sharex(upper)
        frequency, density = spectrum(times, place, case.tank.paddle_depth, case.fluid.gravity)
        shown = frequency <= HIGHEST / period if period else frequency <= 20.0 / end
        lower.plot(frequency[shown], 1e6 * density[shown], color="C2", label="of the motion")
        if case.wavemaker.type == "irregular" and case.wavemaker.spectrum in spectra.NAMES:
            lower.plot(frequency[shown], 1e6 * _asked(case, frequency[shown]), "k--",
                       label="asked for")  # fmt: skip
        lower.legend()
        lower.set(xlabel="frequency [Hz]", ylabel="waves [mm$^2$/Hz]")
        figure.savefig(path)


def _asked(case, frequency):
    maker, depth = case.wavemaker, case.tank.paddle_depth
    return spectra.density(
        maker.spectrum, frequency, maker.height, maker.period, maker.gamma, depth,
        case.fluid.gravity,
    )  # fmt: skip


def spectrum(times, place, depth, gravity):
    """Frequencies [Hz] and variance density [m2/Hz] of a motion's waves by linear theory, (n,)."""
    step, count = times[1] - times[0], len(times)
    moved = np.fft.rfft((place - place.mean()) * np.hanning(count))[1:]
    frequency = np.fft.rfftfreq(count, step)[1:]
    k = dispersion.wave_numbers(2.0 * np.pi * frequency, depth, gravity)
    power = np.abs(moved * dispersion.biesel(k * depth)) ** 2
    return frequency, 2.0 * step * power / np.sum(np.hanning(count) ** 2)
