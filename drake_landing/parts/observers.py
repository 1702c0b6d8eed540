"""All that is taken from a transient about the parts, of one load case or more."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from drake_landing.landing.handover import AttachmentLoads
from drake_landing.parts.cuts import BeamCuts, Cutter, mean_of_three
from drake_landing.parts.inventory import Inventory
from drake_landing.parts.monitors import Station, stations
from drake_landing.parts.stress import Stresses, stresses
from drake_landing.parts.stress_observer import Snapshot, StressWatch
from drake_landing.places import Beam, Places
from fem.model.structure import Structure
from fem.response.observation import Observation, Observer

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class CaseFound:
    """One load case.

    Attributes:
        sections: beam -> (t, n, 6) section loads, columns `COMPONENTS`, B.
        monitors: monitor point of the deck -> (t, q) its loads, see `Station`.
        acceleration: grid -> (t, 3), B, m/s².
        stress: one row per element: `id`, `component`, `material`, `x`, `y`, `z`,
            `allowed`, `equivalent` and its `time`, `largest`, `smallest` (Pa, s);
            `axial_only`: of a bar that bends the axial stress alone is known.
    """

    sections: Mapping[str, Float64]
    monitors: Mapping[str, Float64] = field(default_factory=dict)
    acceleration: Mapping[int, Float64]
    stress: pd.DataFrame


@dataclass(frozen=True, kw_only=True)
class PartsFound:
    """Loads and stresses of the parts.

    Attributes:
        time: (t,) s.
        cuts: beam -> its cuts.
        stations: monitor points of the deck.
        places: panels and equipment.
        cases: load cases, the landing itself first.
        total: stress table of the landing upon steady flight, None: not known.
        worst: component -> displacements when its worst element sees its worst.
        imbalance: force and moment that the equilibrium of the whole airframe misses,
            over the largest applied ones.
    """

    time: Float64
    cuts: Mapping[str, BeamCuts]
    stations: tuple[Station, ...] = ()
    places: Places
    cases: tuple[CaseFound, ...]
    total: pd.DataFrame | None = field(default=None, repr=False)
    worst: Mapping[str, Snapshot] = field(repr=False)
    imbalance: tuple[float, float]

    @property
    def landing(self) -> CaseFound:
        """The load case of the landing itself."""
        return self.cases[0]

    @property
    def looked_at(self) -> dict[str, int]:
        """Beam -> the cut that is looked at over time.

        The first, which is the root; ahead and behind, where nothing says what the root
        is, that with the largest bending moment.
        """
        found = {}
        for name, cuts in self.cuts.items():
            bending = cuts.named(self.landing.sections[name])[..., 1]
            largest = int(np.abs(bending).max(axis=0).argmax())
            lengthwise = cuts.beam.outward in ("fore", "aft")
            found[name] = largest if lengthwise and cuts.beam.tips else 0
        return found

    @property
    def judged(self) -> pd.DataFrame:
        """The stress table that margins hold for: upon steady flight where known."""
        return self.landing.stress if self.total is None else self.total


class PartsWatch:
    """Observers of a transient, and what they found.

    Args:
        cutter: of the full model.
        places: where to look.
        elements: of the deck.
        grids: further grids whose accelerations are wanted.
        loaded: nodes that loads act on.
        averaged: the scheme applies means of three loads (Nastran's).
        steady: (f,) displacements of steady flight, None: not known.
    """

    def __init__(
        self,
        cutter: Cutter,
        places: Places,
        elements: Inventory,
        grids: Sequence[int],
        loaded: Int64,
        *,
        averaged: bool = True,
        steady: Float64 | None = None,
    ) -> None:
        structure = cutter.structure
        self.places, self.elements = places, elements
        self.stresses: Stresses = stresses(structure, elements.allowables)
        self._averaged = averaged
        self._rows = elements.of(self.stresses.id)
        self.components, group = np.unique(self._rows.component, return_inverse=True)
        self.steady = steady
        self._stress = StressWatch(
            self.stresses, group, self._rows.allowed.to_numpy(float), steady
        )
        nodes = [int(n) for n in loaded]
        self.cuts = {b.name: cutter.cuts(b, nodes) for b in places.beams}
        self._whole = cutter.cuts(_everything(structure), nodes)
        self.grids = np.unique([*grids, *places.grids]).astype(np.int64)
        self.stations, self.notices = stations(structure, nodes)
        self._inertial = [s for s in self.stations if s.of_acceleration is not None]
        self._elastic = [s for s in self.stations if s.of_displacement is not None]
        self._operators = [
            *(cuts.of_acceleration for cuts in self.cuts.values()),
            *(s.of_acceleration for s in self._inertial),
            self._whole.of_acceleration,
            structure.operator(self.grids, (1, 2, 3), frame="basic"),
        ]
        operator = sp.csr_matrix(sp.vstack(self._operators))
        self._motion = Observation("acceleration", operator)
        self._drag = structure.damping.mass_factor
        self._velocity = Observation("velocity", operator) if self._drag else None
        self._strained = None
        if self._elastic:
            maps = sp.vstack([s.of_displacement for s in self._elastic])
            self._strained = Observation("displacement", sp.csr_matrix(maps))

    @property
    def rows(self) -> pd.DataFrame:
        """A row for each element, in the order of the stresses; column `id`."""
        rows = self._rows.reset_index()
        return rows.assign(axial_only=self.stresses.axial_only)

    @property
    def observers(self) -> list[Observer]:
        """Observers to be given to the transient."""
        return [self._stress, *self._moved().values()]

    @property
    def content(self) -> list[object]:
        """Everything that what it finds depends on, beside loads and matrices."""
        s = self._stress
        maps = [self.stresses.expand, *(p.operator for p in self.stresses.parts)]
        operators = [seen.operator for seen in self._moved().values()]
        return [maps, operators, self.stresses.limits, *s.content]

    def arrays(self) -> dict[str, npt.NDArray]:
        """Results as arrays, for `restore`."""
        found = {f"stress_{k}": v for k, v in self._stress.arrays().items()}
        for name, seen in self._moved().items():
            found |= {f"{name}_time": seen.time, name: seen.values}
        return found

    def restore(self, arrays: Mapping[str, npt.NDArray]) -> None:
        """Takes over the results of an observer with the same `content`."""
        prefix = "stress_"
        self._stress.restore(
            {k.removeprefix(prefix): v for k, v in arrays.items() if prefix in k}
        )
        for name, seen in self._moved().items():
            seen.time, seen.values = arrays[f"{name}_time"], arrays[name]

    def _moved(self) -> dict[str, Observation]:
        all_three = {
            "acceleration": self._motion,
            "velocity": self._velocity,
            "displacement": self._strained,
        }
        return {name: seen for name, seen in all_three.items() if seen is not None}

    def collect(self, loads: Sequence[AttachmentLoads]) -> PartsFound:
        """Results after the transient, whose load cases these loads are."""
        cases = [self._case(i, load) for i, load in enumerate(loads)]
        worst = {
            str(self.components[k]): snapshot
            for k, snapshot in self._stress.worst.items()
        }
        return PartsFound(
            time=self._motion.time,
            cuts=self.cuts,
            stations=self.stations,
            places=self.places,
            cases=tuple(cases),
            total=self._stresses(-1) if self.steady is not None else None,
            worst=worst,
            imbalance=self._imbalance(loads[0]),
        )

    def _parts(self, case: int, *, inertia: bool) -> list[Float64]:
        """Accelerations through each operator; of inertia with the drag on the mass."""
        values = self._motion.values[:, case]
        if inertia and self._velocity is not None:
            values = values + self._drag * self._velocity.values[:, case]
        ends = np.cumsum([len(o.indptr) - 1 for o in self._operators])[:-1]
        return np.split(values, ends, axis=1)

    def _applied(self, loads: AttachmentLoads) -> Float64:
        return mean_of_three(loads.load) if self._averaged else loads.load

    def _case(self, case: int, loads: AttachmentLoads) -> CaseFound:
        applied = self._applied(loads)
        inertia = self._parts(case, inertia=True)
        moved = self._parts(case, inertia=False)[-1].reshape(len(applied), -1, 3)
        return CaseFound(
            sections={
                name: cuts.loads(part, loads.node_id, applied)
                for (name, cuts), part in zip(self.cuts.items(), inertia)
            },
            monitors=self._monitors(case, inertia[len(self.cuts) :], applied),
            acceleration={int(g): moved[:, i] for i, g in enumerate(self.grids)},
            stress=self._stresses(case),
        )

    def _monitors(
        self, case: int, inertia: list[Float64], applied: Float64
    ) -> dict[str, Float64]:
        """Loads of the monitor points; `inertia` of those of MONPNT1 comes first."""
        moved = {s.name: part for s, part in zip(self._inertial, inertia)}
        if self._strained is not None:
            values = self._strained.values[:, case]
            parts = np.split(values, len(self._elastic), axis=1)
            moved |= {s.name: part for s, part in zip(self._elastic, parts)}
        return {s.name: s.values(moved[s.name], applied) for s in self.stations}

    def _stresses(self, case: int) -> pd.DataFrame:
        seen = self._stress
        return self.stress_table(
            seen.equivalent[case],
            seen.time[case],
            seen.largest[case],
            seen.smallest[case],
        )

    def stress_table(
        self, equivalent: Float64, time: Float64, largest: Float64, smallest: Float64
    ) -> pd.DataFrame:
        """See `CaseFound.stress`; arrays (e,) in the order of the stresses."""
        return self._rows.reset_index().assign(
            equivalent=equivalent,
            time=time,
            largest=largest,
            smallest=smallest,
            axial_only=self.stresses.axial_only,
        )

    def _imbalance(self, loads: AttachmentLoads) -> tuple[float, float]:
        applied = self._applied(loads)
        inertia = self._parts(0, inertia=True)[-2]
        rest = self._whole.loads(inertia, loads.node_id, applied)[:, 0]
        given = self._whole.loads(np.zeros_like(inertia), loads.node_id, applied)[:, 0]

        def share(columns: slice) -> float:
            largest = np.abs(given[:, columns]).max()
            missed = np.abs(rest[:, columns]).max()
            return float(missed / largest) if largest else float(missed)

        return share(slice(3)), share(slice(3, 6))


def _everything(structure: Structure) -> Beam:
    """The whole airframe as one part, about its center of gravity."""
    p = structure.points.xyz
    station = float(p[:, 0].min()) - 1.0
    center = structure.rigid_mass.center.copy()
    return Beam(
        name="airframe",
        outward="aft",
        stations=np.array([station]),
        line=center[None],
    )
