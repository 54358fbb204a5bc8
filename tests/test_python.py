"""What users add from outside of the package: instruments, models, and actions."""

import json
import sys
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
from tanks import make_case

import mpslab
from mpslab.core import plugins
from mpslab.core.keys import CaseError
from mpslab.models.gradients import corrected

QUICK = {"time.end": 0.006, "output.checkpoint": 0.002}
MODELS = {
    "gradients": "corrected", "sources": "adjoint", "laplacians": "standard", "solvers": "scg",
    "stabilisers": "ds", "wavemakers": "linear",
}  # fmt: skip


class Highest(mpslab.Instrument):
    """Height of the highest water, and the largest so far."""

    name = "highest"
    columns = ("time [s]", "z [m]", "so far [m]")
    interval = 0.001

    def __init__(self):
        self.most = 0.0

    def read(self, flow):
        z = flow.particles.position[flow.particles.fluid, 2]
        top = max(flow.domain.from_all(float(z.max(initial=0.0))))
        self.most = max(self.most, top)
        return [(flow.time, top, self.most)]

    def state(self):
        return {"most": self.most}

    def restore(self, state):
        self.most = state["most"]


@pytest.fixture
def added(monkeypatch):
    """Models that are added are forgotten after the test."""
    monkeypatch.setattr(plugins, "_added", {})


def one_line(caught, *parts):
    text = str(caught.value)
    assert "\n" not in text and all(part in text for part in parts), text


def test_own_instrument_has_a_table_and_goes_on_to_the_byte(tmp_path):
    case = make_case({**QUICK, "particles.jitter": 0.1})
    whole = mpslab.Simulation(case, tmp_path / "whole", instruments=[Highest()]).run()
    mpslab.Simulation(case, tmp_path / "parts", instruments=[Highest()]).run(until=0.0033)
    mpslab.Simulation.resume(tmp_path / "parts", instruments=[Highest()]).run()
    one, other = ((tmp_path / name / "highest.csv").read_bytes() for name in ("whole", "parts"))
    assert one == other and one.startswith(b"time [s],z [m],so far [m]\n0.0,")
    read = mpslab.open_run(tmp_path / "whole").table("highest")
    assert read.dtype.names == ("time", "z", "so far") and len(read) == 7
    assert read.tolist() == whole.table("highest").tolist()


class Mine:
    """A gradient that a module holds by a name."""

    CONSERVES_MOMENTUM = corrected.CONSERVES_MOMENTUM
    gradient = staticmethod(corrected.gradient)


highest = Highest()


def test_parts_that_a_module_holds_by_a_name_are_found_again(tmp_path, added):
    mpslab.add_model("gradients", "mine", Mine)
    case = make_case({**QUICK, "scheme.gradient": "mine"})
    whole = mpslab.Simulation(case, instruments=[Highest()]).run()
    mpslab.Simulation(case, tmp_path / "run", instruments=[highest]).run(until=0.003)
    plugins._added.clear()
    run = mpslab.Simulation.resume(tmp_path / "run").run()
    assert run.particles.position.tobytes() == whole.particles.position.tobytes()
    assert run.table("highest")[-1] == whole.table("highest")[-1]
    assert plugins.load("gradients", "mine") is Mine


def test_parts_in_the_checkpoint_of_an_earlier_mpslab_are_refused(tmp_path):
    def keep(instruments):
        with h5py.File(tmp_path / "run/checkpoint.h5", "a") as file:
            state = file["state"]
            del state["own"]
            state["own"] = '{"forcings": [], "solids": []}'
            state["outside"] = json.dumps({"models": [], "instruments": instruments})

    mpslab.Simulation(make_case(QUICK), tmp_path / "run").run(until=0.002)
    keep([])
    mpslab.Simulation.resume(tmp_path / "run").run(until=0.003)
    keep(["highest"])
    with pytest.raises(ValueError) as caught:
        mpslab.Simulation.resume(tmp_path / "run")
    one_line(caught, "of an earlier mpslab", "run the case anew")


@pytest.mark.parametrize("given", [[], ["another"], ["highest", "another"]])
def test_resume_without_the_instruments_of_a_run_is_refused(tmp_path, given):
    case = make_case({**QUICK, "time.end": 0.002})
    mpslab.Simulation(case, tmp_path / "run", instruments=[Highest()]).run()
    before = {path: path.read_bytes() for path in (tmp_path / "run").iterdir() if path.is_file()}
    instruments = [Highest() for _ in given]
    for one, name in zip(instruments, given, strict=True):
        one.name = name
    with pytest.raises(CaseError) as caught:
        mpslab.Simulation.resume(tmp_path / "run", instruments=instruments)
    one_line(caught, "instruments = ", "must be those that the run began with, ['highest']")
    for path, content in before.items():
        assert path.name == "run.lock" or path.read_bytes() == content


@pytest.mark.parametrize("changes, said", [
    ({"name": "steps"}, "instruments[0].name = 'steps': must be another name than"),
    ({"name": "phases"}, "instruments[0].name = 'phases': must be another name than"),
    ({"name": "a/b"}, "instruments[0].name"),
    ({"name": ""}, "instruments[0].name"),
    ({"columns": ("z [m]", "time [s]")}, "instruments[0].columns"),
    ({"columns": ("time [s]",)}, "instruments[0].columns"),
    ({"columns": ("time [s]", "z [m]", "z [mm]")}, "headings that differ in more than their"),
    ({"columns": None}, "instruments[0].columns"),
    ({"name": "a.b"}, "instruments[0].name"),
    ({"interval": -1.0}, "instruments[0].interval = -1.0: must be a number of seconds >= 0"),
    ({"interval": None}, "instruments[0].interval = None: must be a number of seconds >= 0"),
])  # fmt: skip
def test_an_instrument_that_has_no_table_is_refused_and_nothing_written(tmp_path, changes, said):
    one = Highest()
    vars(one).update(changes)
    with pytest.raises(ValueError) as caught:
        mpslab.Simulation(make_case(), tmp_path / "run", instruments=[one])
    one_line(caught, said)
    assert not (tmp_path / "run").exists()


def test_what_is_no_instrument_and_the_same_twice_are_refused():
    with pytest.raises(ValueError, match=r"instruments\[0\].*must be an mpslab.Instrument"):
        mpslab.Simulation(make_case(), instruments=[object()])
    with pytest.raises(ValueError, match=r"instruments\[1\].name = 'highest': must be another"):
        mpslab.Simulation(make_case(), instruments=[Highest(), Highest()])


def test_an_action_is_called_when_its_time_has_come():
    times, steps = [], []
    run = mpslab.Simulation(make_case(QUICK))
    assert run.every(0.002, lambda run: times.append(run.time)) is run
    run.every(0.0, lambda run: steps.append(run.step)).run()
    assert steps == list(range(1, run.step + 1))
    assert [int(time / 0.002) for time in times] == [1, 2, 3]


@pytest.mark.parametrize("interval", [-1.0, np.nan, np.inf, "0.1", None, True])
def test_an_interval_that_is_none_is_refused(interval):
    with pytest.raises(ValueError, match=r"interval = .*: must be a number of seconds >= 0"):
        mpslab.Simulation(make_case(QUICK)).every(interval, print)


def test_an_action_that_fails_ends_the_run_with_the_reason(tmp_path):
    def fail(run):
        raise ArithmeticError("no luck")

    run = mpslab.Simulation(make_case(QUICK), tmp_path / "run").every(0.002, fail)
    with pytest.raises(ArithmeticError):
        run.run()
    found = mpslab.open_run(tmp_path / "run")
    assert (found.outcome, found.reason) == ("failed", "ArithmeticError no luck")
    assert 0.002 <= run.time < 0.003


@pytest.mark.parametrize("family", MODELS)
def test_own_model_of_each_family_runs_as_the_one_that_it_is_made_of(family, added):
    key, model = plugins.KEYS[family], plugins.load(family, MODELS[family])
    mpslab.add_model(family, "mine", SimpleNamespace(**vars(model)))
    common = {"wavemaker.type": "linear", "wavemaker.height": 0.004, "wavemaker.period": 0.4}
    runs = []
    for name in (MODELS[family], "mine"):
        value = ["collision", name] if family == "stabilisers" else name
        run = mpslab.Simulation(make_case({**common, key: value}))
        for _ in range(3):
            run.advance()
        runs.append(run.particles.position.tobytes())
    assert runs[0] == runs[1]


def test_a_run_with_an_own_model_goes_on_only_where_it_was_added_again(tmp_path, added):
    mpslab.add_model("gradients", "mine", corrected)
    case = make_case({**QUICK, "scheme.gradient": "mine"})
    mpslab.Simulation(case, tmp_path / "whole").run()
    mpslab.Simulation(case, tmp_path / "parts").run(until=0.003)
    plugins._added.clear()
    with pytest.raises(CaseError) as caught:
        mpslab.Simulation.resume(tmp_path / "parts")
    one_line(caught, "models: the run began with 'gradients.mine'", "mpslab.add_model('gradients'")
    mpslab.add_model("gradients", "mine", corrected)
    mpslab.Simulation.resume(tmp_path / "parts").run()
    whole, parts = (mpslab.open_run(tmp_path / name).steps for name in ("whole", "parts"))
    assert whole["kinetic_energy"].tolist() == parts["kinetic_energy"].tolist()


def test_a_module_is_found_by_its_name_with_a_dot_also_when_a_run_goes_on(tmp_path, monkeypatch):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/plain.py").write_text("from mpslab.models.gradients.symmetric import *\n")
    (tmp_path / "mine/empty.py").write_text("")
    changes = {**QUICK, "scheme.gradient": "mine.plain"}
    with pytest.raises(CaseError) as caught:
        make_case(changes)
    one_line(caught, "scheme.gradient = 'mine.plain': cannot be imported")
    monkeypatch.syspath_prepend(str(tmp_path))
    mpslab.Simulation(make_case(changes), tmp_path / "run").run(until=0.003)
    mpslab.Simulation.resume(tmp_path / "run").run()
    with pytest.raises(CaseError) as caught:
        make_case({"scheme.gradient": "mine.empty"})
    one_line(caught, "scheme.gradient = 'mine.empty': has no gradient and no CONSERVES_MOMENTUM")
    for name in ("mine", "mine.plain", "mine.empty"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("family, name, said", [
    ("gradient", "mine", "family = 'gradient': must be one of gradients"),
    ("gradients", "cmps", "name = 'cmps': must be another name than"),
    ("gradients", "a.b", "name = 'a.b': must be a word"),
    (
        "sources", "mine",
        "scheme.source = 'mine': has no source; must have what mpslab.models.sources",
    ),
])  # fmt: skip
def test_a_model_that_cannot_be_added_is_refused(family, name, said, added):
    with pytest.raises(CaseError) as caught:
        mpslab.add_model(family, name, corrected)
    one_line(caught, said)
