"""The initial particles: counts, distances, walls and volume."""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tanks import closest, flow_of, make_case, neighbors_of, number_density_over_n0

from mpslab import load_case
from mpslab.core import bed as beds
from mpslab.core.particles import FACE, FILLER, PISTON
from mpslab.core.stencil import make_stencil
from mpslab.run.settling import settle
from mpslab.solids import layout

D0 = 0.002
PAPER = {"particles.spacing": D0, "tank.width": 0.0, "particles.jitter": 0.0}
BACKMOST = -0.01

BEDS = {
    "flat": [[0.0, 0.0], [0.4, 0.0]],
    "slope": [[0.0, 0.0], [0.1, 0.0], [0.4, 0.1]],
    "corner between columns": [[0.0, 0.0], [0.1973, 0.0], [0.4, 0.0713]],
    "bar": [[0.0, 0.0], [0.15, 0.0], [0.2, 0.02], [0.25, 0.0], [0.4, 0.0]],
    "steep bar": [[0.0, 0.0], [0.15, 0.0], [0.2, 0.05], [0.25, 0.0], [0.4, 0.0]],
    "dipping at the wavemaker": [[0.0, 0.02], [0.1, 0.0], [0.2, 0.03], [0.4, 0.0]],
    "reef": [[0.0, 0.0], [0.2, 0.0], [0.202, 0.03], [0.4, 0.03]],
}


def paper_slice(**changes):
    """Slice of the paper's tank at d0 = 2 mm, without jitter."""
    case = load_case("plunging_breaker", {**PAPER, **changes})
    return case, layout.build_particles(case, BACKMOST)


def tank_with(bed, **changes):
    case = make_case(
        {"tank.length": 0.4, "tank.depth": 0.06, "tank.bed": BEDS[bed], **changes}
    )  # fmt: skip
    return case, layout.build_particles(case)


def test_slice_of_the_papers_tank_has_4000_fluid_particles():
    _, particles = paper_slice()
    assert np.count_nonzero(particles.fluid) == pytest.approx(4000, rel=0.01)
    # Walls, dummies and piston at three layers: 1,330 a row (reference 6.1), plus the end walls.
    assert 1300 < np.count_nonzero(~particles.fluid) < 1600


def test_papers_tank_in_3d_has_about_its_96000_particles():
    """16 to 20 rows across (reference 6.1); 17 rows at d0 = 2 mm."""
    case = load_case("plunging_breaker", {"particles.spacing": D0, "tank.width": 0.034})
    particles = layout.build_particles(case, BACKMOST)
    assert layout.rows_across(case) == 17
    assert len(particles) == pytest.approx(96_000, rel=0.05)
    assert np.count_nonzero(particles.fluid) == pytest.approx(68_000, rel=0.01)


@pytest.mark.parametrize("layout", ["smooth", "staircase"])
def test_nothing_in_the_papers_tank_is_closer_than_the_limit(layout):
    _, particles = paper_slice(**{"particles.bed": layout})
    assert closest(particles.position) > 0.7 * D0


@pytest.mark.parametrize("layout", ["smooth", "staircase"])
@pytest.mark.parametrize("bed", BEDS)
def test_nothing_is_closer_than_the_limit_on_any_bed(bed, layout):
    _, particles = tank_with(bed, **{"particles.bed": layout})
    assert closest(particles.position) > 0.7 * D0


@pytest.mark.parametrize("layout", ["smooth", "staircase"])
@pytest.mark.parametrize("bed", BEDS)
def test_water_is_about_a_spacing_off_every_other_particle(bed, layout):
    """A column of no whole number of spacings is spread evenly."""
    _, particles = tank_with(bed, **{"particles.bed": layout})
    tree = cKDTree(particles.position)
    deep = particles.fluid & (beds.elevation(BEDS[bed], particles.position[:, 0]) < 0.04)
    assert tree.query(particles.position[particles.fluid], k=2)[0][:, 1].min() > 0.749 * D0
    assert tree.query(particles.position[deep], k=2)[0][:, 1].min() > 0.88 * D0


def test_water_of_whole_spacings_is_laid_on_the_lattice():
    _, particles = tank_with("flat")
    lattice = particles.position[particles.fluid][:, [0, 2]] / D0 - 0.5
    np.testing.assert_allclose(lattice, np.round(lattice), atol=1e-9)


@pytest.mark.parametrize("bed", BEDS)
def test_settled_water_is_in_order_up_to_its_level(bed):
    """Full number density on the mean, no pair closer than 0.85 spacings, a level surface."""
    case = make_case(
        {"tank.length": 0.4, "tank.depth": 0.06, "tank.bed": BEDS[bed], "scheme.settling": 400}
    )
    flow = flow_of(case)
    count = np.count_nonzero(flow.particles.fluid)
    settle(flow)
    particles = flow.particles
    assert np.count_nonzero(particles.fluid) == count
    n = number_density_over_n0(case, particles)
    covered = particles.fluid & (particles.position[:, 2] < 0.06 - 2.0 * D0)
    assert np.mean(n[covered]) == pytest.approx(1.0, abs=0.005)
    assert cKDTree(particles.position).query(
        particles.position[particles.fluid], k=2
    )[0][:, 1].min() > 0.85 * D0  # fmt: skip
    x = particles.position[:, 0]
    deep = particles.fluid & (beds.elevation(BEDS[bed], x) < 0.04)
    top = [particles.position[deep & (np.abs(x - at) < 2.0 * D0), 2].max()
           for at in np.unique(np.round(x[deep], 3))]  # fmt: skip
    np.testing.assert_allclose(top, 0.06 - 0.4 * D0, atol=0.2 * D0)


@pytest.mark.parametrize(("start", "end"), [(0.01, 0.19), (0.22, 0.55)])
def test_bed_is_a_spacing_below_the_first_water_on_the_flat_and_along_the_slope(start, end):
    """Measured normal to the bed; on the slope columns are spread over no whole spacings."""
    case, particles = paper_slice()
    x, z = particles.position[:, 0], particles.position[:, 2]
    there = (x > start) & (x < end)
    lean = np.sqrt(1.0 + beds.slope(case.tank.bed, x) ** 2)
    off = (z - beds.elevation(case.tank.bed, x)) / lean
    columns = np.round(x / D0 - 0.5).astype(int)
    water = particles.fluid & there
    least = [off[water & (columns == column)].min() for column in np.unique(columns[water])]
    if end < 0.2:
        np.testing.assert_allclose(least, 0.5 * D0, rtol=1e-6)
    assert np.median(least) == pytest.approx(0.5 * D0, rel=0.02)
    assert np.min(least) > 0.374 * D0
    assert np.max(least) < 0.75 * D0
    np.testing.assert_allclose(off[there & (particles.role == FACE)], -0.5 * D0, rtol=1e-6)
    for k in (1, 2):
        layer = there & (np.abs(off + (k + 0.5) * D0) < 0.1 * D0)
        assert np.all(particles.role[layer] == FILLER)
        assert np.count_nonzero(layer) > 0.9 * (end - start) / D0


@pytest.mark.parametrize("layout", ["smooth", "staircase"])
@pytest.mark.parametrize("bed", BEDS)
def test_volume_of_water_is_that_of_the_tank(bed, layout):
    case, particles = tank_with(bed, **{"particles.bed": layout})
    x = np.linspace(0.0, 0.4, 40001)
    depth = np.maximum(0.06 - beds.elevation(case.tank.bed, x), 0.0)
    volume = np.count_nonzero(particles.fluid) * D0**2
    assert volume == pytest.approx(np.mean(depth) * 0.4, rel=0.01)


def test_water_ends_at_the_still_level():
    case, particles = paper_slice()
    z = particles.position[particles.fluid, 2]
    assert z.max() < case.tank.depth
    flat = particles.fluid & (particles.position[:, 0] < 0.2)
    assert particles.position[flat, 2].max() == pytest.approx(case.tank.depth - 0.5 * D0)


ON_THE_LATTICE = [
    ("flat", "smooth"), ("flat", "staircase"), ("slope", "staircase"),
    ("corner between columns", "staircase"),
]  # fmt: skip


@pytest.mark.parametrize(("bed", "layout"), ON_THE_LATTICE)
def test_number_density_of_the_water_is_full_down_to_the_walls(bed, layout):
    """A gap or a squeeze at a wall would push the water in the first step."""
    case, particles = tank_with(bed, **{"particles.bed": layout})
    n = number_density_over_n0(case, particles)
    covered = particles.fluid & (particles.position[:, 2] < 0.06 - 2.0 * D0)
    assert n[covered].min() > 0.97
    assert n[covered].max() < 1.03


def test_staircase_bed_stands_on_the_lattice():
    _, particles = paper_slice(**{"particles.bed": "staircase"})
    lattice = particles.position[:, [0, 2]] / D0 - 0.5
    assert np.abs(lattice - np.round(lattice)).max() < 1e-9


def test_smooth_bed_does_not():
    _, particles = paper_slice()
    lattice = particles.position[particles.role == FACE][:, 2] / D0 - 0.5
    assert np.abs(lattice - np.round(lattice)).max() > 0.4


@pytest.mark.parametrize("layout", ["smooth", "staircase"])
def test_walls_fill_the_effective_radius(layout):
    """No water particle at a wall misses a neighbour, with the larger radius of `paper` too."""
    recipe = {"scheme.recipe": "paper", "particles.bed": layout}
    case, particles = tank_with("flat", **recipe)
    assert case.particles.layers == 4
    stencil = make_stencil(2, D0, 3.1)
    found = neighbors_of(particles.position, stencil.radius)
    count = np.diff(found.indptr)
    covered = particles.fluid & (particles.position[:, 2] < 0.06 - 3.2 * D0)
    assert np.all(count[covered] == 28)


def test_end_walls_reach_the_height_asked_for():
    _, particles = tank_with("slope", **{"tank.height": 0.15})
    x, z = particles.position[:, 0], particles.position[:, 2]
    for end in (x < 0.0, x > 0.4):
        assert z[end & (particles.role == FACE)].max() == pytest.approx(0.15 - 0.5 * D0, abs=D0)


@pytest.mark.parametrize("layout", ["smooth", "staircase"])
@pytest.mark.parametrize("bed", BEDS)
def test_only_particles_next_to_the_tank_carry_pressure(bed, layout):
    """Wall particles deeper in the solid would be an unknown cut off from the water."""
    case, particles = tank_with(bed, **{"particles.bed": layout})
    x, z = particles.position[:, 0], particles.position[:, 2]
    wall = particles.role == FACE
    assert np.all((x[wall] > -D0) & (x[wall] < 0.4 + 1.5 * D0))
    points = np.linspace(0.0, 0.4, 4001)
    line = np.column_stack([points, beds.elevation(case.tank.bed, points)])
    bottom = wall & (x > 0.0) & (x < 0.4)
    apart = cKDTree(line).query(np.column_stack([x, z])[bottom])[0]
    assert apart.max() < 2.5 * D0


def test_fixed_wall_in_a_tank_without_wavemaker():
    _, particles = tank_with("flat")
    assert not particles.moves_with_piston.any()


def test_piston_stands_at_its_place_with_its_dummies_behind():
    _, particles = paper_slice()
    x = particles.position[:, 0]
    piston = particles.body == PISTON
    np.testing.assert_allclose(x[piston & (particles.role == FACE)], -0.5 * D0, rtol=1e-9)
    assert set(np.round(x[piston & (particles.role == FILLER)] / D0, 6)) == {-1.5, -2.5}
    assert particles.position[piston & (particles.role == FACE), 2].min() > 0.0


@pytest.mark.parametrize("backmost", [0.0, -0.0101, -0.02])
def test_bed_reaches_behind_the_piston_at_its_backmost(backmost):
    case = load_case("plunging_breaker", PAPER)
    particles = layout.build_particles(case, backmost)
    bed = (particles.role == FACE) | (particles.role == FILLER)
    assert particles.position[bed, 0].min() < backmost - 2.0 * D0


def test_particles_start_at_rest_with_hydrostatic_pressure():
    case, particles = paper_slice()
    assert np.all(particles.velocity == 0.0)
    flat = (particles.position[:, 0] > 0.0) & (particles.position[:, 0] < 0.2)
    z = particles.position[:, 2]
    exact = 1000.0 * 9.81 * np.maximum(case.tank.depth - z, 0.0)
    there = flat & particles.carries_pressure
    np.testing.assert_allclose(particles.pressure[there], exact[there], atol=1e-9)
    assert np.all(particles.pressure[~particles.carries_pressure] == 0.0)


def test_length_is_rounded_to_whole_spacings():
    case = make_case({"tank.length": 0.0413})
    assert layout.effective_length(case) == pytest.approx(0.042)
