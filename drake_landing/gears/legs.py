"""How elastic a leg is: validated data, as written in a case file.

A leg is clamped at its root by the fitting and bends below it, fore and aft and to the
side, and twists about the strut axis. What is absent is rigid. Frequencies are those of
the leg alone: root clamped, shock absorber locked, wheels and bogie beam free to turn,
off the ground, one motion at a time. SI units except angles in degrees.
"""

from typing import Annotated, Self

import numpy as np
from pydantic import (
    AfterValidator,
    Field,
    model_validator,
)

from drake_landing.gears.fields import Data, Positive, Table, Vector3
from drake_landing.input_paths import InputPath

_HIGHEST = 200.0  # Hz


def _positive(table: list[tuple[float, float]]) -> list[tuple[float, float]]:
    if table[0][0] < 0.0:
        raise ValueError(f"found a stroke of {table[0][0]:g} m, expected >= 0")
    for _, y in table:
        if not y > 0.0:
            raise ValueError(f"found {y:g}, expected > 0")
    return table


OverStroke = Annotated[Table, AfterValidator(_positive)]
Frequency = Annotated[Positive, Field(le=_HIGHEST)]


class Elastic(Data):
    """A stiffness, or the frequency that it gives; exactly one of the four."""

    stiffness: Positive | None = Field(
        default=None,
        description="at the axle (of a bogie: at the pivot of its beam) at every "
        "stroke, N/m, > 0",
    )
    stiffness_table: OverStroke | None = Field(
        default=None, description="stroke (m, ascending) against stiffness, N/m"
    )
    frequency: Frequency | None = Field(
        default=None,
        description=f"of the extended leg, Hz, > 0 and <= {_HIGHEST:g}; the stiffness "
        "against turning about the root is the same at every stroke",
    )
    frequency_table: OverStroke | None = Field(
        default=None,
        description="stroke (m, ascending) against frequency (Hz), e.g. extended and "
        "at the static stroke",
    )
    damping_ratio: float = Field(
        default=0.03,
        ge=0,
        lt=1,
        description="of critical, at every stroke, >= 0 and < 1; tests of gears show "
        "0.01 to 0.05",
    )

    @model_validator(mode="after")
    def _one_law(self) -> Self:
        names = ("stiffness", "stiffness_table", "frequency", "frequency_table")
        given = [name for name in names if getattr(self, name) is not None]
        if len(given) != 1:
            raise ValueError(
                f"found {' and '.join(given) or 'none'}, expected one of "
                f"{', '.join(names)}"
            )
        return self


class Torsion(Elastic):
    """Compliance of torque links, piston and cylinder about the strut axis."""

    stiffness: Positive | None = Field(
        default=None, description="about the strut axis at every stroke, N m/rad, > 0"
    )
    stiffness_table: OverStroke | None = Field(
        default=None, description="stroke (m, ascending) against stiffness, N m/rad"
    )
    frequency: Frequency | None = Field(
        default=None,
        description=f"of the extended leg, Hz, > 0 and <= {_HIGHEST:g}; the stiffness "
        "is the same at every stroke",
    )
    free_play_deg: float = Field(
        default=0.0,
        ge=0,
        le=5,
        description="half width of the play of the torque links, degrees, 0 to 5",
    )


class LegBeam(Data):
    """Cylinder and piston as beams: a cantilever that guides a beam by two bearings.

    The lower bearing is fixed to the cylinder, the upper one to the piston, so that
    their distance grows with the stroke as the overhang falls.
    """

    cylinder_bending: Positive = Field(
        description="EI of the cylinder, N m², > 0; against bending fore and aft"
    )
    piston_bending: Positive = Field(description="EI of the piston, N m², > 0")
    cylinder_bending_lateral: Positive | None = Field(
        default=None,
        description="EI of the cylinder to the side, with its stays, N m²; default the "
        "same",
    )
    cylinder_length: Positive = Field(
        le=10, description="root, where it is clamped, to lower bearing, m"
    )
    overhang: Positive = Field(
        le=5, description="lower bearing to axle (bogie: pivot), gear extended, m"
    )
    bearing_distance: Positive = Field(
        le=5, description="upper to lower bearing, gear extended, m"
    )
    damping_ratio: float = Field(
        default=0.03, ge=0, lt=1, description="of critical, >= 0 and < 1"
    )

    @model_validator(mode="after")
    def _guided(self) -> Self:
        if self.bearing_distance >= self.cylinder_length:
            raise ValueError(
                f"bearing_distance {self.bearing_distance:g} m, expected less than "
                f"cylinder_length {self.cylinder_length:g} m"
            )
        return self


Row6 = tuple[float, float, float, float, float, float]


class LegMatrix(Data):
    """Stiffness at the axle of a finite-element model of the leg, root clamped.

    E.g. of `drake-landing reduce LEG.bdf` with the axle as interface. It holds at every
    stroke against turning about the root that follows from it.
    """

    stiffness: tuple[Row6, Row6, Row6, Row6, Row6, Row6] = Field(
        description="force and moment (N, N m) on the axle (of a bogie: on the pivot "
        "of its beam) per translation and rotation (m, rad) in B, gear extended; "
        "symmetric and positive definite"
    )
    damping_ratio: float = Field(
        default=0.03, ge=0, lt=1, description="of critical, >= 0 and < 1"
    )

    @model_validator(mode="after")
    def _stable(self) -> Self:
        K = np.array(self.stiffness)
        uneven = np.abs(K - K.T).max() / np.abs(K).max()
        if uneven > 1e-6:
            raise ValueError(
                f"stiffness: found a matrix that is asymmetric by {uneven:.2g} of its "
                "largest term, expected a symmetric one"
            )
        # Terms of N/m and N m/rad: scaled by the diagonal.
        scale = np.sqrt(np.abs(np.diag(K)) + 1e-300)
        least = np.linalg.eigvalsh(0.5 * (K + K.T) / np.outer(scale, scale))[0]
        if not least > 1e-9:
            raise ValueError(
                f"stiffness: found a motion without stiffness (least eigenvalue "
                f"{least:.2g} of the scaled matrix), expected a leg whose root is "
                "clamped and whose shock absorber is locked"
            )
        return self


class ReducedLeg(Data):
    """A finite-element model of the leg, reduced to its root and its axle; SI.

    E.g. of `drake-landing reduce LEG.bdf`. It gives the stiffness at the axle; masses
    stay those of the gear, and what the matrices have is compared.
    """

    files: tuple[InputPath, ...] = Field(
        min_length=1,
        description="DMIG (punch), OUTPUT4 or HDF5 of MSC Nastran, relative to the "
        "case file",
    )
    grids: InputPath = Field(
        description="CSV table of the grids in the order of the matrices: id, x, y, z "
        "[, components]",
    )
    root: int = Field(gt=0, description="grid that the fitting clamps")
    axle: int = Field(
        gt=0, description="grid at the axle, of a bogie at the pivot of its beam"
    )
    stiffness: str = Field(default="KRED", description="name of K")
    mass: str = Field(default="MRED", description="name of M")
    damping_ratio: float = Field(
        default=0.03, ge=0, lt=1, description="of critical, >= 0 and < 1"
    )


class Leg(Data):
    """Flexibility of a leg between fitting and axle."""

    root: Vector3 | None = Field(
        default=None,
        description="point in B about which the leg turns as it bends, m; default the "
        "attachment node, of a beam where its deflection and slope at the axle have it",
    )
    fore_aft: Elastic | None = Field(
        default=None, description="bending fore and aft; default rigid"
    )
    lateral: Elastic | None = Field(
        default=None, description="bending to the side; default rigid"
    )
    beam: LegBeam | None = Field(
        default=None, description="both bendings from the beams of the leg"
    )
    matrix: LegMatrix | None = Field(
        default=None, description="bendings and torsion from a stiffness at the axle"
    )
    reduced: ReducedLeg | None = Field(
        default=None, description="such a matrix from the files of a reduced model"
    )
    torsion: Torsion | None = Field(
        default=None, description="about the strut axis; default rigid"
    )

    @model_validator(mode="after")
    def _some_law(self) -> Self:
        own = [n for n in ("fore_aft", "lateral") if getattr(self, n) is not None]
        own += ["root"] if self.root else []
        more = [*own, "beam", "torsion"]
        for name, others in (
            ("beam", own),
            ("matrix", more),
            ("reduced", [*more, "matrix"]),
        ):
            clash = [n for n in others if getattr(self, n) is not None]
            if getattr(self, name) is not None and clash:
                raise ValueError(f"found {name} and {clash[0]}, expected one of them")
        if not (self.bends or self.torsion):
            raise ValueError(
                "found nothing that bends, expected fore_aft, lateral, torsion, beam, "
                "matrix or reduced"
            )
        return self

    @property
    def bends(self) -> bool:
        """Whether the leg bends, rather than twists alone."""
        whole = self.beam or self.matrix or self.reduced
        return bool(whole or self.fore_aft or self.lateral)


def require_over_stroke(leg: Leg, stroke: float, sliding: bool) -> None:
    """Checks a leg against the stroke (m) of its gear, `sliding` a piston or not.

    Raises:
        ValueError: tables reach far beyond the stroke, or the beams do not hold it.
    """
    beam = leg.beam
    if beam is not None:
        _require_beam(beam, stroke, sliding)
    for name in ("fore_aft", "lateral", "torsion"):
        elastic = getattr(leg, name)
        for key in ("stiffness_table", "frequency_table"):
            table = elastic and getattr(elastic, key)
            if table and table[-1][0] > 3.0 * stroke:
                raise ValueError(
                    f"leg.{name}.{key}: found a stroke of {table[-1][0]:g} m, expected "
                    f"about {stroke:g} m, the mechanical stroke"
                )


def _require_beam(beam: LegBeam, stroke: float, sliding: bool) -> None:
    if not sliding:
        raise ValueError(
            "leg.beam: a levered gear has no piston that slides in its leg, expected "
            "fore_aft and lateral"
        )
    if beam.overhang <= stroke:
        raise ValueError(
            f"leg.beam.overhang: found {beam.overhang:g} m, expected more than the "
            f"stroke, {stroke:g} m"
        )
    least = beam.bearing_distance + stroke
    if beam.cylinder_length <= least:
        raise ValueError(
            f"leg.beam.cylinder_length: found {beam.cylinder_length:g} m, expected "
            f"more than bearing_distance and stroke together, {least:g} m"
        )
