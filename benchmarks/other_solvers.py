"""The shells of the benchmark's aircraft by CalculiX and by OpenSees, where installed.

CalculiX: *DYNAMIC, DIRECT of the shells alone (S4), without the stringers, which is
easier than our model; two increments. OpenSees: ShellMITC4 and elastic beams, Newmark,
`algorithm Linear -factorOnce`, system SparseSYM, in an interpreter of its own (option
--opensees PYTHON), since its wheels need not agree with this project's.
"""

import json
import os
import resource
import shutil
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np

from benchmarks.stiffened_aircraft import Mesh, Size, mesh_of

Figures = dict[str, float]
STEP, STEPS = 1e-3, 5


def calculix_input(mesh: Mesh, increments: int) -> str:
    """Input deck of the shells with a force on one grid."""
    quads = np.concatenate(mesh.quads) + 1
    used = np.unique(quads)
    lines = ["*NODE"]
    lines += [f"{k},{x:.9g},{y:.9g},{z:.9g}" for k, (x, y, z) in
              zip(used, mesh.xyz[used - 1])]  # fmt: skip
    lines.append("*ELEMENT,TYPE=S4,ELSET=SKIN")
    lines += [f"{k},{a},{b},{c},{d}" for k, (a, b, c, d) in enumerate(quads, start=1)]
    density = 2700.0 + 12.0 / 0.003  # skin and what it carries
    lines += [
        "*MATERIAL,NAME=ALU", "*ELASTIC", "7e10,.33", "*DENSITY", f"{density:g}",
        "*SHELL SECTION,ELSET=SKIN,MATERIAL=ALU", ".003",
        f"*STEP,INC={increments}", "*DYNAMIC,DIRECT", f"{STEP:g},{increments * STEP:g}",
        "*CLOAD", f"{used[len(used) // 4]},3,1e4",
        "*NODE FILE,FREQUENCY=1000", "U", "*END STEP",
    ]  # fmt: skip
    return "\n".join(lines) + "\n"


def calculix(size: Size, increments: int = 2) -> Figures | None:
    """Processor seconds per increment of ccx; None where it is not installed."""
    program = shutil.which("ccx")
    if program is None:
        return None
    with TemporaryDirectory() as folder:
        (Path(folder) / "model.inp").write_text(
            calculix_input(mesh_of(size), increments)
        )
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        start = perf_counter()
        environment = {**os.environ, "OMP_NUM_THREADS": "1"}
        answer = subprocess.run(
            [program, "-i", "model"],
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
        )
        wall = perf_counter() - start
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        status = Path(folder) / "model.sta"
        done = len(status.read_text().splitlines()) - 2 if status.exists() else 0
    if done < 1:
        raise RuntimeError(f"ccx made no increment: {answer.stdout[-500:]}")
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {
        "increments": done,
        "s per increment (processor)": used / done,
        "s per increment": wall / done,
        "peak memory, GB": after.ru_maxrss * 1024 / 1e9,
    }


_SCRIPT = """
import json, sys, time
import numpy as np
import openseespy.opensees as ops
d = np.load(sys.argv[1])
ops.wipe(); ops.model("basic", "-ndm", 3, "-ndf", 6)
for k, x in enumerate(d["xyz"].tolist(), start=1):
    ops.node(k, *x)
ops.section("ElasticMembranePlateSection", 1, 7e10, .33, .003, 2700. + 12. / .003)
number = 0
for nodes in (d["quads"] + 1).tolist():
    number += 1
    ops.element("ShellMITC4", number, *nodes, 1)
for k, direction in enumerate(d["directions"].tolist(), start=1):
    ops.geomTransf("Linear", k, *direction)
for (a, b), k in zip((d["bars"] + 1).tolist(), d["kind"].tolist()):
    number += 1
    ops.element("elasticBeamColumn", number, a, b, 3e-4, 7e10, 2.6e10, 1e-8, 9e-8, 4e-8,
                k + 1, "-mass", 3e-4 * 2700.)
ops.timeSeries("Constant", 1); ops.pattern("Plain", 1, 1)
ops.load(len(d["xyz"]) // 4, 0., 0., 1e4, 0., 0., 0.)
ops.constraints("Plain"); ops.numberer("RCM"); ops.system("SparseSYM")
ops.algorithm("Linear", "-factorOnce"); ops.integrator("Newmark", .5, .25)
ops.analysis("Transient")
t = time.process_time(), time.perf_counter()
assert ops.analyze(1, float(sys.argv[2])) == 0
first = time.process_time() - t[0], time.perf_counter() - t[1]
best = 1e30, 1e30
for _ in range(int(sys.argv[3])):
    t = time.process_time(), time.perf_counter()
    assert ops.analyze(1, float(sys.argv[2])) == 0
    best = min(best[0], time.process_time() - t[0]), min(best[1],
               time.perf_counter() - t[1])
print(json.dumps({"first step with factorisation, s (processor)": first[0],
    "first step with factorisation, s": first[1], "s per step (processor)": best[0],
    "s per step": best[1]}))
"""


def opensees(size: Size, python: str | None) -> Figures | None:
    """Seconds per step of OpenSees in another interpreter; None without one."""
    if not python:
        return None
    mesh = mesh_of(size)
    bars = [pairs for pairs, _ in mesh.bars]
    with TemporaryDirectory() as folder:
        data = Path(folder) / "model.npz"
        np.savez(
            data,
            xyz=mesh.xyz,
            quads=np.concatenate(mesh.quads),
            bars=np.concatenate(bars),
            kind=np.repeat(np.arange(len(bars)), [len(b) for b in bars]),
            directions=[direction for _, direction in mesh.bars],
        )
        script = Path(folder) / "run.py"
        script.write_text(_SCRIPT)
        answer = subprocess.run(
            [python, str(script), str(data), str(STEP), str(STEPS)],
            capture_output=True,
            text=True,
        )
    if answer.returncode:
        raise RuntimeError(
            f"{python} could not run OpenSees (it needs openseespy and numpy): "
            f"{answer.stderr.strip()[-500:]}"
        )
    return json.loads(answer.stdout.splitlines()[-1])
