"""Watch over a run: particles that leave the tank, and states from which no step may follow."""

from dataclasses import dataclass

import numpy as np

from mpslab.core.lattice import effective_length, rows_across
from mpslab.kernels import tank as kernels
from mpslab.solids import obstacles, shaped

MOST_LOST = 1e-3  # of the fluid particles at the start
FEW_LOST = 5  # may be lost by any run
DRAINED = "drained by "  # and the name of the plane: what is taken out on purpose


class RunFailed(RuntimeError):
    """The run cannot go on; the message says why, at which step and time, and where."""


@dataclass(frozen=True)
class Lost:
    """Fluid particles that leave the tank: row numbers (n,) int and the side they leave by."""

    rows: np.ndarray
    reason: str


def find_lost(case, particles, face, free=()):
    """Fluid particles behind a wall by more than a spacing, or beyond a plane that drains.

    Returns a list of `Lost`; the reason of what drains begins with `DRAINED`.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    particles : ParticleSet
    face : float [m]
        x of the wavemaker's face.
    free : sequence of mpslab.solids.floating.Floating
    """
    suspects = _may_be_lost(case, particles, face)
    spacing, position = case.particles.spacing, particles.position.take(suspects, 0)
    first = "the wall at x = 0" if case.wavemaker.type == "none" else "the wavemaker"
    walls = [
        (first, position[:, 0] < face - spacing),
        ("the end wall", position[:, 0] > effective_length(case) + spacing),
    ]
    if case.tank.width > 0.0 and not case.tank.periodic:
        width = rows_across(case) * spacing
        out = (position[:, 1] < -spacing) | (position[:, 1] > width + spacing)
        walls.append(("a side wall", out))
    high = position[:, 2] > case.tank.height
    sides = [(DRAINED + one.name, position[:, 0] > one.x) for one in case.overtopping if one.drain]
    sides += [(f"over {wall}", out & high) for wall, out in walls]
    sides += [(f"behind {wall}", out & ~high) for wall, out in walls]
    bed = case.tank.bed_height(position[:, 0])
    sides.append(("below the bed", position[:, 2] < bed - spacing))
    if case.tank.lid:
        sides.append(("through the lid", position[:, 2] > case.tank.height + 2.0 * spacing))
    if case.obstacle:
        sides.append(("into an obstacle", obstacles.deep_inside(case, position) >= 0))
    if case.solid:
        sides.append(("into a solid", shaped.deep_inside(case, position)))
    sides += [(f"into {body.name}", body.deep_inside(position)) for body in free]
    found, seen = [], np.zeros(len(suspects), bool)
    for reason, outside in sides:
        rows = suspects[outside & ~seen]
        if len(rows):
            found.append(Lost(rows, reason))
            seen = seen | outside
    return found


def _may_be_lost(case, particles, face):
    """Rows of the water behind a wall or below the bed; as a rule that is little."""
    if case.obstacle or case.solid:
        return np.flatnonzero(particles.fluid)
    tank, rows = case.tank, np.empty(len(particles), np.int32)
    drains = [one.x for one in case.overtopping if one.drain]
    low = np.array([face, -np.inf, -np.inf])
    high = np.array([min(effective_length(case), tank.length, *drains), np.inf, np.inf])
    if tank.width > 0.0 and not tank.periodic:
        low[1], high[1] = 0.0, rows_across(case) * case.particles.spacing
    if tank.lid:
        high[2] = tank.height
    return rows[: kernels.outside(
        particles.position, particles.role, low, high, np.array(tank.bed, float), rows
    )]  # fmt: skip


def check_finite(flow, step):
    """Raise RunFailed where a position or velocity is not a number."""
    bad = _not_finite(flow.particles)
    found = flow.domain.from_all((len(bad), _place(flow, bad[0]) if len(bad) else None))
    places = [(place, rank) for rank, (_, place) in enumerate(found) if place]
    if places:
        place, rank = min(places)
        count = sum(count for count, _ in found)
        on = f" on rank {rank}" if len(found) > 1 else ""
        raise RunFailed(
            f"not a number in {count} particles, {_when(flow, step)}, {_named(place)}{on}"
        )


def _not_finite(particles):
    """Rows with a position or velocity that is not a number."""
    arrays = particles.position, particles.velocity
    # A sum is a number only if all its terms are: as a rule one look at each array is enough.
    if np.isfinite(sum(array.sum() for array in arrays)):
        return []
    return np.flatnonzero(~np.isfinite(np.hstack(arrays)).all(axis=1))


def check_step(flow, report, dt, step):
    """Raise RunFailed after a step that must not be followed by another."""
    check_finite(flow, step)
    when = _when(flow, step)
    if not report.converged:
        coarse = report.coarse
        nor = f", nor did its coarse system (residual {coarse:.3g})" if coarse > 0.0 else ""
        raise RunFailed(
            f"pressure did not converge{nor}: residual {report.residual:.3g} after "
            f"{report.iterations} iterations (scheme.tolerance = "
            f"{flow.case.scheme.tolerance:g}), {when}, {_fastest(flow)}"
        )
    if dt < flow.case.time.minimum:
        raise RunFailed(
            f"time step {dt:.3g} s below time.minimum = {flow.case.time.minimum:.3g} s, {when}, "
            f"{_fastest(flow)}"
        )


def _when(flow, step):
    return f"step {step}, t = {flow.time:.6g} s"


def check_lost(flow, lost, sides, at_start, step):
    """Raise RunFailed when too many particles have left the tank.

    Parameters
    ----------
    lost, at_start : int
        Particles lost so far, and those of water at the start.
    sides : dict of str to int
        How many have left by each side since the start or the restart.
    """
    if lost <= max(MOST_LOST * at_start, FEW_LOST):
        return
    found = ", ".join(f"{number} {side}" for side, number in sides.items())
    over = any(side.startswith("over") for side in sides)
    height = flow.case.tank.height
    mend = f"; tank.height = {height:g} m is too low for the water" if over else ""
    raise RunFailed(
        f"{lost} of {at_start} fluid particles lost, more than 0.1 %: {found}{mend}, "
        f"{_when(flow, step)}, {_fastest(flow)}"
    )


def _place(flow, row):
    return int(flow.particles.gid[row]), flow.particles.position[row].tolist()


def _named(place):
    gid, (x, y, z) = place
    return f"particle {gid} at x = {x:.4g}, y = {y:.4g}, z = {z:.4g} m"


def _fastest(flow):
    speed = np.where(flow.particles.fluid, np.abs(flow.particles.velocity).max(axis=1), -1.0)
    row = int(np.argmax(speed)) if len(speed) else None
    mine = None if row is None else (-float(speed[row]), _place(flow, row))
    return "fastest " + _named(min(found for found in flow.domain.from_all(mine) if found)[1])
