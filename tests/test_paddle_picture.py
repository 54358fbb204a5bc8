"""A picture of what the wavemaker will do."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from mpslab import cases, tank
from mpslab.analysis import paddle_picture, tank_picture
from mpslab.core.keys import CaseError
from mpslab.run.preflight import preflight
from mpslab.theory import waves


def test_spectrum_holds_the_variance_of_the_wave():
    """a^2 / 2 of a regular wave, in one peak at its frequency."""
    times = np.linspace(0.0, 50.0, 5001)
    ratio = waves.biesel_stroke_ratio(waves.wave_number(1.0, 0.3, 9.81) * 0.3)
    place = 0.02 / ratio * np.sin(2.0 * np.pi * times)
    frequency, density = paddle_picture.spectrum(times, place, 0.3, 9.81)
    assert frequency[np.argmax(density)] == pytest.approx(1.0, abs=0.02)
    assert np.sum(density) * frequency[0] == pytest.approx(0.02**2 / 2.0, rel=0.01)


@pytest.mark.parametrize("name", ["irregular_waves", "focused_wave", "solitary_runup"])
def test_check_draws_a_picture(name, tmp_path, capsys):
    path = tmp_path / "maker.png"
    assert tank.main([name, "--check", "--draw", str(path)]) == 0
    assert path.stat().st_size > 10_000
    assert "stroke" in capsys.readouterr().out


@pytest.mark.parametrize("width", [0.0, 0.3])
def test_check_draws_the_tank_with_its_solids(width, tmp_path):
    path = tmp_path / "tank.png"
    ball = {"shape": "cylinder", "center": [0.7, 0.1, 0.2], "radius": 0.1}
    case = cases.load_case("dam_break", {"tank.width": width, "solid": [ball]})
    (tmp_path / "case.toml").write_text(cases.dumps(case))
    assert tank.main([str(tmp_path / "case.toml"), "--check", "--draw", str(path)]) == 0
    assert path.with_stem("tank-tank").stat().st_size > 10_000
    assert not path.exists()  # there is no wavemaker


def drawn(monkeypatch, module, case, path):
    """The axes of a picture."""
    figures = []

    class Kept(Figure):
        def savefig(self, *arguments, **options):
            figures.append(self)

    monkeypatch.setattr(module, "Figure", Kept)
    module.draw(case, path)
    return figures[0].axes


@pytest.mark.parametrize("name", ["irregular_waves", "regular_waves"])
def test_every_line_of_the_spectrum_is_named(monkeypatch, name):
    lower = drawn(monkeypatch, paddle_picture, cases.load_case(name), "none.png")[-1]
    names = [text.get_text() for text in lower.get_legend().get_texts()]
    assert names == ["of the motion", "asked for"][: len(lower.lines)] and names


@pytest.mark.parametrize("name", ["floating_box", "cylinder_in_waves"])
def test_still_water_is_drawn_beside_the_solids_alone(monkeypatch, name):
    case = cases.load_case(name)
    for axes in drawn(monkeypatch, tank_picture, case, "none.png"):
        if axes.get_ylabel() != "z [m]":
            continue
        line = next(line for line in axes.lines if len(line.get_xdata()) > 2)
        faces = axes.collections[0].get_offsets()
        middle, half = 0.5 * (faces[:, 0].min() + faces[:, 0].max()), 0.5 * np.ptp(faces[:, 0])
        off = np.abs(line.get_xdata() - middle) - half
        hidden = np.isnan(line.get_ydata())
        assert hidden[off < -case.particles.spacing].all() and not hidden[off > 1e-6].any()
        assert axes.get_ylim()[1] > faces[:, 1].max()


def test_where_there_is_nothing_to_draw_it_is_refused(tmp_path, capsys):
    assert tank.main(["dam_break", "--check", "--draw", str(tmp_path / "a.png")]) == 2
    assert "wavemaker.type = 'none'" in capsys.readouterr().err
    assert tank.main(["irregular_waves", "--draw", str(tmp_path / "a.png")]) == 2
    assert "together with --check only" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_sea_that_is_too_fine_for_the_particles_brings_a_warning():
    fine = cases.load_case("irregular_waves", {"wavemaker.band": [0.5, 8.0]})
    assert any("the shortest waves of the sea" in line for line in preflight(fine).warnings)
    assert not preflight(cases.load_case("irregular_waves")).warnings
    with pytest.raises(CaseError, match=r"^wavemaker\.file = '': must be a CSV file that exists"):
        cases.load_case("irregular_waves", {"wavemaker.spectrum": "file"})
