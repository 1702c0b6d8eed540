"""The lattice aircraft of `lattice_aircraft`, landed by Exudyn.

    python benchmarks/exudyn_landing.py MODEL.npz STEP

Started by `landing_peers` with an interpreter that has Exudyn, to which nothing of this
project need be known: the model comes as arrays, the result is one line of JSON.
Airframe: reduced floating-frame body (Craig-Bampton). Integrator: generalised-alpha
with modified Newton, which for this case is several times faster than full Newton; the
force laws are symbolic, hence compiled.
"""

import json
import sys
import time
from typing import Any

import numpy as np
import scipy.sparse as sp

try:
    import exudyn as exu
    from exudyn.FEM import (
        FEMinterface,
        HCBstaticModeSelection,
        ObjectFFRFreducedOrderInterface,
    )
    from exudyn.itemInterface import (
        MarkerBodyPosition,
        MarkerNodeCoordinate,
        MarkerSuperElementPosition,
        NodePoint,
        NodePointGround,
        ObjectConnectorCartesianSpringDamper,
        ObjectConnectorCoordinateSpringDamper,
        ObjectConnectorSpringDamper,
        ObjectMassPoint,
        SensorObject,
        SensorSuperElement,
    )
    from exudyn.utilities import CreateSymbolicUserFunction
except ImportError:
    sys.exit("exudyn is not installed; see the extra `peers`")

SPECTRAL_RADIUS = 0.8


def oleo(mbs, t, item, elongation, rate, preload, orifice, force):
    """Tension of the oleo; its parameters come in the slots of a linear spring."""
    p, e = oleo.case, exu.symbolic
    stroke = e.max(-elongation, 0.0)
    inside = -e.max(-stroke, -p["stroke"])  # min(stroke, p["stroke"])
    gas = preload * (1.0 - inside / p["gas_length"]) ** (-p["gas_exponent"])
    bottom = e.max(stroke - p["stroke"], 0.0)
    stops = p["stop_stiffness"] * (bottom - e.max(elongation, 0.0))
    return -(gas - orifice * rate * e.abs(rate) + stops)


def tire(mbs, t, item, height, rate, stiffness, damping, offset):
    """Force of the tire on its wheel, as that of a spring: positive downward."""
    p, e = tire.case, exu.symbolic
    slowed = e.max(rate, -p["largest_damped_rate"])
    return -stiffness * e.max(-height, 0.0) * (1.0 - p["tire_damping"] * slowed)


def reduced_body(model: Any, modes: int):
    """The airframe's component modes; interfaces are rigid (RBE2)."""
    fem = FEMinterface()
    fem.nodes = {"Position": model["xyz"]}
    fem.elements = [{"Name": "cubes", "Hex8": model["cubes"]}]
    for name in ("massMatrix", "stiffnessMatrix"):
        data, indices, indptr = (
            model[f"{name}_{part}"] for part in ("data", "indices", "indptr")
        )
        size = len(indptr) - 1
        setattr(fem, name, sp.csr_matrix((data, indices, indptr), shape=(size, size)))
    fem.ComputeHurtyCraigBamptonModes(
        boundaryNodesList=model["faces"].tolist(),
        nEigenModes=modes,
        useSparseSolver=True,
        computationMode=HCBstaticModeSelection.RBE2,
    )
    return ObjectFFRFreducedOrderInterface(fem)


def land(model: Any, case: dict, step: float) -> dict:
    """One landing; peaks, processor seconds of the simulation alone."""
    oleo.case = tire.case = case
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    height = case["oleo_length"]
    body = reduced_body(model, case["inner_modes"]).AddObjectFFRFreducedOrder(
        mbs,
        positionRef=[0, 0, height],
        initialVelocity=[0, 0, -case["sink_rate"]],
        stiffnessProportionalDamping=case["stiffness_damping"],
    )["oFFRFreducedOrder"]
    ground = mbs.AddNode(NodePointGround())
    ground = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    sensors = {}
    for gear, face in zip(case["gears"], model["faces"].tolist()):
        sensors |= _add_gear(mbs, body, ground, case, gear, face, model["xyz"])
    sensors["tip"] = mbs.AddSensor(
        SensorSuperElement(
            bodyNumber=body,
            meshNodeNumber=int(model["tip"]),
            storeInternal=True,
            outputVariableType=exu.OutputVariableType.Acceleration,
        )
    )
    mbs.Assemble()
    start = time.process_time()
    done = mbs.SolveDynamic(_settings(case["duration"], step))
    seconds = time.process_time() - start
    peaks = {}
    for name, sensor in sensors.items():
        values = np.abs(mbs.GetSensorStoredData(sensor)[:, 1:])
        peaks[name] = float(values[:, 2].max() if name == "tip" else values.max())
    return {
        "version": exu.__version__,
        "solved": bool(done),
        "seconds": seconds,
        "peaks": peaks,
    }


def _add_gear(mbs, body, ground, case, gear, face, xyz) -> dict:
    middle, length = xyz[face].mean(axis=0), case["oleo_length"]
    top = mbs.AddMarker(
        MarkerSuperElementPosition(
            bodyNumber=body, meshNodeNumbers=face, weightingFactors=[0.25] * 4
        )
    )
    node = mbs.AddNode(
        NodePoint(
            referenceCoordinates=[middle[0], middle[1], middle[2]],
            initialVelocities=[0, 0, -case["sink_rate"]],
        )
    )
    wheel = mbs.AddObject(ObjectMassPoint(mass=gear["wheel"], nodeNumber=node))
    wheel = mbs.AddMarker(MarkerBodyPosition(bodyNumber=wheel))
    across, lost = case["side_stiffness"], case["side_damping"]
    mbs.AddObject(
        ObjectConnectorCartesianSpringDamper(
            markerNumbers=[top, wheel],
            stiffness=[across, across, 0],
            damping=[lost, lost, 0],
            offset=[0, 0, -length],
        )
    )
    strut = mbs.AddObject(
        ObjectConnectorSpringDamper(
            markerNumbers=[top, wheel],
            referenceLength=length,
            stiffness=gear["preload"],
            damping=gear["orifice"],
            springForceUserFunction=oleo,
        )
    )
    # The coordinate counts from the reference place, where the tire just touches.
    up = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=2))
    rubber = mbs.AddObject(
        ObjectConnectorCoordinateSpringDamper(
            markerNumbers=[ground, up],
            stiffness=gear["tire"],
            damping=0,
            springForceUserFunction=tire,
        )
    )
    sensors = {}
    for name, item, law in (("oleo", strut, oleo), ("tire", rubber, tire)):
        function = CreateSymbolicUserFunction(mbs, law, "springForceUserFunction", item)
        mbs.SetObjectParameter(item, "springForceUserFunction", function)
        sensors[f"{name}_{gear['name']}"] = mbs.AddSensor(
            SensorObject(
                objectNumber=item,
                storeInternal=True,
                outputVariableType=exu.OutputVariableType.Force,
            )
        )
    return sensors


def _settings(duration: float, step: float):
    settings = exu.SimulationSettings()
    time_integration = settings.timeIntegration
    time_integration.numberOfSteps = round(duration / step)
    time_integration.endTime = duration
    time_integration.verboseMode = 0
    time_integration.newton.useModifiedNewton = True
    time_integration.generalizedAlpha.spectralRadius = SPECTRAL_RADIUS
    time_integration.generalizedAlpha.computeInitialAccelerations = True
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = step
    settings.linearSolver.solverType = exu.LinearSolverType.EXUdense
    return settings


if __name__ == "__main__":
    arrays = np.load(sys.argv[1])
    print(json.dumps(land(arrays, json.loads(str(arrays["case"])), float(sys.argv[2]))))
