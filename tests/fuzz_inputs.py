"""Random command lines: slips of units, wrong types, nonsense, huge and tiny; by number, the same.

    python tests/fuzz_inputs.py 2000        # draws 0 to 1999, those that go wrong are told
"""

import io
import os
import random
import resource
import sys
import tempfile
import time
import traceback
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import fields
from functools import cache
from pathlib import Path

from mpslab import cases, tank
from mpslab.core.keys import toml_name
from mpslab.core.parameters import LISTS, TABLES

MOST_SECONDS = 2.0  # of a processor
MOST_BYTES = 300e6  # of growth over all draws
LISTED = {
    "water": "[{from=[0,0,0], to=[0.06,0.02,0.03]}]",
    "obstacle": "[{from=[0.03,0,0], to=[0.06,0.02,0.02]}]",
    "gate": "[{x=0.05, speed=0.5}]",
    "gauge": '[{name="a", x=0.03}]',
    "probe": '[{name="a", x=0.03, z=0.01}]',
}
ODD = [
    "nan", "inf", "-inf", "0", "-1", "-0.0", "1e308", "-1e308", "5e-324", "1e-300", "1e9", "1e-9",
    "1e15", "true", "false", '""', "[]", "{}", "[[]]", "a", "ü", "\u202e", '"\\n"', "'", "2mm",
    "1,5", ".5", "5.", "9" * 400, "9" * 5000, "0x" + "f" * 5000, "[1,2,3]", "[[0,0],[1,1]]",
    "[nan]",
    "[" * 50, "[" + "0.1," * 5000 + "]", "[" + "[0,0]," * 5000 + "]", "x" * 5000, "1979-05-27",
    "{a=1}", "[{}]", "none", "time", "..", "-", " ", "=", "\x00", "\udcff", "1_0", "+5", "--5",
]  # fmt: skip
RECORDS = [
    "t,x\n0,0\n1,0.01\n2,0\n", "0;0\n1;10\n2;0\n", "0 0\n0.5 1e300\n", "0\t0\n1e-320\t1\n",
    "t,x\n22,0\n23,0.1\n", "0,0\n1e300,1\n", "time,mm\n0,0\n1,5\n", "", "\n\n", "x", "0,nan\n1,0\n",
    "0,0\n" + "".join(f"{i / 100},{i % 7 / 1000}\n" for i in range(1, 400)), "-5,0\n9,0.01\n",
    "0,0\n1,1e-320\n2,0\n", "0,1e308\n1,-1e308\n2,1e308\n", "0,0\n1e-300,1e300\n", "\x00",
    '"0,0\n1,1',
]  # fmt: skip


@cache
def keys():
    """Every key, with the bounds and words that its metadata names."""
    single = [(f"{t}.{toml_name(i)}", i.metadata) for t, k in TABLES.items() for i in fields(k)]
    listed = [(f"{t}.0.{toml_name(i)}", i.metadata) for t, k in LISTS.items() for i in fields(k)]
    return [*single, *listed, *((name, {}) for name in (*TABLES, *LISTS, "name", "title", "x.y"))]


def draw(seed, folder):
    """The words of command line number `seed`; what they name lies in `folder`."""
    rng = random.Random(seed)
    name = rng.choice(cases.names())
    words = [name, "--check"]
    if rng.random() < 0.3:
        record = Path(folder) / "record.csv"
        record.write_text(rng.choice(RECORDS), encoding="utf-8")
        words += ["--set", "wavemaker.type=file", "--set", f"wavemaker.file={record}"]
    for table in rng.sample(list(LISTED), rng.choice((0, 0, 1, 2))):
        words += ["--set", f"{table}={LISTED[table]}"]
    for _ in range(rng.choice((1, 1, 2, 3))):
        key, metadata = rng.choice(keys())
        words += ["--set", f"{key}={_value(rng, key, metadata, cases.load_case(name))}"]
    if rng.random() < 0.05:
        words += rng.choice((["--ranks", "7"], ["--ranks", "1000000000"], ["--until", "nan"]))
    return words


def _value(rng, key, metadata, case):
    present = _present(case, key)
    choice = rng.random()
    if choice < 0.55 and isinstance(present, float | int) and not isinstance(present, bool):
        return repr((present or 1.0) * 10.0 ** rng.randint(-9, 9) * rng.choice((1, 1, 1, -1, 1.7)))
    if choice < 0.65 and metadata.get("choices"):
        return rng.choice(metadata["choices"])
    if choice < 0.8:
        edges = [metadata[edge] for edge in ("low", "high", "above") if edge in metadata]
        return repr(rng.choice([*edges, rng.uniform(-10, 10), rng.randint(-10, 1000)]))
    return rng.choice(ODD)


def _present(case, key):
    *path, last = key.split(".")
    if len(path) != 1 or path[0] not in TABLES:
        return None
    return getattr(getattr(case, path[0]), last, None)


def faults(words, folder):
    """What is wrong with how the command line takes the words, a list of lines."""
    before, found = sorted(os.listdir(folder)), []
    out, err, began = io.StringIO(), io.StringIO(), time.process_time()
    try:
        with chdir(folder), redirect_stdout(out), redirect_stderr(err):
            status = tank.main(words)
    except BaseException:
        return [traceback.format_exc()]
    spent = time.process_time() - began
    if status not in (0, 2):
        found.append(f"status {status}")
    if status == 2 and (len(err.getvalue().splitlines()) != 1 or out.getvalue()):
        found.append(f"not one line: {err.getvalue()!r}")
    if status == 2 and not any(word in err.getvalue() for word in ("must", "allowed", "(see")):
        found.append(f"not what is allowed: {err.getvalue()!r}")
    if status == 2 and len(err.getvalue()) > 1500:
        found.append(f"a message of {len(err.getvalue())} characters")
    if status == 0 and ("nan" in out.getvalue().split() or "inf" in out.getvalue().split()):
        found.append("nan or inf told")
    if spent > MOST_SECONDS:
        found.append(f"{spent:.1f} s")
    if sorted(os.listdir(folder)) != before:
        found.append("files written")
    return found


def peak_bytes():
    """Largest memory of this process so far."""
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def main(first, last):
    """Take draws and tell the faults; returns how many had one."""
    start, bad = peak_bytes(), 0
    for seed in range(first, last):
        with tempfile.TemporaryDirectory() as folder:
            words, before = draw(seed, folder), peak_bytes()
            found = faults(words, folder)
            if peak_bytes() - before > 0.3 * MOST_BYTES:
                found.append(f"{(peak_bytes() - before) / 1e6:.0f} MB")
            if found:
                bad += 1
                print(seed, [word[:120] for word in words], *found, sep="\n  ", flush=True)
    grown = (peak_bytes() - start) / 1e6
    print(f"{last - first} draws, {bad} with faults, memory grew by {grown:.0f} MB")
    return bad


if __name__ == "__main__":
    bounds = [int(word) for word in sys.argv[1:]] or [200]
    sys.exit(main(*([0, *bounds] if len(bounds) == 1 else bounds)) > 0)
