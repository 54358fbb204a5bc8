"""Wave force on an upright wall by Goda's formula, with Takahashi's impulsive pressure.

Goda (1974), as in Goda (2010), Random Seas and Design of Maritime Structures; Takahashi, Tanimoto
and Shimosako (1994). Waves come at right angles. The pressure of still water is not included.
"""

from dataclasses import dataclass
from math import cos, cosh, pi, sinh, sqrt

HIGHEST = 1.8  # Hmax over H1/3 of a sea, outside of the surf zone


@dataclass(frozen=True)
class Wall:
    """An upright wall on its foundation.

    Attributes
    ----------
    depth : float [m]
        h, still water in front of the foundation.
    foot : float [m]
        h', from still water down to the foot of the wall.
    over_berm : float [m]
        d, still water over the foundation; without armour the depth of the foot.
    crest : float [m]
        hc, from still water up to the top of the wall.
    berm : float [m]
        B_M, width of the foundation in front of the wall, 0 for none.
    slope : float
        Tangent of the sea bed's slope in front of it.
    """

    depth: float
    foot: float
    over_berm: float
    crest: float
    berm: float = 0.0
    slope: float = 0.0


@dataclass(frozen=True)
class Load:
    """What a wave presses with on each metre of the wall.

    Attributes
    ----------
    force : float [N/m]
    moment : float [N m/m]
        Of the horizontal force, about the foot of the wall.
    reach : float [m]
        eta*, how far above still water the pressure reaches if the wall is as high.
    p1, p3, p4 : float [Pa]
        At still water, at the foot and at the crest of the wall.
    impulsive : float
        Takahashi's coefficient alpha_I.
    breaking : bool
        Whether it is larger than Goda's alpha_2, and so decides.
    """

    force: float
    moment: float
    reach: float
    p1: float
    p3: float
    p4: float
    impulsive: float
    breaking: bool


def load(wall, height, length, density=1000.0, gravity=9.81, significant=None):
    """Largest force of a wave on a wall.

    Parameters
    ----------
    wall : Wall
    height : float [m]
        Hmax, of the highest wave; for regular waves their height.
    length : float [m]
        Wavelength in the depth of the wall.
    density, gravity : float [kg/m3], [m/s2]
    significant : float [m], optional
        H1/3: h_b is the depth at five times H1/3 in front of the wall. `height` / 1.8 if left out.

    Returns
    -------
    Load
    """
    significant = height / HIGHEST if significant is None else significant
    kh, hb = 2.0 * pi * wall.depth / length, wall.depth + 5.0 * significant * wall.slope
    alpha1 = 0.6 + 0.5 * (2.0 * kh / sinh(2.0 * kh)) ** 2
    d = wall.over_berm
    alpha2 = min((hb - d) / (3.0 * hb) * (height / d) ** 2, 2.0 * d / height)
    alpha3 = 1.0 - wall.foot / wall.depth * (1.0 - 1.0 / cosh(kh))
    impulsive = _impulsive(wall, height, length)
    weight = density * gravity * height
    reach = 1.5 * height
    p1 = (alpha1 + max(alpha2, impulsive)) * weight
    p3, p4 = alpha3 * p1, p1 * max(1.0 - wall.crest / reach, 0.0)
    top = min(reach, wall.crest)
    force = 0.5 * (p1 + p3) * wall.foot + 0.5 * (p1 + p4) * top
    moment = (2.0 * p1 + p3) * wall.foot**2 / 6.0 + 0.5 * (p1 + p4) * wall.foot * top
    moment += (p1 + 2.0 * p4) * top**2 / 6.0
    return Load(force, moment, reach, p1, p3, p4, impulsive, impulsive > alpha2)


def _impulsive(wall, height, length):
    """Takahashi's alpha_I; 0 without a foundation in front of the wall."""
    if wall.berm == 0.0:
        return 0.0
    wide, high = wall.berm / length, (wall.depth - wall.over_berm) / wall.depth
    first = 0.93 * (wide - 0.12) + 0.36 * (high - 0.6)
    second = -0.36 * (wide - 0.12) + 0.93 * (high - 0.6)
    first *= 20.0 if first <= 0.0 else 15.0
    second *= 4.9 if second <= 0.0 else 3.0
    shape = cos(second) / cosh(first) if second <= 0.0 else 1.0 / (cosh(first) * sqrt(cosh(second)))
    return min(height / wall.over_berm, 2.0) * shape
