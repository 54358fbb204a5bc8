"""Particles that left the tank, or were taken out of it by a plane that drains."""

from mpslab.core.columns import LOST_COLUMNS
from mpslab.instruments import Instrument


def make(case):
    """The table of lost particles."""
    return Lost()


class Lost(Instrument):
    """Number, place and side of each particle that leaves; read before it is taken out."""

    name = "lost"
    columns = LOST_COLUMNS
    interval = None
    words = {"reason": 100}  # noqa: RUF012

    def read(self, flow):
        """A row for each particle that the last step lost, on any rank."""
        p, step = flow.particles, flow.done["step"]
        mine = [
            (int(p.gid[row]), p.position[row].tolist(), side.reason)
            for side in flow.done["leaving"]
            for row in side.rows
        ]
        found = sorted(one for rank in flow.domain.from_all(mine) for one in rank)
        return [(step, flow.time, gid, *place, reason) for gid, place, reason in found]
