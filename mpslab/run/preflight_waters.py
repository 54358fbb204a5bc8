"""What a preflight says of the water at the start: which of it solids shut off.

The tank is looked at in cells a spacing wide, in a large tank up to two; a larger one is not looked
at. Water in cells that meet at a face belongs together.
"""

import numpy as np

from mpslab.core import bed as beds
from mpslab.core.lattice import effective_length
from mpslab.later import scipy
from mpslab.solids import filling, gates, obstacles, shaped

MOST = 500_000  # cells
WIDEST = 2.0  # spacings: in wider cells thin solids would be lost
LEAST = 8  # cells: smaller bodies of water are corners that the cells cut off


def waters(case, notes):
    """The bodies of water that solids keep apart, as {"waters": their volumes [m3], in 2-D areas
    [m2], largest first}; {} where there is only one, or none to be told apart.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    notes : list of str
        Gets a warning for each body of water that is shut in.
    """
    if not (case.obstacle or case.solid or case.gate):
        return {}
    cells = _Cells(case)
    if cells.width > WIDEST * case.particles.spacing:
        return {}
    number, size = cells.bodies()
    told = [k for k in np.argsort(-size) if size[k] >= LEAST]
    open_ = [k for k in told if cells.meets_air(number == k)]
    if open_:
        notes += [cells.shut_in(number == k) for k in told if k not in open_]
    if len(open_) < 2:
        return {}
    return {"waters": [float(size[k] * cells.volume) for k in open_]}


class _Cells:
    """The tank in cubes; in 2-D one row of them across.

    Attributes
    ----------
    water, air : (nx, ny, nz) bool
        Which of them hold water at the start, and which hold nothing.
    axes : list of int
        Those that the tank has, 0, 1 and 2 for x, y and z.
    width, volume : float [m], [m3] or in 2-D [m2]
        Of a cell.
    """

    def __init__(self, case):
        tank, self.case = case.tank, case
        low = np.array([0.0, 0.0, min(z for _, z in tank.bed)])
        high = np.array([effective_length(case), tank.width, tank.height])
        self.axes = [0, 1, 2] if case.dim == 3 else [0, 2]
        room = np.prod((high - low)[self.axes])
        self.width = max(case.particles.spacing, (room / MOST) ** (1.0 / case.dim))
        self.volume = self.width**case.dim
        count = np.ceil((high - low) / self.width - 1e-6).astype(int)
        shape = tuple(np.maximum(count, 1))
        sides = (a + self.width * (np.arange(n) + 0.5)
                 for a, n in zip(low, shape, strict=True))  # fmt: skip
        self.place = np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1).reshape(-1, 3)
        if case.dim == 2:
            self.place[:, 1] = 0.0
        free = self.place[:, 2] > beds.elevation(tank.bed, self.place[:, 0])
        free &= ~obstacles.holds(case, self.place) & ~shaped.holds(case, self.place)
        free &= ~gates.holds(case, self.place[:, 0])
        wet = self._filled()
        self.water, self.air = ((free & part).reshape(shape) for part in (wet, ~wet))

    def _filled(self):
        """Which cells are in the water of the case, solids or not, (n,) bool."""
        case, found = self.case, np.zeros(len(self.place), bool)
        boxes = [(w.shape, w.start, w.end) for w in case.water]
        for shape, start, end in boxes or [("box", *filling.filled(case))]:
            low, high = (np.array(corner, float)[self.axes] for corner in (start, end))
            place = self.place[:, self.axes]
            if shape == "disc":
                off = (place - 0.5 * (low + high)) / (0.5 * (high - low))
                found |= off[:, 0] ** 2 + off[:, -1] ** 2 < 1.0
            else:
                found |= np.all((place > low) & (place < high), axis=1)
        return found

    def bodies(self):
        """Number of the body of water of each cell, -1 for none, and how many cells each has."""
        number, count = scipy.ndimage.label(self.water)
        if self.case.dim == 3 and self.case.tank.periodic:
            number = self._wrapped(number, count)
        number -= 1
        return number, np.bincount(number[number >= 0], minlength=count)

    def _wrapped(self, number, count):
        """Numbers from 1 on, of bodies that meet across the sides of a periodic tank."""
        one, two = number[:, 0, :].ravel(), number[:, -1, :].ravel()
        both = (one > 0) & (two > 0)
        graph = scipy.sparse.coo_array(
            (np.ones(both.sum()), (one[both], two[both])), (count + 1, count + 1)
        )
        _, joined = scipy.sparse.csgraph.connected_components(graph, directed=False)
        first = np.unique(joined, return_index=True)[1]  # 0 is no water, and alone
        return first[joined][number]

    def meets_air(self, body):
        """Whether a body of water, (nx, ny, nz) bool, has air, or the open top, over a cell."""
        if not self.case.tank.lid and body[:, :, -1].any():
            return True
        return bool((body[:, :, :-1] & self.air[:, :, 1:]).any())

    def shut_in(self, body):
        """The warning that a body of water, (nx, ny, nz) bool, is shut in."""
        middle = self.place[body.ravel()].mean(axis=0)
        where = ", ".join(f"{'xyz'[k]} = {middle[k]:.3g}" for k in self.axes)
        unit = "m3" if self.case.dim == 3 else "m2"
        return (
            f"{body.sum() * self.volume:.3g} {unit} of water about {where} m are shut in: nothing "
            f"leads from there to the surface, so that nothing says how high their pressure is"
        )
