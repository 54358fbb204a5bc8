"""What the pistons for a sea share: its waves, the motion to either order, and its numbers."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mpslab.solids import paddle
from mpslab.solids.wavemakers import _bound, _record, _table
from mpslab.theory import breaking, dispersion, schaffer, spectra, waves

RECORD = 200.0  # peak periods after which a sea repeats, unless the case says otherwise
FEWEST, MOST = 5, 6000  # components; MOST counts from zero to the highest frequency
SAMPLES = 8  # to a step of a table, among which extremes are looked for
LOWEST = 0.05  # of the peak frequency: slower motions of second order are left out
LARGEST = 2.0  # highest wave of a sea over Hm0
MUCH = 0.05  # share of the spectrum whose loss is worth a line
SPECTRUM = (("frequency", "Hz"), ("variance density", "m2/Hz"))


@dataclass(frozen=True)
class Sea:
    """A spectrum in components.

    Attributes
    ----------
    height, period : float [m], [s]
        Hm0, and Tp of the peak.
    record : float [s]
        Time after which the sea repeats: frequencies are multiples of 1 / record.
    first : int
        Number of the first component.
    variance : (n,) float64 [m2]
        Of each component; their sum is Hm0^2 / 16.
    left_out : float [-]
        Share of the spectrum outside of the band.
    """

    height: float
    period: float
    record: float
    first: int
    variance: np.ndarray
    left_out: float

    @property
    def step(self):
        """Distance of two frequencies [rad/s]."""
        return 2.0 * math.pi / self.record

    @property
    def rate(self):
        """Frequencies of the components [rad/s], (n,) float64."""
        return (self.first + np.arange(len(self.variance))) * self.step


def of_wavemaker(wavemaker, depth, gravity, record):
    """The components of the spectrum of a wavemaker, `Sea`.

    `record` is in s; 0 stands for RECORD peak periods.

    Raises ValueError if height or period is not positive, the band or the record does not fit, or
    the file of a spectrum cannot be read.
    """
    height, period, density, left_out = _density(wavemaker, depth, gravity)
    low, high = band_of(wavemaker)
    record = record or RECORD * period
    least, most = FEWEST * period / (high - low), MOST * period / high
    if not least <= record <= most:
        raise ValueError(
            f"wavemaker.record = {record:g} s: must be from {least:.4g} to {most:.4g} s, for so "
            f"many frequencies in wavemaker.band = [{low:g}, {high:g}] that make a sea, and not "
            "too many"
        )
    first = math.ceil(low * record / period)
    frequency = np.arange(first, math.floor(high * record / period) + 1) / record
    variance = density(frequency) / record
    total = float(variance.sum())
    if not total > 0.0:
        raise ValueError(f"wavemaker.band = [{low:g}, {high:g}]: holds nothing of the spectrum")
    variance = variance * (height**2 / 16.0 / total)
    return Sea(height, period, record, first, variance, left_out(low / period, high / period))


def band_of(wavemaker):
    """Lowest and highest frequency of a sea, over that of its peak."""
    band = wavemaker.band
    if len(band) != 2 or not 0.1 <= band[0] < 1.0 < band[1] <= 10.0:
        raise ValueError(
            f"wavemaker.band = {list(band)}: must be two numbers, the first from 0.1 to 1 and the "
            "second from 1 to 10, in frequencies of the peak"
        )
    return band


def _density(wavemaker, depth, gravity):
    """Height, period, density by frequency, and the share outside of a band."""
    height, period, name = wavemaker.height, wavemaker.period, wavemaker.spectrum
    if name == "file":
        f, density = _of_file(wavemaker)
        height = height or 4.0 * math.sqrt(spectra.moment(f, density))
        period = period or 1.0 / float(f[np.argmax(density)])

        def shape(frequency):
            return np.interp(frequency, f, density, 0.0, 0.0)
    else:
        paddle.require_positive("height", height, "m")
        paddle.require_positive("period", period, "s")

        def shape(frequency):
            return spectra.density(
                name, frequency, height, period, wavemaker.gamma, depth, gravity
            )  # fmt: skip

        f = spectra.ALL / period
        density = shape(f)
    return height, period, shape, lambda low, high: spectra.share_outside(f, density, low, high)


def _of_file(wavemaker):
    record = _record.read(wavemaker.file, SPECTRUM)
    peak = record.times[np.argmax(record.values)]
    if record.times[0] < 0.0 or record.values.min() < 0.0 or peak == 0.0:
        raise ValueError(
            f"{record.where}: must hold frequencies [Hz] and a variance density [m2/Hz] that are "
            "not below 0, with a peak above 0 Hz"
        )
    return record.times, record.values


def require_range(wavemaker, sea, depth, gravity):
    """List of doubts; raises ValueError if the sea breaks, or is too long for second order."""
    length = waves.wavelength(sea.period, depth, gravity)
    limit = breaking.miche_height(length, depth)
    paddle.require_unbroken("height", sea.height, limit, "0.142 L tanh(kh) of the peak")
    ursell = waves.ursell(sea.height, length, depth)
    if wavemaker.order == 1:
        return []
    most = breaking.MADSEN_URSELL_LIMIT
    if ursell >= most:
        raise ValueError(
            f"wavemaker.order = 2: must be 1 for so long a sea: Hm0 L^2/h^3 = {ursell:.1f}, and "
            f"second-order theory holds below 8 pi^2/3 = {most:.1f}, Hm0 < "
            f"{sea.height * most / ursell:.4g} m"
        )
    if LARGEST * ursell < most:
        return []
    return [
        f"wavemaker.order = 2: waves of {LARGEST:g} Hm0 are beyond second-order theory, H L^2/h^3 ="
        f" {LARGEST * ursell:.1f} of {most:.1f}: expect secondary crests behind the highest"
    ]


def piston(sea, amplitude, order, depth, gravity):
    """Table of the motion that makes waves of these complex amplitudes at the piston, (n,) [m]."""
    first = -1j * amplitude / dispersion.biesel(
        dispersion.wave_numbers(sea.rate, depth, gravity) * depth
    )
    if order == 1:
        series = np.zeros(sea.first + len(amplitude), complex)
    else:
        lowest = LOWEST * 2.0 * math.pi / sea.period
        series = schaffer.motion(amplitude, sea.first, sea.step, depth, gravity, lowest)
    series[sea.first : sea.first + len(amplitude)] += first
    return _table.of_series(series, sea.step)


def beyond(sea, amplitude, motion, depth, gravity):
    """`Paddle.beyond` of the waves that a motion, a `_table.Faded`, makes (`_bound.of_sea`)."""
    lowest = LOWEST * 2.0 * math.pi / sea.period
    return _bound.of_sea(amplitude, sea.first, sea.step, depth, gravity, motion.share, lowest)


def surface(sea, amplitude):
    """Table of the first-order elevation at the piston [m]."""
    return _table.of_series(np.append(np.zeros(sea.first), amplitude), sea.step)


def times_of(step, end):
    """Multiples of a step up to the end, and the end, (m,) float64 [s].

    With a later end all times stay but the end itself, and others are added.
    """
    return np.append(np.arange(0.0, end, step), end)


def samples_of(table, end):
    """Times up to the end at which the extremes of a table are found, (m,) float64 [s]."""
    return times_of(table.step / SAMPLES, end)


def waves_of(table, end):
    """Heights of the waves between upward crossings of zero in a table of elevation [m], (w,)."""
    eta = table(samples_of(table, end))
    ups = np.flatnonzero((eta[:-1] < 0.0) & (eta[1:] >= 0.0))
    return np.array([np.ptp(eta[a : b + 1]) for a, b in pairwise(ups)])


def facts_of(sea, amplitude, motion, times, depth, gravity):
    """Numbers of a sea for people to read, by the names of `mpslab.solids.paddle.Paddle.facts`."""
    return {
        "components": len(amplitude),
        "repeats_after [s]": sea.record,
        "peak_period [s]": sea.period,
        "spectrum_left_out": sea.left_out,
        "shortest_wavelength [m]": 2.0 * math.pi / float(
            dispersion.wave_numbers(sea.rate[-1:], depth, gravity)[0]
        ),
        **speeds(motion, times),
    }  # fmt: skip


def speeds(motion, times):
    """Largest speed and acceleration of a motion at some times, by their names in the facts."""
    return {
        "top_speed [m/s]": float(np.max(np.abs(motion(times, 1)))),
        "largest_acceleration [m/s2]": float(np.max(np.abs(motion(times, 2)))),
    }


def doubts_of(sea):
    """Lines for people on a spectrum of which much is left out."""
    if sea.left_out <= MUCH:
        return []
    return [
        f"wavemaker.band: leaves out {100 * sea.left_out:.0f} % of the spectrum's variance; the "
        "rest is raised to the height asked for"
    ]
