"""The tank: bed, end walls, side walls and lid, all at rest.

The cross-section (x, z) is laid out first and then repeated across. Wall particles stand half a
spacing behind the boundary, in layers: faces first, fillers behind them.
"""

from functools import cached_property

import numpy as np

from mpslab.core import bed as beds
from mpslab.core import lattice
from mpslab.core.lattice import effective_length
from mpslab.core.particles import FACE, FILLER
from mpslab.solids import obstacles, shaped
from mpslab.solids.solid import Solid


class Tank(Solid):
    """Bed and walls of a case.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    backmost : float [m]
        Least displacement of the piston; the bed reaches that far behind it.
    """

    def __init__(self, case, backmost=0.0):
        super().__init__("tank")
        self.case, self.backmost = case, backmost
        self.has_piston = case.wavemaker.type != "none"

    def particles(self, case):
        (section, role), n = self._section, lattice.rows_across(case)
        positions, roles = [lattice.across(case, section)], [np.tile(role, n)]
        walled = case.tank.width > 0.0 and not case.tank.periodic
        for layer in range(case.particles.layers if walled else 0):
            side, role = self._side_wall(layer)
            for row in (-1 - layer, n + layer):
                positions.append(lattice.at_row(side, (row + 0.5) * case.particles.spacing))
                roles.append(role)
        position, role = np.vstack(positions), np.concatenate(roles).astype(np.int8)
        obstacles.cover(case, position, role)
        shaped.cover(case, position, role)
        return position, role

    def holds(self, points):
        case, (x, y, z) = self.case, points.T
        out = (x < 0.0) | (x > effective_length(case)) | (z < case.tank.bed_height(x))
        if case.tank.width > 0.0 and not case.tank.periodic:
            out |= (y < 0.0) | (y > lattice.rows_across(case) * case.particles.spacing)
        return out | (z > self.top) if case.tank.lid else out

    @cached_property
    def floor(self):
        """Layers of the bed in the section: (n, 2) [m] and roles (n,)."""
        staircase = self.case.particles.bed == "staircase"
        return self._staircase() if staircase else self._smooth_bed()

    @cached_property
    def lid(self):
        """Layers above the walls in the section, none without a lid: (n, 2) [m] and roles (n,)."""
        case, layers, spacing = self.case, self.case.particles.layers, self.case.particles.spacing
        if not case.tank.lid:
            return np.zeros((0, 2)), np.zeros(0, int)
        beyond = layers * spacing
        x = lattice.between(case, -beyond, effective_length(case) + beyond)
        z = self.top + (np.arange(layers) + 0.5) * spacing
        role = np.full((layers, len(x)), FILLER)
        role[0, (x > -spacing) & (x < effective_length(case) + spacing)] = FACE
        x, z = np.meshgrid(x, z)
        return np.column_stack([x.ravel(), z.ravel()]), role.ravel()

    @property
    def top(self):
        """Height of the walls in whole spacings [m]."""
        spacing = self.case.particles.spacing
        return round(self.case.tank.height / spacing) * spacing

    def end_wall(self, side):
        """Vertical layers at the seaward (-1) or landward (+1) end: (n, 2) [m] and roles (n,)."""
        case, spacing = self.case, self.case.particles.spacing
        rows, roles = [], []
        for k in range(case.particles.layers):
            x = -(k + 0.5) * spacing if side < 0 else effective_length(case) + (k + 0.5) * spacing
            rows.append(lattice.stack(case, x, case.tank.height))
            roles.append(np.full(len(rows[-1]), FILLER if k else FACE))
        return self.standing(np.vstack(rows), np.concatenate(roles))

    def standing(self, section, role):
        """The particles of a section that do not come too close to bed and lid, with their roles.
        """
        free = lattice.clear(self.case, section, np.vstack([self.floor[0], self.lid[0]]))
        return section[free], role[free]

    @property
    def _behind(self):
        """How far the piston goes back behind x = 0, in whole spacings."""
        return np.ceil(-self.backmost / self.case.particles.spacing)

    @cached_property
    def _section(self):
        """Bed, lid and end walls in the section: (n, 2) [m] and roles (n,)."""
        parts = [self.floor, self.lid, *(self.end_wall(side) for side in self._walled_ends)]
        sections, roles = zip(*parts, strict=True)
        return np.vstack(sections), np.concatenate(roles)

    @property
    def _walled_ends(self):
        return (1,) if self.has_piston else (-1, 1)

    def _smooth_bed(self):
        """Layers along the bed; the uppermost one is of faces."""
        case, layers, spacing = self.case, self.case.particles.layers, self.case.particles.spacing
        behind = (layers + self._behind) * spacing
        points = beds.extended(case.tank.bed, behind, layers * spacing)
        rows = [beds.layer(points, (k + 0.5) * spacing, spacing) for k in range(layers)]
        roles = [np.full(len(row), FILLER if k else FACE) for k, row in enumerate(rows)]
        outside = rows[0][:, 0] > effective_length(case) + spacing
        if not self.has_piston:
            outside |= rows[0][:, 0] < -spacing
        roles[0][outside] = FILLER
        return np.vstack(rows), np.concatenate(roles)

    def _staircase(self):
        """Bed cut out of the lattice, in steps of one spacing (to compare with the smooth bed)."""
        case, layers, spacing = self.case, self.case.particles.layers, self.case.particles.spacing
        behind = (layers + self._behind) * spacing
        end = effective_length(case)
        x = lattice.between(case, -behind, end + layers * spacing)
        top = np.ceil(beds.elevation(case.tank.bed, x) / spacing - 0.5)
        lowest = np.array([top[max(i - layers, 0) : i + layers + 1].min() for i in range(len(x))])
        high = np.array([top[max(i - 1, 0) : i + 2].min() for i in range(len(x))])
        rows, roles = [], []
        for i, place in enumerate(x):
            level = np.arange(lowest[i] - layers, top[i])
            rows.append(np.column_stack([np.full(len(level), place), (level + 0.5) * spacing]))
            wall = (level >= high[i] - 1) & (place < end + spacing)
            if not self.has_piston:
                wall &= place > -spacing
            roles.append(np.where(wall, FACE, FILLER))
        return np.vstack(rows), np.concatenate(roles)

    def _side_wall(self, layer):
        """One layer of a side wall: the whole section of the tank, and the solids beyond it."""
        case, layers, spacing = self.case, self.case.particles.layers, self.case.particles.spacing
        behind = self._behind * spacing if self.has_piston else 0.0
        end = effective_length(case)
        x = lattice.between(case, -behind - layers * spacing, end + layers * spacing)
        section = np.vstack([lattice.stack(case, place, case.tank.height) for place in x])
        if case.tank.lid:
            section = section[lattice.clear(case, section, self.lid[0])]
        solid, role = self._section
        beyond = solid[:, 1] < beds.elevation(case.tank.bed, solid[:, 0])
        beyond |= solid[:, 1] > self.top if case.tank.lid else False
        inside = (section[:, 0] > -behind - spacing) & (section[:, 0] < end + spacing)
        faces = np.concatenate([inside, role[beyond] == FACE]) & (layer == 0)
        return np.vstack([section, solid[beyond]]), np.where(faces, FACE, FILLER)
