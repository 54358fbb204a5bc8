"""How waves should break: formulae, and the class data of another tank with the same slope."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mpslab.theory import breaking, waves
from validation.plunging_breaker.breakers import DEEP_HEIGHT, SLOPE

DATA = Path(__file__).parent / "data" / "cornell_lab_slope1to10_breakers.csv"
FORMULAE = {
    "Goda 1970": breaking.goda_1970,
    "Goda 2010": breaking.goda_2010,
    "Weggel 1972": breaking.weggel,
}


@dataclass(frozen=True)
class Expected:
    """A wave that breaks on the slope.

    Attributes
    ----------
    name, kind : str
        What it is, and the type of breaker.
    deep_height, deep_length : float
        Of the wave in deep water, by linear theory [m].
    depth, height : float
        Where it breaks: still water depth, and height of the wave [m].
    """

    name: str
    kind: str
    deep_height: float
    deep_length: float
    depth: float
    height: float

    @property
    def similarity(self):
        """Surf similarity of the wave in deep water."""
        return breaking.surf_similarity(SLOPE, self.deep_height, self.deep_length)

    @property
    def scaled(self):
        """Height over depth; distance from the still shoreline over the length in deep water;
        height over that in deep water; (3,).
        """
        place = self.depth / SLOPE / self.deep_length
        return np.array([self.height / self.depth, place, self.height / self.deep_height])


def by_formulae(period, gravity):
    """The paper's wave after the breaker indices, a list of Expected."""
    length = waves.deep_wavelength(period, gravity)
    kind = breaking.breaker_type(breaking.surf_similarity(SLOPE, DEEP_HEIGHT, length))
    points = {name: breaking.breaking_point(DEEP_HEIGHT, period, SLOPE, gravity, index)
              for name, index in FORMULAE.items()}  # fmt: skip
    return [Expected(name, kind, DEEP_HEIGHT, length, *point) for name, point in points.items()]


def by_class(gravity):
    """The waves of the class data, a list of Expected in the order of their surf similarity."""
    with DATA.open() as file:
        found = [_of_class(row, gravity) for row in csv.DictReader(file)]
    return sorted(found, key=lambda wave: wave.similarity)


def _of_class(row, gravity):
    period, depth = float(row["T [s]"]), float(row["depth flat part [m]"])
    shoaled = waves.shoaling_coefficient(period, depth, gravity)
    return Expected(
        f"class data {row['case']}", row["observed breaker type"],
        float(row["H0 flat part [m]"]) / shoaled, waves.deep_wavelength(period, gravity),
        float(row["h_b [m]"]), float(row["H_b [m]"]),
    )  # fmt: skip


def at_equal_similarity(similarity, measured):
    """What the class data say of a wave of another surf similarity, as `Expected.scaled`.

    Between the two waves next to it a power law is taken: with it the same comes out whether the
    place is scaled with the length or with the height of the wave.
    """
    at = np.log([wave.similarity for wave in measured])
    columns = np.log([wave.scaled for wave in measured]).T
    return np.exp([np.interp(np.log(similarity), at, column) for column in columns])
