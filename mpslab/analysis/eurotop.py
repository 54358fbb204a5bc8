"""Run-up and overtopping as EurOtop expects them (2018, with the errata of November 2019).

EurOtop: Manual on wave overtopping of sea defences and related structures, second edition. These
are its mean relations. Each of their coefficients has a standard deviation (in the manual's design
relations the coefficients are one standard deviation off the mean); for the band here, from 5 % to
95 %, all of them are 1.645 standard deviations off. Heights and periods are those of the incident
waves at the toe.
"""

from dataclasses import dataclass
from math import exp, pi, sqrt

import numpy as np

BAND = 1.645  # standard deviations
SLOPES = (1.0 / 10.0, 1.0 / 2.0)  # of the relations for slopes, 5.1 to 5.11
STEEPEST_WAVE = 0.07  # Hm0 over L
NON_IMPULSIVE = 0.23  # h^2 / (Hm0 L): waves break onto a wall below it
DEEP = 4.0  # depth over Hm0 from which a wall has no foreshore
LOW_WALL = 1.35  # Rc / Hm0


@dataclass(frozen=True)
class Expected:
    """What EurOtop expects.

    Attributes
    ----------
    name, unit : str
    mean, low, high : float
        With the band from 5 % to 95 %.
    relation : str
        Equations of EurOtop 2018.
    doubts : tuple of str
        Which numbers lie outside of the tests behind the relation; empty if none does.
    """

    name: str
    unit: str
    mean: float
    low: float
    high: float
    relation: str
    doubts: tuple = ()


def surf_similarity(slope, height, period, gravity=9.81):
    """Breaker parameter xi = tan(a) / sqrt(Hm0 / L), L = g Tm-1,0^2 / 2 pi [-]."""
    return slope / sqrt(height / _length(period, gravity))


def obliqueness(angle):
    """Factor for the direction of the waves on overtopping: 1 - 0.0033 |b|, b up to 80 degrees."""
    return 1.0 - 0.0033 * min(abs(angle), 80.0)


def runup(height, period, slope, gravity=9.81, berm=1.0, rough=1.0, oblique=1.0):
    """Run-up exceeded by 2 % of the incident waves, above still water (equations 5.1 and 5.2).

    Ru / Hm0 = 1.65 gb gf go xi, at most 1.00 gf go (4 - 1.5 / sqrt(gb xi)); standard deviations of
    1.65 and 1.00: 0.10 and 0.07.

    Parameters
    ----------
    height, period : float [m], [s]
        Hm0 and Tm-1,0 of the incident waves at the toe.
    slope : float
        Tangent of the slope.
    gravity : float [m/s2]
    berm, rough, oblique : float
        Factors of influence, 1 for none.

    Returns
    -------
    Expected
        "R2%" [m].
    """
    xi = surf_similarity(slope, height, period, gravity)

    def relation(off):
        breaking = (1.65 + 0.10 * off) * berm * rough * oblique * xi
        most = (1.00 + 0.07 * off) * rough * oblique * (4.0 - 1.5 / sqrt(berm * xi))
        # Below xi = 0.14 the second is negative; it is meant as a limit of steep slopes.
        return height * (min(breaking, most) if berm * xi > 1.0 else breaking)

    doubts = _slope_doubts(slope, height, period, gravity)
    return Expected("R2%", "m", relation(0.0), relation(-BAND), relation(BAND), "5.1, 5.2", doubts)


def overtopping_of_slope(
    height, period, slope, freeboard, gravity=9.81, berm=1.0, rough=1.0, oblique=1.0, wall=1.0
):
    """Mean overtopping discharge of a slope (equations 5.10 and 5.11).

    q / sqrt(g Hm0^3) = 0.023 / sqrt(tan a) gb xi exp(-(2.7 Rc / (xi Hm0 gb gf go gv))^1.3), at most
    0.09 exp(-(1.5 Rc / (Hm0 gf go gv))^1.3); standard deviations 0.003, 0.20, 0.0135 and 0.15.

    Parameters
    ----------
    height, period, slope, gravity, berm, rough, oblique
        As for `runup`.
    freeboard : float [m]
        Rc, from still water up to the crest, 0 or more.
    wall : float
        Factor of influence of a wall on the crest.

    Returns
    -------
    Expected
        "q" [m2/s]: m3/s for each metre of crest.
    """
    _require_freeboard(freeboard)
    xi = surf_similarity(slope, height, period, gravity)
    above = freeboard / height

    def relation(off):
        gentle, inner = 0.023 + 0.003 * off, 2.7 - 0.20 * off
        steep, outer = 0.09 + 0.0135 * off, 1.5 - 0.15 * off
        breaking = gentle / sqrt(slope) * berm * xi
        breaking *= exp(-((inner * above / (xi * berm * rough * oblique * wall)) ** 1.3))
        most = steep * exp(-((outer * above / (rough * oblique * wall)) ** 1.3))
        return sqrt(gravity * height**3) * min(breaking, most)

    doubts = _slope_doubts(slope, height, period, gravity)
    return _discharge(relation, "5.10, 5.11", doubts)


def overtopping_of_wall(height, period, depth, freeboard, gravity=9.81, foreshore=True):
    """Mean overtopping discharge of a plain vertical wall (equations 7.1, 7.5, 7.7 and 7.8).

    Without a foreshore: q / sqrt(g Hm0^3) = 0.047 exp(-(2.35 Rc / Hm0)^1.3). With a foreshore, and
    h^2 / (Hm0 L) above 0.23: 0.05 exp(-2.78 Rc / Hm0). Below 0.23 waves break onto the wall: with
    b = sqrt(Hm0 / (h s)), s = Hm0 / L, 0.011 b exp(-2.2 Rc / Hm0) up to Rc = 1.35 Hm0 and
    0.0014 b (Rc / Hm0)^-3 beyond. Standard deviations 0.007 and 0.23; 0.012 and 0.17; 0.0045;
    0.0006.

    Parameters
    ----------
    height, period : float [m], [s]
        Hm0 and Tm-1,0 of the incident waves at the toe.
    depth, freeboard : float [m]
        Of the still water at the toe; and from still water up to the crest, 0 or more.
    gravity : float [m/s2]
    foreshore : bool
        Whether a sloping bed in front shapes the waves.

    Returns
    -------
    Expected
        "q" [m2/s].
    """
    _require_freeboard(freeboard)
    length, above = _length(period, gravity), freeboard / height
    scale = sqrt(gravity * height**3)
    if not foreshore:
        doubts = () if depth >= DEEP * height else (
            f"depth / Hm0 = {depth / height:.3g}, of water without a foreshore {DEEP:g} or more",
        )  # fmt: skip
        return _discharge(
            lambda off: scale
            * (0.047 + 0.007 * off)
            * exp(-(((2.35 - 0.23 * off) * above) ** 1.3)),
            "7.1", doubts,
        )  # fmt: skip
    if depth**2 / (height * length) > NON_IMPULSIVE:
        return _discharge(
            lambda off: scale * (0.05 + 0.012 * off) * exp(-(2.78 - 0.17 * off) * above), "7.5"
        )
    broken = scale * sqrt(length / depth)  # b: Hm0 / (h s) = L / h
    if above < LOW_WALL:
        doubts = () if freeboard > 0.0 else ("Rc = 0: the relation is of walls above the water",)
        return _discharge(
            lambda off: broken * (0.011 + 0.0045 * off) * exp(-2.2 * above), "7.7", doubts
        )
    return _discharge(lambda off: broken * (0.0014 + 0.0006 * off) * above**-3, "7.8")


def table(expected, measured=None):
    """What was expected beside what was measured.

    Parameters
    ----------
    expected : sequence of Expected
    measured : dict of str to float, optional
        By the names of what is expected.

    Returns
    -------
    structured array (n,)
        "name", "unit", "measured" (NaN if it was not), "mean", "low", "high", "inside" (whether the
        measured value lies in the band), "relation" and "doubts" (words, empty if within range).
    """
    words = [(name, "U16") for name in ("name", "unit", "relation")]
    numbers = [(name, float) for name in ("measured", "mean", "low", "high")]
    rows = np.zeros(len(expected), [*words, *numbers, ("inside", bool), ("doubts", "U200")])
    for row, entry in zip(rows, expected, strict=True):
        value = (measured or {}).get(entry.name, np.nan)
        for name in ("name", "unit", "relation", "mean", "low", "high"):
            row[name] = getattr(entry, name)
        row["measured"], row["inside"] = value, entry.low <= value <= entry.high
        row["doubts"] = "; ".join(entry.doubts)
    return rows


def _length(period, gravity):
    return gravity * period**2 / (2.0 * pi)


def _discharge(relation, equations, doubts=()):
    low, mean, high = (max(relation(off), 0.0) for off in (-BAND, 0.0, BAND))
    return Expected("q", "m2/s", mean, low, high, equations, doubts)


def _require_freeboard(freeboard):
    if freeboard < 0.0:
        raise ValueError(f"freeboard = {freeboard:g} m: must be 0 or more")


def _slope_doubts(slope, height, period, gravity):
    found, steepness = [], height / _length(period, gravity)
    if not SLOPES[0] * (1.0 - 1e-9) <= slope <= SLOPES[1] * (1.0 + 1e-9):
        found.append(f"slope 1:{1.0 / slope:.3g}, tested from 1:{1.0 / SLOPES[1]:.3g} to "
                     f"1:{1.0 / SLOPES[0]:.3g}")  # fmt: skip
    if steepness > STEEPEST_WAVE:
        found.append(f"Hm0 / L = {steepness:.3g}, waves are steepest at {STEEPEST_WAVE:g}")
    return tuple(found)
