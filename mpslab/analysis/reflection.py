"""Incident and reflected waves, from gauges in a line along the tank.

At each gauge p of a wave of angular frequency w and wave number k, the amplitude is
A_p = I exp(-i k x_p) + R exp(i k x_p). I and R follow by least squares over all gauges, each with a
weight (Zelt & Skjelbreia 1992): with two gauges that is Goda & Suzuki (1976), with three of equal
weight Mansard & Funke (1980).

With P = sum of the weights and S = sum of w_p exp(-2 i k x_p), the determinant over P^2 is the
soundness 1 - |S|^2 / P^2, from 0 (spacings that are multiples of half a wavelength: I and R cannot
be told apart) to 1. Noise grows by 1 / sqrt(soundness).
"""

from dataclasses import dataclass

import numpy as np

from mpslab.analysis.spectrum import without_trend
from mpslab.theory.waves import wave_number

# Soundness of two gauges that are 0.05 or 0.45 wavelengths apart, Goda's limits: sin^2(0.1 pi).
LEAST_SOUND = 0.0955
# Share of a record at either end over which it fades in and out. Without fading, what leaks from
# the peak into other frequencies looks like reflection: in 60 to 100 waves without any reflection,
# Kr = 0.05; with fading 0.02.
TAPER = 0.05
PRIMARY = (0.5, 1.5)  # times the peak frequency: where bound waves are few
WEIGHTS = ("equal", "spacing")


def separate(amplitudes, x, k, weights="equal"):
    """Incident and reflected amplitudes.

    Parameters
    ----------
    amplitudes : (gauges, frequencies) complex128 [m]
        A of Re(A exp(i w t)).
    x : (gauges,) float64 [m]
    k : (frequencies,) float64 [1/m]
        Wave numbers.
    weights : str
        "equal", or "spacing": w_p = sum over q of sin^2(k x_pq) / (1 + (k x_pq / pi)^2), which
        gives more weight to gauges that are near others, but not half a wavelength from them (Zelt
        & Skjelbreia 1992).

    Returns
    -------
    incident, reflected : (frequencies,) complex128 [m]
        At x = 0. They are 0 for a frequency at which the soundness is 0.
    residual : (frequencies,) float64 [m2]
        Mean over the gauges of |A_p - I exp(-i k x_p) - R exp(i k x_p)|^2.
    soundness : (frequencies,) float64
    """
    if weights not in WEIGHTS:
        raise ValueError(f"weights = {weights!r}: must be out of {', '.join(WEIGHTS)}")
    phase = np.multiply.outer(x, k)
    weight = np.ones_like(phase)
    if weights == "spacing":
        apart = phase[:, np.newaxis] - phase[np.newaxis]
        weight = np.sum(np.sin(apart) ** 2 / (1.0 + (apart / np.pi) ** 2), axis=1)
    onwards, back = np.exp(-1j * phase), np.exp(1j * phase)
    total, doubled = weight.sum(axis=0), np.sum(weight * onwards**2, axis=0)
    soundness = 1.0 - np.abs(doubled / np.where(total > 0.0, total, 1.0)) ** 2
    soundness[total == 0.0] = 0.0
    one = np.sum(weight * amplitudes * onwards, axis=0)  # I doubled + R total
    two = np.sum(weight * amplitudes * back, axis=0)  # I total + R doubled*
    determinant = np.where(soundness > 1e-12, -soundness * total**2, np.inf)
    incident = (doubled.conj() * one - total * two) / determinant
    reflected = (doubled * two - total * one) / determinant
    left = amplitudes - incident * onwards - reflected * back
    return incident, reflected, np.mean(np.abs(left) ** 2, axis=0), soundness


@dataclass(frozen=True)
class Reflection:
    """Incident and reflected waves.

    Attributes
    ----------
    regular : bool
        Regular waves, by harmonics; or a sea, by bands of frequency.
    frequency : (n,) float64 [Hz]
        Of the harmonics, or of the middles of the bands.
    incident, reflected, residual : (n,) float64
        For regular waves amplitudes [m], for a sea variance densities [m2 s]. The residual is what
        neither wave explains: its root mean square over the gauges, for a sea its mean.
    left_out : (n,) bool
        Where the spacings of the gauges cannot tell the two apart: soundness below 0.0955. Such
        entries are NaN. A band of a sea is left out if none of its frequencies is sound.
    incident_height, reflected_height : float [m]
        For a sea 4 sqrt(m0), for regular waves 2 a of the first harmonic.
    kr, kr_primary : float
        Reflection coefficient over all frequencies; and over the primary ones: the first harmonic,
        or 0.5 to 1.5 times the peak frequency of the incident waves. A bound harmonic has another
        wave number than the free wave that it is taken for, and so looks partly reflected: it
        counts in kr and not in kr_primary.
    unexplained, floor : float
        Over the primary frequencies: the root mean square of the residual over that of the waves at
        the gauges; and what kr_primary would be without any reflection, by the noise that the
        residual shows (for equal weights). NaN for two gauges.
    lost : float
        Share of the variance at the gauges, within the frequencies asked for, that was left out.
    """

    regular: bool
    frequency: np.ndarray
    incident: np.ndarray
    reflected: np.ndarray
    residual: np.ndarray
    left_out: np.ndarray
    incident_height: float
    reflected_height: float
    kr: float
    kr_primary: float
    unexplained: float
    floor: float
    lost: float


def of_harmonics(amplitudes, x, period, depth, gravity, weights="equal"):
    """Reflection of regular waves.

    Parameters
    ----------
    amplitudes : (gauges, harmonics) complex128 [m]
        Of the first harmonic and those above, as from `mpslab.analysis.harmonics`.
    x : (gauges,) float64 [m]
    period : float [s]
    depth, gravity : float [m], [m/s2]
    weights : str
        As of `separate`.

    Returns
    -------
    Reflection

    Raises
    ------
    ValueError
        If the spacings cannot tell incident and reflected waves of this period apart.
    """
    _check_places(x)
    frequency = np.arange(1, amplitudes.shape[1] + 1) / period
    k = np.array([wave_number(1.0 / f, depth, gravity) for f in frequency])
    parts = separate(amplitudes, x, k, weights)
    sound = parts[3] >= LEAST_SOUND
    if not sound[0]:
        raise ValueError(_unsound(x, f"the wavelength of {2.0 * np.pi / k[0]:.3g} m"))
    incident, reflected = (np.where(sound, np.abs(part), np.nan) for part in parts[:2])
    first = np.arange(len(k)) == 0
    return Reflection(
        regular=True,
        frequency=frequency,
        incident=incident,
        reflected=reflected,
        residual=np.where(sound, np.sqrt(parts[2]), np.nan),
        left_out=~sound,
        incident_height=float(2.0 * incident[0]),
        reflected_height=float(2.0 * reflected[0]),
        **_summary(amplitudes, *parts, sound, first),
    )


def of_sea(elevation, x, step, low, high, width, depth, gravity, weights="equal"):
    """Reflection of an irregular sea, from simultaneous records.

    Each frequency of the whole records is separated by itself; densities are means over bands.

    Parameters
    ----------
    elevation : (n, gauges) float64 [m]
        In equal steps of time.
    x : (gauges,) float64 [m]
    step : float [s]
        Between two readings.
    low, high : float [Hz]
        Frequencies that count, low above 0.
    width : float [Hz]
        Of a band.
    depth, gravity : float [m], [m/s2]
    weights : str
        As of `separate`.

    Returns
    -------
    Reflection

    Raises
    ------
    ValueError
        If the spacings can tell incident and reflected waves apart at no frequency.
    """
    _check_places(x)
    count = len(elevation)
    window = _taper(count)[:, np.newaxis]
    spectra = np.fft.rfft(without_trend(elevation) * window, axis=0)
    scale = np.sqrt(2.0 / (count * np.sum(window**2)))  # |A|^2 is the variance of a frequency
    frequency = np.fft.rfftfreq(count, step)
    part = (frequency >= low) & (frequency <= high)
    frequency, amplitudes = frequency[part], scale * spectra[part].T
    k = np.array([wave_number(1.0 / f, depth, gravity) for f in frequency])
    parts = separate(amplitudes, x, k, weights)
    sound = parts[3] >= LEAST_SOUND
    if not sound.any():
        raise ValueError(_unsound(x, f"a wavelength of waves from {low:.3g} to {high:.3g} Hz"))
    edges = np.arange(np.floor(low / width + 0.5), np.ceil(high / width + 0.5) + 1.0) - 0.5
    band = np.searchsorted(width * edges, frequency, side="right") - 1
    sums = [np.abs(parts[0]) ** 2, np.abs(parts[1]) ** 2, parts[2]]
    density = [_band_means(band, values, sound, len(edges) - 1) / (frequency[1] - frequency[0])
               for values in sums]  # fmt: skip
    middle = width * (edges[:-1] + 0.5)
    peak = middle[np.nanargmax(density[0])]
    first = (frequency >= PRIMARY[0] * peak) & (frequency <= PRIMARY[1] * peak)
    return Reflection(
        regular=False,
        frequency=middle,
        incident=density[0],
        reflected=density[1],
        residual=density[2],
        left_out=np.isnan(density[0]),
        incident_height=float(4.0 * np.sqrt(np.sum(sums[0][sound]))),
        reflected_height=float(4.0 * np.sqrt(np.sum(sums[1][sound]))),
        **_summary(amplitudes, *parts, sound, first),
    )


def _summary(amplitudes, incident, reflected, residual, soundness, sound, first):
    """Numbers that regular waves and a sea have alike; `first` masks the primary frequencies."""
    gauges, first = len(amplitudes), sound & first
    power = np.mean(np.abs(amplitudes) ** 2, axis=0)
    onwards, back = np.abs(incident) ** 2, np.abs(reflected) ** 2
    unexplained = floor = np.nan
    if gauges > 2:
        # The fit takes up two parts in P of the noise at P gauges; R gets 1 / (P soundness) of it.
        noise = gauges / (gauges - 2.0) * residual[first]
        unexplained = _ratio(residual[first].sum(), power[first].sum())
        floor = _ratio(np.sum(noise / (gauges * soundness[first])), onwards[first].sum())
    return {
        "kr": _ratio(back[sound].sum(), onwards[sound].sum()),
        "kr_primary": _ratio(back[first].sum(), onwards[first].sum()),
        "unexplained": unexplained,
        "floor": floor,
        "lost": float(power[~sound].sum() / power.sum()),
    }


def _ratio(part, whole):
    return float(np.sqrt(part / whole)) if whole > 0.0 else np.nan


def _band_means(band, values, sound, count):
    """Mean of the sound values in each band, (count,); NaN where there is none."""
    within = sound & (band >= 0) & (band < count)
    number = np.bincount(band[within], minlength=count)
    total = np.bincount(band[within], values[within], minlength=count)
    return np.where(number > 0, total / np.maximum(number, 1), np.nan)


def _taper(count):
    """Weights (n,) that rise and fall at the ends of the record as half a cosine."""
    along = (np.arange(count) + 0.5) / count
    end = np.minimum(np.minimum(along, 1.0 - along) / TAPER, 1.0)
    return 0.5 * (1.0 - np.cos(np.pi * end))


def _check_places(x):
    if len(x) < 2:
        raise ValueError(f"{len(x)} gauge: reflection needs 2 or more, at different places")
    places = np.sort(x)
    if np.diff(places).min() <= 0.0:
        twice = places[:-1][np.diff(places) <= 0.0][0]
        raise ValueError(f"two gauges at x = {twice:g} m: must be at different places")


def _unsound(x, wavelength):
    return (
        f"gauges at x = {', '.join(f'{place:g}' for place in x)} m cannot tell incident from "
        f"reflected waves: their distances are too near to 0 or to multiples of half {wavelength}"
    )
