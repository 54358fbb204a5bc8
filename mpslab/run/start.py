"""Where a run starts: with its tank laid out, or from a checkpoint."""

from mpslab.core.particles import ParticleSet, no_particles
from mpslab.forcings import check_own
from mpslab.output import checkpoint
from mpslab.parallel.communicator import on_root
from mpslab.parallel.domain import world
from mpslab.run import initial, settling
from mpslab.run.flow import make_flow
from mpslab.solids import layout
from mpslab.solids.collection import solids_of
from mpslab.solids.piston import make_paddle


def lay_out(case, own):
    """The flow of a case at t = 0, its water settled.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    own : mpslab.core.own.Own
    """
    paddle = make_paddle(case)
    backmost = paddle.backmost if paddle else 0.0
    flow = _flow(case, own, paddle, lambda: layout.build_particles(case, backmost, own.solids))
    settling.settle(flow)
    initial.set_velocity(case, flow.particles, flow.domain.total)
    for body in flow.solids.free:
        body.set_off(flow.particles)
    return flow


def take_up(found, path):
    """The flow of a checkpoint.

    Parameters
    ----------
    found : mpslab.output.restart.Restart
    path : Path
        Of the checkpoint.
    """
    case = found.case
    flow = _flow(
        case, found.own, make_paddle(case), lambda: ParticleSet(**checkpoint.read(path)[0])
    )
    flow.restore(found.state)
    return flow


def _flow(case, own, paddle, make):
    """The flow of the particles that `make` gives on rank 0: no other holds the whole tank."""
    check_own(case, own.forcings)
    particles = on_root(world(), make) or no_particles()
    solids = solids_of(case, paddle, own.solids)
    return make_flow(case, particles, solids, layout.period(case), own.forcings)
