"""Whatever the command line is given, it is taken or refused in one line, at once, and small."""

import resource
import subprocess
import sys
import warnings

import fuzz_inputs
import pytest

DRAWS = 200
# What would fill any memory if it were laid out, or take for ever.
HUGE = {
    "tank.height": "1e9",
    "tank.length": "1e9",
    "tank.depth": "1e9",
    "tank.width": "1e9",
    "particles.spacing": "1e-12",
    "time.end": "1e15",
    "time.maximum": "1e-15",
    "time.start": "1e-300",
    "time.courant": "1e-12",
    "fluid.viscosity": "1e3",
    "wavemaker.period": "1e-9",
    "wavemaker.start": "1e12",
    "output.interval": "1e-12",
    "output.gauge_interval": "1e-12",
    "output.pictures": "[" + "0.1," * 2000 + "]",
}


def test_any_input_is_taken_or_refused_in_one_line_with_little_time_and_memory(tmp_path):
    before = fuzz_inputs.peak_bytes()
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        for seed in range(DRAWS):
            folder = tmp_path / str(seed)
            folder.mkdir()
            words = fuzz_inputs.draw(seed, folder)
            assert fuzz_inputs.faults(words, folder) == [], (seed, words)
    assert fuzz_inputs.peak_bytes() - before < fuzz_inputs.MOST_BYTES


@pytest.mark.parametrize(("key", "value"), HUGE.items(), ids=HUGE)
def test_no_size_is_laid_out_before_it_is_looked_at(key, value, tmp_path):
    words = ["regular_waves", "--check", "--set", f"{key}={value}"]
    before = fuzz_inputs.peak_bytes()
    assert fuzz_inputs.faults(words, tmp_path) == []
    assert fuzz_inputs.peak_bytes() - before < fuzz_inputs.MOST_BYTES


def limited():
    resource.setrlimit(resource.RLIMIT_DATA, (int(1e9), int(1e9)))
    resource.setrlimit(resource.RLIMIT_CPU, (20, 20))


@pytest.mark.parametrize("seed", [3, 60, 118])
def test_command_by_itself_keeps_within_its_limits(seed, tmp_path):
    words = [word.replace("\x00", "") for word in fuzz_inputs.draw(seed, tmp_path)]
    before = sorted(tmp_path.iterdir())
    done = subprocess.run(
        [sys.executable, "-m", "mpslab.tank", *words], cwd=tmp_path, preexec_fn=limited,
        capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode in (0, 2), done.stderr
    assert "Traceback" not in done.stderr
    assert sorted(tmp_path.iterdir()) == before
