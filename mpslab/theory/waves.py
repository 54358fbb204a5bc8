"""Wave theory: linear, cnoidal, solitary and standing waves on water of constant depth.

Pure functions of plain numbers in SI units. Heights are crest to trough, x points onshore, and z is
zero at the bed, so that the still water surface lies at z = depth.
"""

import math
from dataclasses import dataclass

import numpy as np

from mpslab.later import scipy

# Formulas in kh have reached their deep-water limit long before, and sinh(600) still fits a float.
LARGEST_KH = 300.0

# First-order cnoidal theory is for long waves (Fenton, "The cnoidal theory of water waves").
CNOIDAL_SHORTEST_LENGTH = 8.0  # wavelengths over depth [-]

# Closer to m = 1 than this a period holds one solitary wave and still water.
CNOIDAL_SMALLEST_COMPLEMENT = 1e-10  # 1 - m [-]


# Linear waves (Airy)


def wave_number(period: float, depth: float, gravity: float) -> float:
    """Wave number of linear theory [1/m]: omega^2 = g k tanh(k h), by Newton to 1e-12.

    Raises RuntimeError if Newton does not converge (arguments that are not finite and positive).
    """
    target = (2.0 * math.pi / period) ** 2 * depth / gravity
    kh = target / math.sqrt(math.tanh(target))  # Eckart (1952), within 5 %
    for _ in range(50):
        tanh = math.tanh(kh)
        step = (kh * tanh - target) / (tanh + kh * (1.0 - tanh * tanh))
        kh -= step
        if abs(step) <= 1e-14 * kh:
            return kh / depth
    raise RuntimeError(f"dispersion relation not solved: period {period}, depth {depth}")


def wavelength(period: float, depth: float, gravity: float) -> float:
    """Wavelength of linear theory [m]."""
    return 2.0 * math.pi / wave_number(period, depth, gravity)


def deep_wavelength(period: float, gravity: float) -> float:
    """Deep-water wavelength of linear theory, L0 = g T^2 / 2 pi [m]."""
    return gravity * period**2 / (2.0 * math.pi)


def celerity(period: float, depth: float, gravity: float) -> float:
    """Phase speed of linear theory, c = L / T [m/s]."""
    return wavelength(period, depth, gravity) / period


def group_celerity(period: float, depth: float, gravity: float) -> float:
    """Group speed of linear theory, c_g = (c / 2) (1 + 2 k h / sinh 2 k h) [m/s]."""
    kh = min(wave_number(period, depth, gravity) * depth, LARGEST_KH)
    return 0.5 * celerity(period, depth, gravity) * (1.0 + 2.0 * kh / math.sinh(2.0 * kh))


def shoaling_coefficient(period: float, depth: float, gravity: float) -> float:
    """Height at a depth over deep-water height, linear theory: sqrt(c_g0 / c_g) [-]."""
    deep_group = gravity * period / (4.0 * math.pi)
    return math.sqrt(deep_group / group_celerity(period, depth, gravity))


def biesel_stroke_ratio(kh: float) -> float:
    """Wave height over full stroke of a piston, H / S [-].

    Biesel & Suquet (1951): 2 (cosh 2kh - 1) / (sinh 2kh + 2kh), written here with
    cosh 2kh - 1 = 2 sinh^2 kh, which keeps its digits in shallow water. Tends to kh and to 2.
    """
    kh = min(kh, LARGEST_KH)
    return 4.0 * math.sinh(kh) ** 2 / (math.sinh(2.0 * kh) + 2.0 * kh)


def ursell(height: float, length: float, depth: float) -> float:
    """Ursell number, H L^2 / h^3 [-]."""
    return height * length**2 / depth**3


# Standing waves


def standing_wave_frequency(mode: int, length: float, depth: float, gravity: float) -> float:
    """Angular frequency of the linear standing wave in a tank [rad/s].

    omega^2 = g k tanh(k h), k = mode pi / length, `mode` half wavelengths in the tank's length.
    """
    k = mode * math.pi / length
    return math.sqrt(gravity * k * math.tanh(k * depth))


def standing_wave_velocity(
    x: np.ndarray,
    z: np.ndarray,
    amplitude: float,
    mode: int,
    length: float,
    depth: float,
    gravity: float,
) -> tuple[np.ndarray, np.ndarray]:
    """Velocity of the linear standing wave at the moment when its surface is flat.

    The surface is eta = a cos(kx) sin(omega t) at t = 0: all energy is kinetic and the pressure is
    hydrostatic. From the potential phi = (a omega / k) cosh(kz) / sinh(kh) cos(kx) cos(omega t).

    Parameters
    ----------
    x, z : (n,) float64 [m]
        Place; x = 0 is the left wall, z = 0 the bed.
    amplitude : float [m]
        Amplitude a at the walls; the surface at x = 0 rises first.
    mode, length, depth, gravity
        As for `standing_wave_frequency`.

    Returns
    -------
    u, w : (n,) float64 [m/s]
        Horizontal and vertical velocity.
    """
    k = mode * math.pi / length
    speed = amplitude * standing_wave_frequency(mode, length, depth, gravity)
    # cosh(kz) / sinh(kh) and sinh(kz) / sinh(kh) from decaying exponentials, which cannot overflow
    up, down = np.exp(k * (z - depth)), np.exp(-k * (z + depth))
    scale = speed / (1.0 - math.exp(-2.0 * k * depth))
    return -scale * (up + down) * np.sin(k * x), scale * (up - down) * np.cos(k * x)


# Cnoidal waves (first order)


@dataclass(frozen=True)
class CnoidalWave:
    """A first-order cnoidal wave (Korteweg & de Vries 1895)."""

    height: float  # [m]
    period: float  # [s]
    depth: float  # [m]
    m: float  # parameter of the elliptic functions [-]
    length: float  # [m]
    celerity: float  # [m/s]
    trough: float  # lowest elevation above still water, negative [m]

    def eta(self, phase):
        """Surface elevation [m] at phase = x / L - t / T [-]; the crest is at phase 0."""
        # |phase| <= 1/2 keeps ellipj within the range where it is accurate for m near 1.
        argument = 2.0 * scipy.special.ellipk(self.m) * (phase - np.round(phase))
        cn = scipy.special.ellipj(argument, self.m)[1]
        return self.trough + self.height * cn**2

    @property
    def rising_phase(self) -> float:
        """Phase in (0, 1/2) where the surface passes still water upwards as time goes on [-]."""
        amplitude = math.asin(math.sqrt(1.0 + self.trough / self.height))
        phase = scipy.special.ellipkinc(amplitude, self.m) / (2.0 * scipy.special.ellipk(self.m))
        return float(phase)


def cnoidal_wave(height: float, period: float, depth: float, gravity: float) -> CnoidalWave:
    """First-order cnoidal wave of given height, period and depth.

    H L^2 / h^3 = (16/3) m K^2, c = sqrt(g h) [1 + (H / (m h)) (1 - m/2 - 3 E / (2 K))], L = c T,
    trough = (H / m) (1 - m - E / K); K(m), E(m) complete elliptic integrals.

    Raises ValueError if the period is outside `cnoidal_period_range`.
    """
    shortest, longest = cnoidal_period_range(height, depth, gravity)
    if not shortest <= period <= longest:
        raise ValueError(
            f"period = {period:.4g} s: must be from {shortest:.4g} to {longest:.4g} s for a"
            f" cnoidal wave of height {height:.4g} m on a depth of {depth:.4g} m"
        )

    def excess(log_complement):
        return _cnoidal_period(math.exp(log_complement), height, depth, gravity) - period

    # 1 - m spans many decades, so its logarithm is what is solved for.
    low, high = math.log(CNOIDAL_SMALLEST_COMPLEMENT), math.log(_longest_complement(height, depth))
    complement = math.exp(scipy.optimize.brentq(excess, low, high, xtol=1e-13))
    m = 1.0 - complement
    quarter = scipy.special.ellipkm1(complement)
    trough = (height / m) * (complement - scipy.special.ellipe(m) / quarter)
    speed = _cnoidal_celerity(complement, height, depth, gravity)
    return CnoidalWave(height, period, depth, m, speed * period, speed, float(trough))


def cnoidal_period_range(height: float, depth: float, gravity: float) -> tuple[float, float]:
    """Shortest and longest period [s] for which `cnoidal_wave` gives a wave.

    The shortest is that of a wave 8 depths long, below which the theory is not used; the longest is
    that of a wave whose crests have become solitary.
    """
    shortest = _cnoidal_period(_longest_complement(height, depth), height, depth, gravity)
    longest = _cnoidal_period(CNOIDAL_SMALLEST_COMPLEMENT, height, depth, gravity)
    return shortest, longest


def _longest_complement(height, depth):
    """1 - m of the shortest wave, from H L^2 / h^3 = (16/3) m K^2 with L = 8 h."""
    target = 3.0 / 16.0 * ursell(height, CNOIDAL_SHORTEST_LENGTH * depth, depth)
    return scipy.optimize.brentq(
        lambda complement: (1.0 - complement) * scipy.special.ellipkm1(complement) ** 2 - target,
        CNOIDAL_SMALLEST_COMPLEMENT,
        1.0,
    )


def _cnoidal_celerity(complement, height, depth, gravity):
    m, quarter = 1.0 - complement, scipy.special.ellipkm1(complement)
    bracket = 1.0 - m / 2.0 - 1.5 * scipy.special.ellipe(m) / quarter
    return math.sqrt(gravity * depth) * float(1.0 + height / (m * depth) * bracket)


def _cnoidal_period(complement, height, depth, gravity):
    quarter = scipy.special.ellipkm1(complement)
    length = math.sqrt(16.0 * (1.0 - complement) * depth**3 / (3.0 * height)) * quarter
    return float(length) / _cnoidal_celerity(complement, height, depth, gravity)


# Solitary waves


def solitary_wave_number(height: float, depth: float) -> float:
    """Decay number of a solitary wave, k = sqrt(3 H / (4 h^3)) [1/m] (Boussinesq; Goring 1978)."""
    return math.sqrt(3.0 * height / (4.0 * depth**3))


def solitary_celerity(height: float, depth: float, gravity: float) -> float:
    """Celerity of a solitary wave, c = sqrt(g (h + H)) [m/s] (Boussinesq; Goring 1978)."""
    return math.sqrt(gravity * (depth + height))


def solitary_elevation(x, height: float, depth: float):
    """Surface elevation of a solitary wave, H sech^2(k x) [m], x [m] from its crest."""
    return height / np.cosh(solitary_wave_number(height, depth) * x) ** 2
