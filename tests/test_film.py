"""A film shows the frames of a run, each once, in its time and size."""

import re
import shutil
import subprocess
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image
from synthetic import kinds_of, tank, write_run

from mpslab import film
from mpslab.analysis.scenes import reel, scene, stills
from mpslab.core.particles import make_particles
from mpslab.output.vtkhdf import ParticleSeries

SPACING, WIDTH = 0.008, 0.032
FRAMES, INTERVAL = 6, 0.25


@pytest.fixture(scope="module")
def flat(tmp_path_factory):
    return write_run(tmp_path_factory.mktemp("flat") / "run", SPACING, FRAMES).path


@pytest.fixture(scope="module")
def solid(tmp_path_factory, flat):
    """The same waves in 3-D."""
    folder = tmp_path_factory.mktemp("solid") / "run"
    folder.mkdir()
    text = (flat / "case.toml").read_text()
    wide = text.replace("width = 0.0", f"width = {WIDTH}\nperiodic = true")
    (folder / "case.toml").write_text(wide)
    series = ParticleSeries(folder / "particles.vtkhdf", ["velocity", "pressure"])
    for time in np.linspace(0, INTERVAL * (FRAMES - 1), FRAMES):
        slices = [tank(time, SPACING) for _ in np.arange(0.0, WIDTH, SPACING)]
        for number, piece in enumerate(slices):
            piece.position[:, 1] = (number + 0.5) * SPACING
        whole = make_particles(
            *(np.concatenate([getattr(p, name) for p in slices])
              for name in ("position", "role", "body"))
        )  # fmt: skip
        whole.velocity[:] = np.concatenate([p.velocity for p in slices])
        series.append(time, whole, kinds_of(whole))
    return folder


def pictures(path):
    """Pictures and their durations [ms] of an animation."""
    found = []
    with Image.open(path) as animation:
        for number in range(animation.n_frames):
            animation.seek(number)
            animation.load()
            found.append((np.asarray(animation.convert("RGB")), animation.info["duration"]))
    return found


@pytest.mark.parametrize("suffix", [".webp", ".gif"])
@pytest.mark.parametrize("run", ["flat", "solid"])
def test_an_animation_has_the_frames_the_size_and_the_duration(run, suffix, request, tmp_path):
    folder, out = request.getfixturevalue(run), tmp_path / f"film{suffix}"
    path, size, rung = film.make(folder, out, fps=10, width=320)
    assert (path, size, rung) == (out, out.stat().st_size, 0)
    shown = pictures(out)
    assert len(shown) == FRAMES
    assert sum(duration for _, duration in shown) == 100 * FRAMES
    assert {image.shape[1] for image, _ in shown} == {320}
    assert {image.shape[0] % 2 for image, _ in shown} == {0}
    changes = [np.abs(a.astype(int) - b).mean()
               for (a, _), (b, _) in pairwise(shown)]  # fmt: skip
    assert min(changes) > 0.1, "a picture is that before it"
    assert [p.name for p in tmp_path.iterdir()] == [out.name], "a draft was left"


@pytest.mark.skipif(reel.find_ffmpeg() is None, reason="no ffmpeg")
def test_an_mp4_has_the_frames_the_size_and_the_format(flat, tmp_path):
    out = tmp_path / "film.mp4"
    film.make(flat, out, fps=10, width=321)
    said = subprocess.run([reel.find_ffmpeg(), "-i", out, "-f", "null", "-"],
                          capture_output=True, text=True).stderr  # fmt: skip
    assert "h264" in said and "yuv420p" in said
    assert " 320x" in said and "10 fps" in said and "Duration: 00:00:00.60" in said
    assert re.findall(r"frame= *(\d+)", said)[-1] == str(FRAMES)
    content = out.read_bytes()
    assert content.index(b"moov") < content.index(b"mdat"), "not ready to play while it loads"


def test_from_and_to_pick_frames_and_the_window_is_what_is_seen(flat, tmp_path):
    out = tmp_path / "film.webp"
    film.make(flat, out, start=0.5, end=1.0, window=(0.3, 0.7), width=320)
    assert len(pictures(out)) == 3


@pytest.mark.parametrize("surface", [False, True])
def test_a_film_of_3d_shows_water_with_and_without_pyvista(solid, tmp_path, monkeypatch, surface):
    monkeypatch.setattr(scene, "find_spec", lambda name: None)
    out = tmp_path / "film.webp"
    film.make(solid, out, field="none", width=320, start=0.9, surface=surface)
    for image, _ in pictures(out):
        assert np.mean(image[..., 2].astype(int) - image[..., 0] > 40) > 0.02


@pytest.mark.parametrize("field", ["speed", "along", "pressure", "none"])
def test_every_field_is_drawn(flat, tmp_path, field):
    assert film.make(flat, tmp_path / "film.webp", field=field, width=240, start=1.0)[1] > 0


def test_a_limit_lowers_the_quality_or_is_told(flat, tmp_path, capsys):
    out = tmp_path / "film.webp"
    full = film.make(flat, out, width=320, start=1.0)[1]
    _, size, rung = film.make(flat, out, width=320, start=1.0, limit=0.7e-6 * full)
    assert size <= 0.7 * full and rung > 0
    assert film.main([str(flat), "--out", str(out), "--from", "1", "--limit", "0.001"]) == 3
    assert "more than the limit of 0.001 MB" in capsys.readouterr().out
    assert out.exists()


def test_the_command_says_what_it_wrote(flat, tmp_path, capsys):
    out = tmp_path / "film.gif"
    assert film.main([str(flat), "--out", str(out), "--width", "240"]) == 0
    assert f"{out}: " in capsys.readouterr().out


def test_without_ffmpeg_the_film_is_a_webp_and_says_so(flat, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(reel.shutil, "which", lambda name: None)
    monkeypatch.setitem(film.sys.modules, "imageio_ffmpeg", None)
    folder = shutil.copytree(flat, tmp_path / "run")
    assert film.main([str(folder), "--width", "240"]) == 0
    assert "no ffmpeg" in capsys.readouterr().out
    assert (folder / "film.webp").exists()
    assert film.main([str(folder), "--out", "film.mp4"]) == 2
    assert "there is no ffmpeg for .mp4" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--out", "film.avi"], "suffix must be out of .mp4, .webp, .gif"),
        (["--out", "nowhere/film.gif"], "there is no folder nowhere"),
        (["--fps", "0"], "--fps 0: must be from 1 to 60"),
        (["--fps", "many"], "--fps"),
        (["--width", "100"], "--width 100: must be from 240 to 3840"),
        (["--window", "2", "3"], "of the tank, which reaches from 0 to 0.8 m"),
        (["--window", "0.5", "0.4"], "--window 0.5 0.4"),
        (["--from", "9"], "0 of the frames lie there"),
        (["--to", "nan"], "0 of the frames lie there"),
        (["--field", "colour"], "--field colour: must be out of speed, along, pressure, none"),
        (["--surface"], "--surface: is of a run in 3-D"),
        (["--limit", "0"], "--limit 0: must be above 0 MB"),
        (["--speed", "3"], "--speed"),
    ],
)
def test_bad_input_is_refused_in_one_line(flat, arguments, says, capsys):
    before = sorted(flat.iterdir())
    assert film.main([str(flat), "--out", str(flat / "film.webp"), *arguments]) == 2
    said = capsys.readouterr().err
    assert said.startswith("mpslab: ") and said.count("\n") == 1 and says in said
    assert sorted(flat.iterdir()) == before


def test_a_folder_without_frames_or_case_is_refused(flat, tmp_path, capsys):
    assert film.main([str(tmp_path), "--out", str(tmp_path / "film.gif")]) == 2
    assert "cannot be read as a case" in capsys.readouterr().err
    shutil.copy(flat / "case.toml", tmp_path)
    assert film.main([str(tmp_path), "--out", str(tmp_path / "film.gif")]) == 2
    assert "holds no particles.vtkhdf" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("speed", "words"),
    [(0.25, "1/4 of real speed"), (1.01, "real speed"), (2.5, "2.5 x real speed")],
)
def test_the_pace_is_told(speed, words):
    assert film.pace(speed) == words


def test_the_picture_of_a_frame_shows_the_water_in_its_colour(flat):
    run = film.open_run(flat)
    case, frame = run.tables, run.frames[0]
    box = stills.box_of([frame], case)
    image = stills.Shot(case, box, "speed", 480, "real speed").painter()(0.0, frame)
    slow = np.array([68, 1, 84])  # the first colour of viridis: the water is at rest
    share = np.mean(np.abs(image.astype(int) - slow).max(axis=2) < 12)
    water = case["tank"]["depth"] * 0.4 / ((box[0][1] - box[0][0]) * (480 * 0.875 / 480))
    assert share > 0.3 * water


def test_a_reel_refuses_a_picture_of_another_size():
    with reel.Reel() as pictures:
        pictures.append(np.zeros((4, 6, 3), np.uint8))
        with pytest.raises(ValueError, match="picture of 8 x 4"):
            pictures.append(np.zeros((4, 8, 3), np.uint8))


def test_an_encoder_that_fails_leaves_no_file(tmp_path, monkeypatch):
    monkeypatch.setattr(reel, "find_ffmpeg", lambda: "false")
    with reel.Reel() as pictures:
        pictures.append(np.zeros((4, 6, 3), np.uint8))
        with pytest.raises((RuntimeError, OSError)):
            reel.write(pictures, tmp_path / "film.mp4", 25)
    assert list(tmp_path.iterdir()) == []
