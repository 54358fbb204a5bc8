"""Water at the start: the level that was asked for, in order, and at rest from the first step."""

import numpy as np
import pytest
from tanks import flow_of, make_case, number_density_over_n0

from mpslab import Simulation, load_case
from mpslab.core.stencil import make_stencil
from mpslab.run import settling

D0, GRAVITY, DENSITY = 0.002, 9.81, 1000.0
SETTLED = {"scheme.settling": 400}

BEDS = {
    "flat": [],
    "raised": [[0.0, 0.0063], [0.4, 0.0063]],
    "beach of 1:10": [[0.0, 0.0], [0.1, 0.0], [0.4, 0.03]],
    "beach of 1:6": [[0.0, 0.0], [0.1, 0.0], [0.4, 0.05]],
    "bar": [[0.0, 0.0], [0.15, 0.0], [0.2, 0.01], [0.25, 0.0], [0.4, 0.0]],
}


def tank(depth, bed="flat", **changes):
    gauges = [{"name": f"g{k}", "x": x} for k, x in enumerate((0.004, 0.05, 0.123, 0.2, 0.26))]
    probes = [{"name": "low", "x": 0.05, "z": BEDS[bed][0][1] if BEDS[bed] else 0.0}]
    return make_case(
        {
            "tank.length": 0.4, "tank.depth": depth, "tank.bed": BEDS[bed], "gauge": gauges,
            "probe": probes, **SETTLED, **changes,
        }
    )  # fmt: skip


@pytest.mark.parametrize("bed", BEDS)
@pytest.mark.parametrize("depth", [0.03, 0.0313, 0.03257, 0.041])
def test_every_gauge_reads_the_level_that_was_asked_for_from_the_start(depth, bed):
    """Whether the depth is a whole number of spacings or not, over any bed, but for the last two
    spacings before a wall, where a gauge sees a column or two.
    """
    gauges = Simulation(tank(depth, bed)).gauges
    for name in gauges.dtype.names[1:]:
        assert gauges[name][0] == pytest.approx(depth, abs=0.1 * D0), name


@pytest.mark.parametrize("depth", [0.03, 0.03257])
def test_water_holds_its_volume_whatever_the_depth(depth):
    particles = Simulation(tank(depth)).particles
    assert np.count_nonzero(particles.fluid) * D0**2 == pytest.approx(0.4 * depth, rel=2e-3)


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize(("depth", "bed"), [(0.0313, "flat"), (0.03, "beach of 1:6")])
def test_still_water_is_at_rest_from_the_first_step_on(depth, bed, seed):
    sim = Simulation(tank(depth, bed, **{"particles.seed": seed}))
    water = np.count_nonzero(sim.particles.fluid) * DENSITY * D0**2
    sim.run(until=0.025)
    first = sim.probes["low pressure"][1] / (DENSITY * GRAVITY * depth)
    assert first == pytest.approx(1.0, abs=0.1)
    assert np.sqrt(2.0 * sim.steps["kinetic_energy"].max() / water) < 0.005


def test_first_step_of_still_water_in_3d_has_its_weight():
    case = load_case(
        "hydrostatic", {"tank.width": 0.024, "tank.periodic": True, "particles.spacing": 0.003}
    )
    sim = Simulation(case)
    sim.advance()
    assert sim.probes["bed pressure"][1] / (DENSITY * GRAVITY * 0.04) == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize(("dim", "radius"), [(2, 1.8), (2, 2.1), (2, 2.25), (3, 2.1), (3, 2.5)])
def test_number_density_of_settled_water_is_that_of_the_table(dim, radius):
    """`Stencil.relaxed`, which in 3-D is that of moving water: 0.1 % less."""
    width = {"tank.width": 0.02, "tank.periodic": True, "tank.length": 0.03} if dim == 3 else {}
    scheme = {"scheme.effective_radius": radius, "scheme.laplacian_radius": radius}
    size = {"tank.length": 0.06, "tank.depth": 0.03}
    flow = flow_of(make_case({**size, **SETTLED, **width, **scheme}))
    settling.settle(flow)
    n = number_density_over_n0(flow.case, flow.particles, radius)
    x, z = flow.particles.position[:, 0], flow.particles.position[:, 2]
    margin = 3.0 * D0
    inside = flow.particles.fluid & (np.abs(z - 0.015) < 0.015 - margin)
    inside &= (x > margin) & (x < flow.case.tank.length - margin)
    stencil = make_stencil(dim, D0, radius)
    looser = 1.001 if dim == 3 else 1.0
    assert n[inside].mean() == pytest.approx(looser * stencil.relaxed / stencil.n0, abs=0.005)


def test_still_water_in_3d_keeps_its_level():
    """With a number density that is half a per cent too low it rises by as much in a second."""
    width = {"tank.width": 0.024, "tank.periodic": True, "tank.length": 0.04, "tank.depth": 0.04}
    flow = {**width, "tank.height": 0.06, "time.end": 0.5}
    sim = Simulation(make_case({**flow, **SETTLED}))
    sim.run()
    water = sim.particles.position[sim.particles.fluid, 2]
    assert 2.0 * water.mean() == pytest.approx(0.04, rel=0.002)


def test_settling_moves_the_pressure_with_the_water_and_leaves_no_lid():
    flow = flow_of(tank(0.0313))
    count = len(flow.particles)
    settling.settle(flow)
    p = flow.particles
    assert len(p) == count
    exact = DENSITY * GRAVITY * (0.0313 - p.position[p.fluid, 2])
    np.testing.assert_allclose(p.pressure[p.fluid], exact, atol=0.15 * DENSITY * GRAVITY * D0)
    assert np.all(p.velocity == 0.0)


def test_column_of_water_settles_with_its_faces_upright():
    box = {"from": [0.0, 0.0, 0.0], "to": [0.1, 0.0, 0.0473]}
    flow = flow_of(tank(0.0473, **{"water": [box]}))
    settling.settle(flow)
    x, z = flow.particles.position[flow.particles.fluid][:, [0, 2]].T
    right = [x[np.abs(z - at) < 0.6 * D0].max() for at in np.arange(0.004, 0.044, D0)]
    np.testing.assert_allclose(right, 0.1 - 0.45 * D0, atol=0.25 * D0)
    top = [z[np.abs(x - at) < 0.6 * D0].max() for at in np.arange(0.004, 0.096, D0)]
    np.testing.assert_allclose(top, 0.0473 - 0.45 * D0, atol=0.25 * D0)
