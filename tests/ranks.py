"""Programs of the tests on several ranks: `start` runs this file under mpiexec."""

import hashlib
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

from mpslab.parallel import launch

TIMEOUT = 280.0  # seconds; a deadlock ends here, and a busy machine is slow
ROOT = Path(__file__).parent.parent


def environment():
    """That of this process, with the package under test first on the path."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "tests")])}


def start(program, ranks, *arguments):
    """Output of rank 0 of a function below on so many ranks, read as JSON."""
    line = launch.command(ranks, __file__, program, *(json.dumps(a) for a in arguments))
    done = subprocess.run(
        line, capture_output=True, text=True, timeout=TIMEOUT, env=environment(), cwd=ROOT
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


def alone(program, *arguments):
    """Output of a function below on one rank, in this process: as `start` would give it.

    Of the kernels of this process, which those of `start` need not be: in a checked build the
    last bits of a sum may differ.
    """
    return json.loads(json.dumps(globals()[program](*arguments)))


def each(calls):
    """Outputs of several functions below, called one after the other: one start for all."""
    return [globals()[program](*arguments) for program, *arguments in calls]


def digest(particles):
    """The bytes of all arrays, each as a short text."""
    return {
        name: hashlib.sha256(array.tobytes()).hexdigest()[:12]
        for name, array in vars(particles).items()
    }


def steps(changes, count, dt):
    """Some steps of a small tank: bytes of the particles and iterations of the solver."""
    from tanks import flow_of, make_case

    from mpslab.run.step import advance

    flow = flow_of(make_case(changes))
    iterations = [advance(flow, dt).iterations for _ in range(count)]
    everything = flow.domain.gather(flow.particles)
    if everything is not None:
        return {"iterations": iterations, **digest(everything)}


def absorbed(changes, until):
    """A run with a piston that absorbs: bytes of the particles, and what the piston went by."""
    from tanks import make_case

    from mpslab import Simulation

    run = Simulation(make_case(changes)).run(until=until)
    everything = run.domain.gather(run.particles)
    if everything is not None:
        return {"piston": run.table("piston").tolist(), **digest(everything)}


def nested(changes, count, dt, work=0.0):
    """As `steps`, with `deflated`, and no factor that is worth its cost but that of the slabs, or
    such as take little work.
    """
    from mpslab.pressure import deflation

    usual, deflation.WORK = deflation.WORK, work
    try:
        return steps({**changes, "scheme.solver": "deflated"}, count, dt)
    finally:
        deflation.WORK = usual


def water(changes):
    """Number of water particles of each rank."""
    from tanks import flow_of, make_case

    flow = flow_of(make_case(changes))
    return flow.domain.from_all(int(flow.particles.fluid.sum()))


def sums():
    """Sums and extremes over all ranks of a tank whose particles are numbered."""
    from tanks import flow_of, make_case

    flow = flow_of(make_case({"scheme.solver": "scg"}))
    gid, domain = flow.particles.gid, flow.domain
    return {
        "total": domain.total(gid * 0.1),
        "sizes": domain.from_all(len(gid)),
        "cuts": domain.cuts.tolist(),
    }


def laid_out():
    """Particles that each rank lays out, and those that it owns, at the start of a run."""
    from tanks import make_case

    from mpslab import Simulation
    from mpslab.parallel.domain import world
    from mpslab.solids import layout

    build, made = layout.build_particles, []

    def count(*arguments):
        particles = build(*arguments)
        made.append(len(particles))
        return particles

    layout.build_particles = count
    run = Simulation(make_case({"tank.length": 0.16}))
    return world().allgather((sum(made), len(run.particles)))


def looks():
    """How often each rank looks for a message before it takes a nap."""
    from mpslab.parallel.communicator import Patience
    from mpslab.parallel.domain import world

    return world().allgather(Patience.looks)


def crossing(places):
    """Ranks on which particles stand that moved across several slabs at once, and their ghosts."""
    import numpy as np
    from tanks import flow_of, make_case

    flow = flow_of(make_case({"scheme.solver": "scg"}))
    domain, before = flow.domain, flow.particles
    for number, x in places:
        before.position[before.gid == number, 0] = x
    after, (companion,) = domain.share_out(before, before.gid * 2.0)
    assert np.all(np.diff(domain.cells.order(after.position, after.gid)) == 1)
    assert np.array_equal(companion, after.gid * 2.0)
    after.pressure[:] = -1.0
    after.pressure[domain.owned] = after.gid[domain.owned]
    domain.refresh(after.pressure)
    assert np.array_equal(after.pressure, after.gid)
    mine = [n for n, _ in places if n in after.gid[domain.owned]]
    slabs = sorted(set(domain.slab.tolist()))
    everyone = domain.from_all((mine, slabs, domain.begin, domain.end))
    total = domain.from_all(len(after.gid[domain.owned]))
    return {"ranks": everyone, "total": sum(total)}


def series(changes):
    """What each rank has of the series of a run."""
    from tanks import make_case

    from mpslab.simulation import Simulation

    run = Simulation(make_case(changes)).run()
    names = ("steps", "gauges", "probes", *(["forces"] if run.case.force else []))
    mine = {name: run.table(name).tolist() for name in names}
    return run.domain.from_all(mine)


def shore_series(changes):
    """As `series`, of overtopping and run-up."""
    from tanks import make_case

    from mpslab.simulation import Simulation

    run = Simulation(make_case(changes)).run()
    return run.domain.from_all({n: run.table(n).tolist() for n in ("overtopping", "runup")})


def spoiled(how, folder):
    """A run that goes wrong after its checkpoint of 9 ms: a rank raises, or its water is lost."""
    import numpy as np

    from mpslab import simulation, tank
    from mpslab.parallel.domain import world

    advance, comm = simulation.advance, world()

    def spoil(flow, dt):
        report = advance(flow, dt)
        if comm.rank == 1 and flow.time > SPOILED:
            if how == "nan":
                flow.particles.velocity[0] = np.nan
            else:
                raise {"index": IndexError, "value": ValueError}[how]("a fault in the code")
        return report

    simulation.advance = spoil
    sys.exit(tank.main([*SMALL, "--out", folder]))


def refused(folder):
    """A start at which one rank alone finds fault with the input."""
    from mpslab import tank
    from mpslab.parallel.domain import world
    from mpslab.run import start

    make = start.make_flow

    def find_fault(*arguments):
        if world().rank == 1:
            raise ValueError("only here")
        return make(*arguments)

    start.make_flow = find_fault
    sys.exit(tank.main([*SMALL, "--out", folder]))


def full(what, folder):
    """A run for whose files there is no room any more, from a frame or a checkpoint on."""
    import resource

    from mpslab import tank
    from mpslab.output import checkpoint, vtkhdf

    owner = vtkhdf.ParticleSeries if what == "append" else checkpoint
    write = getattr(owner, what)

    def fill(*arguments):
        time = arguments[1] if what == "append" else arguments[2]["time"]
        if time > SPOILED:
            resource.setrlimit(resource.RLIMIT_FSIZE, (ROOM, ROOM))
        return write(*arguments)

    setattr(owner, what, fill)
    sys.exit(tank.main([*SMALL, "--out", folder]))


def struck(how, folder):
    """A run that Ctrl-C, or the kill of rank 1, hits amid its second cut."""
    import time

    from mpslab import tank
    from mpslab.parallel import rebalance
    from mpslab.parallel.domain import world

    load, calls, came = rebalance.load, [], []

    def strike(*arguments):
        calls.append(1)
        if len(calls) == 3:  # the first shares out the particles at the start
            press_ctrl_c() if how == "ctrl-c" else kill()
        return load(*arguments)

    def press_ctrl_c():
        handler = signal.getsignal(signal.SIGINT)
        signal.signal(signal.SIGINT, lambda *what: (handler(*what), came.append(1)))
        world().Barrier()
        if world().rank == 0:
            os.kill(launcher(), signal.SIGINT)
        while not came:
            time.sleep(0.01)

    def kill():
        if world().rank == 1:
            os.kill(os.getpid(), signal.SIGKILL)

    rebalance.load = strike
    sys.exit(tank.main([*SMALL, "--until", "0.015", "--out", folder]))


def launcher():
    """Process of mpiexec: the parent of the proxy that is the parent of this one."""
    proxy = Path(f"/proc/{os.getppid()}/stat").read_text()
    return int(proxy.rpartition(")")[2].split()[1])


SMALL = ["plunging_breaker", "--set", "tank.width=0", "--set", "scheme.solver=piccg",
         "--set", "parallel.rebalance_every=5", "--set", "output.checkpoint=0.001",
         "--set", "output.interval=0.002", "--set", "scheme.settling=20",
         "--no-pictures"]  # fmt: skip
SPOILED = 9e-3  # seconds of physical time after which a run goes wrong
ROOM = 4096  # bytes that a file may have on a disk that is full


def tank(*arguments):
    """The command line as a process of its own, not waited for."""
    line = [sys.executable, "-m", "mpslab.tank", *arguments]
    return subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            env=environment())  # fmt: skip


if __name__ == "__main__":
    result = globals()[sys.argv[1]](*(json.loads(a) for a in sys.argv[2:]))
    from mpslab.parallel.domain import world

    if world().rank == 0:
        print(json.dumps(result))
