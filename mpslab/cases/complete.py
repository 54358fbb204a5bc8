"""Fills in the values of a case that follow from others, so that a run can be read off its case."""

from dataclasses import replace
from math import ceil

from mpslab.core import timestep
from mpslab.core.parameters import Case
from mpslab.forcings.frame import strongest

THICKNESS = 2.0  # spacings of water that a run-up wants unless told


def complete(case: Case) -> Case:
    """The case with nothing left open; a case that is complete comes back equal.

    Left open by 0 or [], or left out: wall height, bed, wall layers, limits of the time step,
    output intervals, names of solids, the axis of a roll, the thickness of a run-up, and y of the
    instruments. In a 2-D tank every y is 0.
    """
    tank = _tank(case.tank)
    frame = replace(case.frame, center=case.frame.center or (0.5 * tank.length, 0.0))
    case = replace(case, tank=tank, frame=frame)
    return replace(
        case,
        water=_boxes(case.water, tank),
        obstacle=_named("obstacle", _boxes(case.obstacle, tank)),
        gate=_named("gate", case.gate),
        solid=_named("solid", case.solid),
        mooring=_named("mooring", case.mooring),
        particles=replace(case.particles, layers=case.particles.layers or least_layers(case)),
        time=_time(case),
        output=_output(case),
        gauge=tuple(_across(gauge, tank) for gauge in case.gauge),
        probe=tuple(_across(probe, tank) for probe in case.probe),
        runup=tuple(_thick(_across(runup, tank), case) for runup in case.runup),
    )


def least_layers(case: Case) -> int:
    """Layers of wall and dummy particles that fill the largest radius of the scheme."""
    return ceil(case.scheme.reach)


def _tank(tank):
    bed = tank.bed or ((0.0, 0.0), (tank.length, 0.0))
    top = max(z for _, z in bed)
    return replace(tank, bed=bed, height=tank.height or max(3.0 * tank.depth, top + tank.depth))


def _time(case):
    time = case.time
    maximum = time.maximum or timestep.largest(case, strongest(case))
    return replace(
        time,
        courant=time.courant or timestep.COURANT[case.scheme.projection],
        maximum=maximum,
        start=time.start or maximum / 10.0,
        minimum=time.minimum or maximum * 1e-4,
    )


def _output(case):
    output, end = case.output, case.time.end
    return replace(
        output, interval=output.interval or end / 50.0, checkpoint=output.checkpoint or end / 5.0
    )


def _across(instrument, tank):
    middle = 0.5 * tank.width
    return replace(
        instrument, y=middle if instrument.y is None or tank.width == 0.0 else instrument.y
    )


def _thick(runup, case):
    return replace(runup, thickness=runup.thickness or THICKNESS * case.particles.spacing)


def _boxes(boxes, tank):
    return tuple(_flat_box(box) for box in boxes) if tank.width == 0.0 else boxes


def _named(kind, solids):
    return tuple(
        replace(solid, name=solid.name or f"{kind}-{i}") for i, solid in enumerate(solids, 1)
    )


def _flat_box(box):
    (x0, _, z0), (x1, _, z1) = box.start, box.end
    return replace(box, start=(x0, 0.0, z0), end=(x1, 0.0, z1))
