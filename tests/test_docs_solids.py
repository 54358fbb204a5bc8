"""The examples of docs/solids.md run as they stand."""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent


def test_examples_run_one_after_the_other(tmp_path):
    text = (ROOT / "docs/solids.md").read_text(encoding="utf-8")
    code = re.findall(r"^```python\n(.*?)^```$", text, re.M | re.S)
    assert len(code) == 5
    (tmp_path / "all.py").write_text("\n".join(code), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "all.py"], cwd=tmp_path, capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)}, timeout=250,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    lowest, face = map(float, done.stdout.split())
    assert 0.22 < lowest < 0.241
    assert face > -0.02 + 1e-3
