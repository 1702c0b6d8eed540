"""Bodies of a landing gear from a model file: SDF, URDF, or Drake's model directives.

Drake's Parser reads the file; the case names the body that the airframe holds, the
joint of the strut and those of the wheels. What comes out are the fields of a
telescopic gear, which from there on is one like any other.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from pydantic import Field, ValidationError

from drake_landing.gears.fields import Data, Vector3
from drake_landing.input_paths import InputFile

Float64 = npt.NDArray[np.float64]

# Products of inertia over the largest moment that are left out.
_SLIGHT = 0.02
# Relative difference of wheels that are the same.
_EQUAL = 1e-6
# Degrees between the strut of the file and that of the case.
_PARALLEL = 0.05

FIELDS = ("axle", "wheel_offsets", "fitting", "piston", "wheel")
"""What the file stands for."""


class ModelFile(Data):
    """The file, and which of its bodies and joints are which.

    Its axes are those of the deck, gear extended. To fitting and piston belongs what
    is welded to them.
    """

    file: InputFile = Field(
        description=".sdf, .urdf or .dmd.yaml, relative to the case file"
    )
    position: Vector3 = Field(description="of the origin of the fitting in B, m")
    fitting: str = Field(description="body that the airframe holds")
    strut: str = Field(description="prismatic joint, positive in compression")
    wheels: tuple[str, ...] = Field(
        min_length=1,
        description="revolute joints of the wheels, axes to starboard, from port to "
        "starboard",
    )


def with_bodies(data: dict[str, Any], context: Any) -> dict[str, Any]:
    """Data of a telescopic gear with those of its model file in place of `bodies`.

    Args:
        data: as written in a case.
        context: of the validation, with the folder of the case.

    Raises:
        ValueError: the file cannot be read, lacks what the case names, or is no
            telescopic gear; fields stand beside it that it has.
    """
    twice = [name for name in FIELDS if name in data]
    if twice:
        raise ValueError(
            f"bodies: found {', '.join(twice)} beside it, expected none: the model "
            "file has them"
        )
    try:
        chosen = ModelFile.model_validate(data["bodies"], context=context)
    except ValidationError as error:
        raise ValueError("; ".join(map(_wrong_field, error.errors()))) from None
    try:
        found = _Model(chosen).data(float(data.get("rake_deg", 0.0)))
    except ValueError as error:
        raise ValueError(f"bodies.{error}") from None
    return {name: value for name, value in data.items() if name != "bodies"} | found


def _wrong_field(error: Any) -> str:
    """A field of `ModelFile` that is wrong, as other fields of a case are named."""
    name = f"bodies.{'.'.join(map(str, error['loc']))}"
    if error["type"] == "missing":
        return f"{name}: missing"
    expected = error["msg"].removeprefix("Value error, ").partition("expected ")
    wanted = expected[2] or error["msg"].removeprefix("Input should be ")
    return f"{name}: found {error['input']!r}, expected {wanted}"


class _Model:
    """The file in a plant, its fitting where the case puts it."""

    def __init__(self, gear: ModelFile) -> None:
        # Drake is loaded late: schema and help do without.
        from pydrake.math import RigidTransform
        from pydrake.multibody.parsing import Parser
        from pydrake.multibody.plant import MultibodyPlant

        self._gear = gear
        self._plant = plant = MultibodyPlant(0.0)
        try:
            Parser(plant).AddModels(str(gear.file))
            plant.Finalize()
        except RuntimeError as error:
            reason = str(error).strip().splitlines()[0]
            raise ValueError(f"file: {_short(gear.file)}: {reason}") from None
        self._context = plant.CreateDefaultContext()
        fitting = self._body(gear.fitting)
        if not fitting.is_floating_base_body():
            raise ValueError(
                f"fitting: {gear.fitting} hangs on another body of {_short(gear.file)}"
                ", expected one that is free"
            )
        at = RigidTransform(np.array(gear.position))
        plant.SetFreeBodyPose(self._context, fitting, at)
        self._fitting = fitting

    def data(self, rake_deg: float) -> dict[str, Any]:
        """`FIELDS` of a gear whose strut is raked by so much, degrees."""
        gear, plant = self._gear, self._plant
        strut = self._joint("strut", gear.strut, "prismatic")
        wheels = [self._joint("wheels", name, "revolute") for name in gear.wheels]
        piston = strut.child_body()
        groups = [
            plant.GetBodiesWeldedTo(body)
            for body in (self._fitting, piston, *(w.child_body() for w in wheels))
        ]
        held = {body.index() for body in groups[0]}
        if strut.parent_body().index() not in held:
            raise ValueError(f"strut: {gear.strut} does not begin on {gear.fitting}")
        carried = {body.index() for body in groups[1]}
        for wheel in wheels:
            if wheel.parent_body().index() not in carried:
                raise ValueError(
                    f"wheels: {wheel.name()} is not on the piston, {piston.name()}"
                )
        self._require_all(groups)
        self._require_rake(strut, rake_deg)
        parts = [self._mass_properties(group) for group in groups]
        return {
            "fitting": _rigid_part("fitting", parts[0]),
            "piston": _rigid_part("piston", parts[1]),
            **self._wheels(wheels, parts[2:]),
        }

    def _body(self, name: str) -> Any:
        if not self._plant.HasBodyNamed(name):
            names = [
                self._plant.get_body(i).name()
                for i in self._plant.GetBodyIndices(self._instance())
            ]
            raise ValueError(
                f"fitting: found no body {name} in {_short(self._gear.file)}, expected "
                f"one of {', '.join(names)}"
            )
        return self._plant.GetBodyByName(name)

    def _instance(self) -> Any:
        from pydrake.multibody.tree import ModelInstanceIndex

        return ModelInstanceIndex(self._plant.num_model_instances() - 1)

    def _joint(self, field: str, name: str, kind: str) -> Any:
        plant = self._plant
        if not plant.HasJointNamed(name):
            joints = [plant.get_joint(i) for i in plant.GetJointIndices()]
            names = [j.name() for j in joints if j.type_name() == kind]
            raise ValueError(
                f"{field}: found no joint {name} in {_short(self._gear.file)}, expected"
                f" one of {', '.join(names) or f'some {kind} joint'}"
            )
        joint = plant.GetJointByName(name)
        if joint.type_name() != kind:
            raise ValueError(
                f"{field}: found {name}, a {joint.type_name()} joint, expected a "
                f"{kind} one"
            )
        return joint

    def _require_rake(self, strut: Any, rake_deg: float) -> None:
        X = strut.frame_on_parent().CalcPoseInWorld(self._context)
        axis = X.rotation().matrix() @ strut.translation_axis()
        found = math.degrees(math.acos(min(np.abs(axis).max(), 1.0)))
        if abs(found - abs(rake_deg)) > _PARALLEL:
            raise ValueError(
                f"strut: {strut.name()} is raked by {found:.4g} degrees, expected "
                f"rake_deg of the gear, {rake_deg:g}"
            )

    def _require_all(self, groups: list[Any]) -> None:
        known = {body.index() for group in groups for body in group}
        others = [
            body.name()
            for i in range(1, self._plant.num_bodies())
            if (body := self._plant.get_body(_index(i))).index() not in known
        ]
        if others:
            raise ValueError(
                f"file: {', '.join(others)} of {_short(self._gear.file)} belong "
                "neither to the fitting nor to the piston nor to a wheel that is named"
            )

    def _mass_properties(self, bodies: Any) -> tuple[float, Float64, Float64]:
        """Mass, center of gravity and (3, 3) central inertia in B."""
        plant = self._plant
        M = plant.CalcSpatialInertia(
            self._context, plant.world_frame(), [body.index() for body in bodies]
        )
        mass, center = M.get_mass(), M.get_com()
        inertia = M.Shift(center).CalcRotationalInertia().CopyToFullMatrix3()
        return mass, center, inertia

    def _wheels(self, joints: list[Any], parts: list[Any]) -> dict[str, Any]:
        axes = [self._axis(joint) for joint in joints]
        axis = axes[0]
        places = np.array([self._place(joint) for joint in joints])
        axle = places.mean(axis=0)
        offsets = (places - axle) @ axis
        aside = places - axle - np.outer(offsets, axis)
        if max(np.abs(a - axis).max() for a in axes) > 1e-6 or (
            np.abs(aside).max() > 1e-6
        ):
            raise ValueError(
                f"wheels: {', '.join(self._gear.wheels)} have no common axle"
            )
        # About the axle, and the mean across it.
        found = np.array([(mass, axis @ J @ axis, np.trace(J)) for mass, _, J in parts])
        if np.abs(found / found[0] - 1.0).max() > _EQUAL:
            raise ValueError(
                f"wheels: {', '.join(self._gear.wheels)} differ in mass or inertia, "
                "expected equal ones"
            )
        mass, about, trace = found[0].tolist()
        return {
            "axle": tuple(axle.tolist()),
            "wheel_offsets": tuple(offsets.tolist()),
            "wheel": {
                "mass": mass,
                "spin_inertia": about,
                "transverse_inertia": 0.5 * (trace - about),
            },
        }

    def _axis(self, joint: Any) -> Float64:
        X = joint.frame_on_parent().CalcPoseInWorld(self._context)
        return X.rotation().matrix() @ joint.revolute_axis()

    def _place(self, joint: Any) -> Float64:
        return joint.frame_on_parent().CalcPoseInWorld(self._context).translation()


def _index(i: int) -> Any:
    from pydrake.multibody.tree import BodyIndex

    return BodyIndex(i)


def _short(file: Path) -> str:
    return Path(file).name


def _rigid_part(name: str, part: tuple[float, Float64, Float64]) -> dict[str, Any]:
    mass, center, inertia = part
    moments = np.diag(inertia)
    products = np.abs(inertia - np.diag(moments)).max()
    if products > _SLIGHT * moments.max():
        raise ValueError(
            f"{name}: found a product of inertia of {products:.4g} kg m² about its "
            f"center of gravity, expected less than {_SLIGHT:.0%} of the largest "
            f"moment, {moments.max():.4g}: parts have the axes of the deck"
        )
    return {
        "mass": mass,
        "cg": tuple(center.tolist()),
        "inertia": tuple(moments.tolist()),
    }
