"""What the pistons for regular waves share: the first-order stroke and the breaking limit."""

from dataclasses import dataclass
from math import pi

from mpslab.solids import paddle
from mpslab.theory import breaking, waves


@dataclass(frozen=True)
class FirstOrder:
    """A regular wave and the piston that makes it, by linear theory."""

    height: float  # [m]
    stroke: float  # [m]
    frequency: float  # angular [rad/s]
    length: float  # [m]
    kh: float  # [-]
    ursell: float  # [-]


def first_order(wavemaker, depth: float, gravity: float) -> FirstOrder:
    """Wave of the wavemaker's height, or of its stroke where one is given (Biesel & Suquet 1951).

    Raises ValueError if period, height or stroke is not positive or the wave breaks at the maker.
    """
    paddle.require_positive("period", wavemaker.period, "s")
    length = waves.wavelength(wavemaker.period, depth, gravity)
    kh = 2.0 * pi * depth / length
    ratio = waves.biesel_stroke_ratio(kh)
    limit, reason = breaking.miche_height(length, depth), "0.142 L tanh(kh)"
    if wavemaker.stroke == 0.0:
        paddle.require_positive("height", wavemaker.height, "m")
        paddle.require_unbroken("height", wavemaker.height, limit, reason)
        height, stroke = wavemaker.height, wavemaker.height / ratio
    else:
        paddle.require_positive("stroke", wavemaker.stroke, "m")
        reason = f"a wave of {limit:.4g} m, {reason}"
        paddle.require_unbroken("stroke", wavemaker.stroke, limit / ratio, reason)
        height, stroke = ratio * wavemaker.stroke, wavemaker.stroke
    frequency = 2.0 * pi / wavemaker.period
    return FirstOrder(height, stroke, frequency, length, kh, waves.ursell(height, length, depth))
