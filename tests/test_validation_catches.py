"""A model that is broken on purpose makes the validation miss: still water, run here."""

from dataclasses import replace

import pytest
from markupsafe import escape

from mpslab import tank
from mpslab.core.particles import FACE, ParticleSet
from mpslab.core.plugins import load
from mpslab.solids import layout
from validation import report, result, suite
from validation.work import FAILED, Outcome, Task, Work

SHORT = {"box": 0.6, "tank-4mm": 0.06}  # seconds; the criteria that are looked at are of the box


class Here(Work):
    """Runs in this process, where a model can be broken."""

    def _simulate(self, task, arguments):
        status = tank.main([*arguments, "--no-pictures"])
        return Outcome(task, "failed" if status == FAILED else "finished", "see above")


def still_water(folder):
    """The case of still water with the runs of `standard`, cut short: its result and report."""
    case = suite.load("still_water")
    runs = [run for run in case.runs_of("quick") if run.name in SHORT]
    plans = [replace(r, changes={**r.changes, "time.end": SHORT[r.name]}) for r in runs]
    tasks = [Task(case.name, plan, folder / plan.name) for plan in plans]
    found, pictures = result.make(case, "quick", [Here(1).run(task) for task in tasks], {})
    result.write(folder, found, pictures)
    return {metric["id"]: metric for metric in found["metrics"]}, report.render([found], folder)


def missed(metrics):
    return {name for name, metric in metrics.items() if metric["verdict"] == "missed"}


def scale_gradient(monkeypatch):
    model = load("gradients", "corrected")
    gradient = model.gradient

    def scaled(*arguments):
        gradient(*arguments)
        arguments[-1][:] *= 1.05

    monkeypatch.setattr(model, "gradient", scaled)


def flip_source(monkeypatch):
    model = load("sources", "adjoint")
    source = model.source

    def flipped(*arguments):
        return -source(*arguments)

    monkeypatch.setattr(model, "source", flipped)


def leave_out_walls(monkeypatch):
    build = layout.build_particles

    def without(case, *more):
        particles = build(case, *more)
        keep = particles.role != FACE
        return ParticleSet(**{name: array[keep] for name, array in vars(particles).items()})

    monkeypatch.setattr(layout, "build_particles", without)


def test_still_water_as_it_is_has_its_pressure(tmp_path):
    metrics, _ = still_water(tmp_path)
    assert not missed(metrics) & {"pressure", "noise"}


@pytest.mark.parametrize("spoil", [scale_gradient, flip_source, leave_out_walls])
def test_a_broken_model_is_a_miss_and_stands_in_the_report(tmp_path, monkeypatch, spoil):
    spoil(monkeypatch)
    metrics, page = still_water(tmp_path)
    assert "pressure" in missed(metrics)
    assert escape(metrics["pressure"]["title"]) in page.partition("<table")[0]
