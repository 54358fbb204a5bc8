"""Breaking and run-up: limits of wave height, breaker type and depth, and laws of run-up.

Pure functions of plain numbers in SI units. `slope` is the tangent of the bed's angle; heights are
crest to trough; deep-water height means the unrefracted height that linear shoaling starts from.
"""

import math
from collections.abc import Callable

from mpslab.later import scipy
from mpslab.theory import waves

# Madsen (1971): above this Ursell number the second-order crest has a false secondary crest.
MADSEN_URSELL_LIMIT = 8.0 * math.pi**2 / 3.0

# Goda (2010), abstract: the breaker index holds for slopes up to 1/10.
GODA_STEEPEST = 0.1

# McCowan (1894): highest solitary wave over depth.
MCCOWAN_RATIO = 0.78


# Limits of the height on a level bed


def miche_height(length: float, depth: float) -> float:
    """Height of the steepest regular wave, 0.142 L tanh(k h) [m] (Miche 1944)."""
    return 0.142 * length * math.tanh(2.0 * math.pi * depth / length)


def mccowan_height(depth: float) -> float:
    """Height of the highest solitary wave, 0.78 h [m] (McCowan 1894)."""
    return MCCOWAN_RATIO * depth


def madsen_in_range(height: float, length: float, depth: float) -> bool:
    """Whether the second-order piston may be used: H L^2 / h^3 < 8 pi^2 / 3 (Madsen 1971)."""
    return waves.ursell(height, length, depth) < MADSEN_URSELL_LIMIT


# Breaker type


def surf_similarity(slope: float, height: float, deep_length: float) -> float:
    """Surf similarity number, xi = slope / sqrt(H / L0) [-] (Battjes 1974)."""
    return slope / math.sqrt(height / deep_length)


def breaker_type(xi: float) -> str:
    """Breaker type for a surf similarity number of the deep-water height (Battjes 1974).

    "spilling" below 0.5, "plunging" up to 3.3, "surging" (or collapsing) above.
    """
    if xi < 0.5:
        return "spilling"
    return "plunging" if xi <= 3.3 else "surging"


# Height of the breaker at a depth


def goda_1970(
    depth: float, slope: float, period: float, gravity: float, coefficient: float = 0.17
) -> float:
    """Breaker height [m] at a depth after Goda (1970), for regular waves.

    Hb / L0 = A {1 - exp[-1.5 (pi hb / L0)(1 + 15 slope^(4/3))]}; coefficient A = 0.12 to 0.18.
    """
    return _goda(depth, slope, period, gravity, coefficient, 15.0)


def goda_2010(
    depth: float, slope: float, period: float, gravity: float, coefficient: float = 0.17
) -> float:
    """Breaker height [m] at a depth after Goda (2010): as `goda_1970` with 11 in place of 15."""
    return _goda(depth, slope, period, gravity, coefficient, 11.0)


def _goda(depth, slope, period, gravity, coefficient, slope_factor):
    deep_length = waves.deep_wavelength(period, gravity)
    steepening = 1.0 + slope_factor * slope ** (4.0 / 3.0)
    exponent = -1.5 * math.pi * depth / deep_length * steepening
    return -coefficient * deep_length * math.expm1(exponent)


def weggel(depth: float, slope: float, period: float, gravity: float) -> float:
    """Breaker height [m] at a depth after Weggel (1972), as in the Shore Protection Manual (1984).

    Hb / hb = b - a Hb / (g T^2), a = 43.75 (1 - e^(-19 slope)), b = 1.56 / (1 + e^(-19.5 slope)).
    """
    a = 43.75 * (1.0 - math.exp(-19.0 * slope))
    b = 1.56 / (1.0 + math.exp(-19.5 * slope))
    return b * depth / (1.0 + a * depth / (gravity * period**2))


def breaking_point(
    deep_height: float,
    period: float,
    slope: float,
    gravity: float,
    index: Callable[[float, float, float, float], float] = goda_2010,
) -> tuple[float, float]:
    """Depth and height [m] at which a wave breaks: linear shoaling meets a breaker index.

    Parameters
    ----------
    deep_height : float [m]
        Deep-water height.
    period : float [s]
    slope : float [-]
    gravity : float [m/s2]
    index : function (depth, slope, period, gravity) -> breaker height [m]
        `goda_1970`, `goda_2010` or `weggel`.

    Raises
    ------
    ValueError
        If the wave is too steep for deep water.
    """
    deep_length = waves.deep_wavelength(period, gravity)

    def excess(depth):
        height = deep_height * waves.shoaling_coefficient(period, depth, gravity)
        return height - index(depth, slope, period, gravity)

    # The root is bracketed by a depth far below the height, where every index is exceeded.
    shallow, deep = 1e-3 * deep_height, 0.5 * deep_length
    if excess(deep) >= 0.0:
        limit = index(deep, slope, period, gravity)
        raise ValueError(
            f"deep-water height = {deep_height:.4g} m: must be below {limit:.4g} m for a period of"
            f" {period:.4g} s, or the wave breaks in deep water"
        )
    depth = scipy.optimize.brentq(excess, shallow, deep, xtol=1e-12)
    return depth, index(depth, slope, period, gravity)


# Run-up on a smooth plane slope


def hunt_runup(deep_height: float, period: float, slope: float, gravity: float) -> float:
    """Vertical run-up of breaking regular waves, R = xi0 H0 [m] (Hunt 1959); for xi0 below 2."""
    deep_length = waves.deep_wavelength(period, gravity)
    return surf_similarity(slope, deep_height, deep_length) * deep_height


def synolakis_breaks(height: float, depth: float, slope: float) -> bool:
    """Whether a solitary wave breaks as it runs up: H/h > 0.8183 cot^(-10/9) (Synolakis 1987)."""
    return height / depth > 0.8183 * slope ** (10.0 / 9.0)


def synolakis_runup(height: float, depth: float, slope: float) -> float:
    """Vertical run-up of a solitary wave that does not break [m] (Synolakis 1987).

    R / h = 2.831 sqrt(cot) (H / h)^(5/4).

    Raises ValueError if the wave breaks (`synolakis_breaks`).
    """
    if synolakis_breaks(height, depth, slope):
        limit = 0.8183 * slope ** (10.0 / 9.0) * depth
        raise ValueError(
            f"height = {height:.4g} m: must be up to {limit:.4g} m on a slope of {slope:.4g},"
            " or the solitary wave breaks"
        )
    return depth * 2.831 / math.sqrt(slope) * (height / depth) ** 1.25


def synolakis_breaking_runup(height: float, depth: float) -> float:
    """Vertical run-up of a breaking solitary wave on a slope of 1:19.85 [m] (Synolakis 1987).

    R / h = 1.109 (H / h)^0.582, a fit to that one slope.
    """
    return depth * 1.109 * (height / depth) ** 0.582
