"""Legs of landing gears that bend and twist: rigid bodies joined by elastic hinges.

A leg has up to three hinges between fitting and strut: bending fore and aft, bending to
the side, torsion about the strut axis. With θ their angles and q the position of the
strut's joint (stroke, or angle of an arm) they store

    V = ½ eᵀ K(q) e,   e = θ, less the free play where there is some,

so that torques -K e act on the hinges and, because K changes with the stroke,
-½ eᵀ (dK/dq) e on the strut: without it a leg that is compressed while it is bent would
gain or lose energy. Dampers act with the torques -C(q) θ'. K and C are piecewise linear
over q, even at the ends.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MethodType
from typing import Any

import numpy as np
import numpy.typing as npt
from pydrake.common.value import Value
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import PrismaticJoint, RevoluteJoint
from pydrake.systems.framework import LeafSystem_, ValueProducer

from systems.tools.compiled import compiled_law
from systems.tools.scalar import Scalar
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_HINGES = 3


@dataclass(frozen=True, kw_only=True)
class ElasticLeg:
    """Hinges of one leg and their law.

    Attributes:
        hinges: (n,) joints, n from 1 to 3.
        strut: the joint that K and C depend on.
        start, end: range of its position, m or rad; beyond, K and C are those of the
            nearer end. May descend.
        stiffness: (m, n, n) at m >= 2 even positions from start to end, N m/rad;
            symmetric, positive definite.
        damping: (m, n, n) N m s/rad; symmetric, positive semidefinite.
        free_play: (n,) half width about zero, rad.

    Raises:
        ValueError: shapes do not fit, a matrix is not as said, free play is negative.
    """

    hinges: Sequence[RevoluteJoint]
    strut: PrismaticJoint | RevoluteJoint
    start: float
    end: float
    stiffness: Float64
    damping: Float64
    free_play: Float64

    def __post_init__(self) -> None:
        n, m = len(self.hinges), len(self.stiffness)
        if not 1 <= n <= _HINGES or m < 2 or self.start == self.end:
            raise ValueError(
                f"elastic leg: {n} hinges and {m} positions from {self.start} to "
                f"{self.end}, expected 1 to {_HINGES} hinges and a range of two or more"
            )
        for name, least in (("stiffness", np.nextafter(0, 1)), ("damping", 0.0)):
            matrices = getattr(self, name)
            if matrices.shape != (m, n, n):
                raise ValueError(
                    f"elastic leg: {name} has the shape {matrices.shape}, expected "
                    f"{(m, n, n)}"
                )
            _require_definite(name, matrices, least)
        if self.free_play.shape != (n,) or self.free_play.min() < 0.0:
            raise ValueError(
                f"elastic leg: free play is {self.free_play} rad, expected {n} numbers "
                ">= 0"
            )


def _require_definite(name: str, matrices: Float64, least: float) -> None:
    scale = np.abs(matrices).max(initial=1e-300)
    uneven = np.abs(matrices - matrices.transpose(0, 2, 1)).max()
    lowest = np.linalg.eigvalsh(matrices).min()
    # Rounding of the eigenvalues of a semidefinite matrix.
    if uneven > 1e-9 * scale or not lowest >= least - (
        1e-12 * scale if not least else 0
    ):
        raise ValueError(
            f"elastic leg: {name} has the eigenvalue {lowest:.4g}, expected symmetric "
            f"matrices with eigenvalues {'>' if least else '>='} 0"
        )


@for_scalars
def ElasticLegs_(T):
    law = elastic_forces_of_floats if T is float else elastic_forces

    class Impl(LeafSystem_[T]):
        """The elastic hinges of all legs of an aircraft.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `plant_state` | nq + nv | | positions and velocities of the plant |
        | out `generalized_force` | nv | N, N m | on hinges and struts |
        | out `deflection_<gear>` | 3 | rad | fore and aft (lower end aft > 0), to the
          side (lower end to starboard > 0), torsion (about the strut axis, up); zero
          where the leg has no such hinge |
        | out `energy` | 1 | J | stored |
        | out `dissipated_power` | 1 | W | >= 0 |

        Args:
            plant: finalised.
            legs: by gear.
            kinds: of each gear, for each hinge 0 (fore and aft), 1 (side), 2 (torsion).
        """

        def _construct(
            self,
            plant: MultibodyPlant,
            legs: Mapping[str, ElasticLeg],
            kinds: Mapping[str, Sequence[int]],
            converter=None,
        ):
            LeafSystem_[T].__init__(self, converter=converter)
            self._given = plant, dict(legs), dict(kinds)
            nq, self._nv = plant.num_positions(), plant.num_velocities()
            self._laws = _laid_out(list(legs.values()), nq)
            self._state: Any = self.DeclareVectorInputPort(
                "plant_state", plant.num_multibody_states()
            )
            self._law: Any = self.DeclareCacheEntry(
                "law",
                ValueProducer(
                    allocate=lambda: Value(object()), calc=weakly(self._calc_law)
                ),
                {self._state.ticket()},
            )

            def declare(name, size, calc, ticket):
                self.DeclareVectorOutputPort(
                    name, size, calc, prerequisites_of_calc={ticket}
                )

            declare(
                "generalized_force",
                self._nv,
                weakly(self._calc_force),
                self._law.ticket(),
            )
            for i, name in enumerate(("energy", "dissipated_power"), start=1):
                declare(name, 1, self._number_port(i), self._law.ticket())
            for name, leg in legs.items():
                rows = [joint.position_start() for joint in leg.hinges]
                port = self._deflection_port(rows, list(kinds[name]))
                declare(f"deflection_{name}", 3, port, self._state.ticket())

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, *other._given, converter=converter)

        def _calc_law(self, context, value):
            value.set_value(law(self._state.Eval(context), *self._laws, self._nv))

        def _calc_force(self, context, output):
            output.SetFromVector(self._law.Eval(context)[0])

        def _number_port(self, i: int):
            def calc(self, context, output):
                output.SetAtIndex(0, self._law.Eval(context)[i])

            return weakly(MethodType(calc, self))

        def _deflection_port(self, rows: list[int], kinds: list[int]):
            def calc(self, context, output):
                angles = np.array([T(0.0)] * 3)
                angles[kinds] = self._state.Eval(context)[rows]
                output.SetFromVector(angles)

            return weakly(MethodType(calc, self))

    return Impl


def _laid_out(legs: list[ElasticLeg], nq: int) -> tuple[Any, ...]:
    """Arguments of `elastic_forces` between the state and the number of velocities."""
    count = max(len(leg.stiffness) for leg in legs)
    places = np.full((len(legs), 2, 1 + _HINGES), -1, dtype=np.int64)
    ranges = np.empty((len(legs), 2))
    matrices = np.zeros((len(legs), 2, count, _HINGES, _HINGES))
    play = np.zeros((len(legs), _HINGES))
    for i, leg in enumerate(legs):
        n, m = len(leg.hinges), len(leg.stiffness)
        for j, joint in enumerate((leg.strut, *leg.hinges)):
            places[i, :, j] = joint.position_start(), joint.velocity_start()
        ranges[i] = leg.start, leg.end
        old, new = np.linspace(0, 1, m), np.linspace(0, 1, count)
        for a in range(n):
            play[i, a] = leg.free_play[a]
            for b in range(n):
                matrices[i, 0, :, a, b] = np.interp(new, old, leg.stiffness[:, a, b])
                matrices[i, 1, :, a, b] = np.interp(new, old, leg.damping[:, a, b])
    return places, ranges, matrices, play, nq


def elastic_forces(
    state: Any,
    places: Int64,
    ranges: Float64,
    matrices: Float64,
    free_play: Float64,
    nq: int,
    nv: int,
) -> tuple[Any, Scalar, Scalar]:
    """What the hinges of all legs do; floats or AutoDiffXd.

    Args:
        state: (nq + nv,) of the plant.
        places: (k, 2, 4) per leg: positions and velocities of strut and hinges in the
            plant; -1 where there is no such hinge.
        ranges: (k, 2) position of the strut at the first and last matrix.
        matrices: (k, 2, m, 3, 3) K and C, N m/rad and N m s/rad.
        free_play: (k, 3) rad.
        nq, nv: of the plant.

    Returns:
        (nv,) generalised forces, N m and N; stored energy, J; dissipated power, W.
    """
    zero = 0.0 * state[0]
    force, e, rate = np.full(nv, zero), np.full(3, zero), np.full(3, zero)
    energy, power = zero, zero
    last = matrices.shape[2] - 1
    for i in range(len(places)):
        position, velocity = places[i, 0], places[i, 1]
        scale = last / (ranges[i, 1] - ranges[i, 0])
        x = (state[position[0]] - ranges[i, 0]) * scale
        inside = x >= 0.0 and x < last
        if not inside:
            x = zero if x < 0.0 else zero + last
        at = 0
        while at < last - 1 and x >= at + 1:
            at += 1
        x = x - at
        for a in range(3):
            e[a] = rate[a] = zero
            if position[1 + a] >= 0:
                angle, play = state[position[1 + a]], free_play[i, a]
                if angle > play:
                    e[a] = angle - play
                elif angle < -play:
                    e[a] = angle + play
                rate[a] = state[nq + velocity[1 + a]]
        slope = zero
        for a in range(3):
            if position[1 + a] < 0:
                continue
            elastic, damped = zero, zero
            for b in range(3):
                low, high = matrices[i, 0, at, a, b], matrices[i, 0, at + 1, a, b]
                elastic = elastic + (low + x * (high - low)) * e[b]
                slope = slope + (high - low) * e[a] * e[b]
                low, high = matrices[i, 1, at, a, b], matrices[i, 1, at + 1, a, b]
                damped = damped + (low + x * (high - low)) * rate[b]
            energy = energy + 0.5 * elastic * e[a]
            power = power + damped * rate[a]
            if e[a] == 0.0 and free_play[i, a] > 0.0:
                elastic = zero
            row = velocity[1 + a]
            force[row] = force[row] - (elastic + damped)
        if inside:
            row = velocity[0]
            force[row] = force[row] - 0.5 * slope * scale
    return force, energy, power


elastic_forces_of_floats = compiled_law(elastic_forces)
"""The same, compiled."""

ElasticLegs = default_instantiation(ElasticLegs_)
