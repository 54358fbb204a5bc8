"""The examples of docs/python.md run as they stand."""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent


def test_examples_run_one_after_the_other(tmp_path):
    text = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    code = re.findall(r"^```python\n(.*?)^```$", text, re.M | re.S)
    assert len(code) == 10
    (tmp_path / "all.py").write_text("\n".join(code), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "all.py"], cwd=tmp_path, capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)}, timeout=250,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    told = dict(line.split(": ", 1) for line in done.stdout.splitlines())
    assert 0.22 < float(told["lowest"]) < 0.241
    assert float(told["face"]) > -0.02 + 1e-3
    assert float(told["farthest"]) > float(told["front"]) > 0.6
    assert "the run began with 'front', and no module holds it by a name" in told["refused"]
    assert sum(key.endswith(" s") for key in told) == 2
