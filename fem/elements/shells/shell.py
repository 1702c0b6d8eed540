"""Blocks of shells: CQUAD4, CTRIA3, CQUADR, CTRIAR with their matrices and results.

Membrane and bending: `shell_hybrid`; transverse shear: `shell_shear`; drilling:
`shell_drilling`, and `drilling_membrane` of CQUADR and CTRIAR. Mass sits on the surface
of the offset shell, that of a laminate at its own height.
"""

from dataclasses import dataclass, replace

import numpy as np

from fem.arrays import Float64, Int64
from fem.deck.records.shells import PLY_STRAIN, PLY_STRESS, SHELL_FORCE, of_plies
from fem.elements.block import CENTER, Detail, Kind, Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.shells.drilling_membrane import DrillingInPlane, drilling_in_plane
from fem.elements.shells.expansion import curled, stretched, warmed
from fem.elements.shells.failure_recovery import FailureRecovery, failure_names
from fem.elements.shells.shell_drilling import drilling
from fem.elements.shells.shell_geometry import (
    Facet,
    facet,
    matrix_to_grids,
    to_grids,
)
from fem.elements.shells.shell_hybrid import InPlane, in_plane
from fem.elements.shells.shell_mass import shell_mass
from fem.elements.shells.shell_preload import facet_differential
from fem.elements.shells.shell_recovery import (
    FibreRecovery,
    PlyRecovery,
    point_names,
    strain_names,
    stress_names,
)
from fem.elements.shells.shell_shear import shear
from fem.properties.shell_expansion import residual_map
from fem.properties.shell_section import (
    ShellSection,
    section_flexibility,
    strain_rotation,
    vector_rotation,
)
from fem.properties.shells import ShellProperty

# Elements that are computed at a time: their arrays stay in the cache.
_CHUNK = 1024
_FREE = ("strain", "curvature")


@dataclass(frozen=True, kw_only=True)
class Shell(DenseBlock):
    """Flat shells with three or four corners and PSHELL or with PCOMP; basic axes.

    Attributes:
        pid: (e,) property ids.
        property_card: "PSHELL" or "PCOMP".
        corners: (e, n, 3) grids in the basic frame.
        offset: (e,) ZOFFS.
        normals: (e, n, 3) normals at the grids, zero where there is none.
        section: constitutive matrices in element axes.
        k6rot: PARAM K6ROT.
        properties: the properties in use.
        which: (e,) index into `properties`.
        angle: (e,) rad, from the element x axis to the material x axis.
    """

    pid: Int64
    property_card: str
    corners: Float64
    offset: Float64
    normals: Float64
    section: ShellSection
    k6rot: float
    properties: tuple[ShellProperty, ...]
    which: Int64
    angle: Float64

    @property
    def shape(self) -> Facet:
        """Element axes and flat shape."""
        return facet(self.corners, self.offset, self.normals)

    @property
    def extent(self) -> Float64:
        """(e,) area."""
        return self.shape.area

    def take(self, part: slice | Int64) -> "Shell":
        """Some of the elements."""
        names = ("id", "dof", "pid", "corners", "offset", "normals", "which", "angle")
        chosen = {name: getattr(self, name)[part] for name in names}
        return replace(self, section=self.section.take(part), **chosen)

    def with_nonstructural_mass(self, per_area: Float64) -> "Shell":
        """Copy with additional mass per area (e,)."""
        total = self.section.nonstructural + per_area
        return replace(self, section=replace(self.section, nonstructural=total))

    @property
    def tref(self) -> Float64:
        """(e,) temperature without strain."""
        return np.array([p.tref for p in self.properties])[self.which]

    def expansion(self) -> Float64:
        """(e, 6 n), see `DenseBlock`; NaN: curvatures of shells with mid-sides.

        Along the normal, which matters to elements that are not flat, the mean.
        """
        return self._expanded(0)

    def bent(self) -> Float64:
        """(e, 6 n) displacements of free elements per gradient over the thickness."""
        return self._expanded(1)

    def uneven(self, temperature: Float64) -> Float64:
        """(e, 6 n) what temperatures (e, n) of the grids add to those of their mean.

        Of CQUAD4 (`warmed`); nothing of the others.
        """
        flat = self.dof.shape[1] == 24 and not self.drills
        if not flat:
            return np.zeros(self.dof.shape)
        return warmed(self.shape, self._free("strain", 0), temperature)

    def _expanded(self, load: int) -> Float64:
        """(e, 6 n) by one degree (0), or by one degree per length along z (1)."""
        strain, curvature = (self._free(name, load) for name in _FREE)
        shape, grids = self.shape, self.expanding
        moved = stretched(shape, grids, strain) + curled(shape, grids, curvature)
        return moved.reshape(len(self.id), -1)

    def _free(self, name: str, load: int) -> Float64:
        """(e, 3) strain or curvature of free elements, element axes."""
        own = np.stack([getattr(p.expansion, name)[load] for p in self.properties])
        nominal = np.array([p.nominal for p in self.properties])
        ratio = self.section.thickness / nominal[self.which]
        power = {"strain": load, "curvature": load - 1}[name]
        scaled = own[self.which] * ratio[:, None] ** power
        return np.einsum("eij,ej->ei", strain_rotation(-self.angle), scaled)

    @property
    def expanding(self) -> Float64:
        """(e, n, 3) grids."""
        return self.corners

    def stiffness(self) -> Float64:
        """(e, 6 n, 6 n)."""
        size = self.dof.shape[1]
        matrix = np.empty((len(self.id), size, size))
        for start in range(0, len(self.id), _CHUNK):
            part = slice(start, start + _CHUNK)
            shape, section = self._shape(part), self.section.take(part)
            local = self._in_plane(shape, section).stiffness()
            local += shear(shape, section, drills=self.drills)[0]
            if self.k6rot and not self.drills:
                local += drilling(shape, section.membrane[:, 2, 2], self.k6rot)
            matrix[part] = matrix_to_grids(local, shape)
        return matrix

    def differential_stiffness(
        self, motion: Float64, load: Float64 | None = None
    ) -> Float64:
        """(e, 6 n, 6 n) of the membrane forces."""
        matrix = np.empty((len(self.id), self.dof.shape[1], self.dof.shape[1]))
        for start in range(0, len(self.id), _CHUNK):
            part = slice(start, start + _CHUNK)
            resultant = self._resultants(part, True)[:, :, :3]
            membrane = np.einsum("epcn,en->epc", resultant, motion[part])
            matrix[part] = facet_differential(self._shape(part), membrane)
        return matrix

    @property
    def drills(self) -> bool:
        """Rotations about the normal are true freedoms of the membrane."""
        return self.card in ("CQUADR", "CTRIAR")

    def _in_plane(
        self, shape: Facet, section: ShellSection
    ) -> InPlane | DrillingInPlane:
        part = drilling_in_plane if self.drills else in_plane
        return part(shape, section)

    def _shape(self, part: slice) -> Facet:
        return facet(self.corners[part], self.offset[part], self.normals[part])

    def structural_damping(self) -> Float64 | None:
        """(e,) GE."""
        return some(self.section.ge)

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 6 n, 6 n), translations of the mass's own height."""
        return shell_mass(self.shape, self.section, self.offset, coupled=coupled)

    def resultants(self, *, corner: bool = False) -> Float64:
        """(e, p, 8, 6 n) N, M and Q from grid freedoms in basic axes, element axes.

        M = int sigma z dz. p is 1, or 5 (center, corners) for quadrilaterals with
        `corner`; Q is that of the center everywhere.
        """
        parts = [
            self._resultants(slice(start, start + _CHUNK), corner)
            for start in range(0, len(self.id), _CHUNK)
        ]
        return np.concatenate(parts)

    def _resultants(self, part: slice, corner: bool) -> Float64:
        shape, section = self._shape(part), self.section.take(part)
        plate = self._in_plane(shape, section).resultant(corner=corner)
        force = shear(shape, section, drills=self.drills)[1][:, None]
        force = np.broadcast_to(force, (*plate.shape[:2], *force.shape[2:]))
        local = np.concatenate([plate, force], axis=2)
        e, p = local.shape[:2]
        flat = to_grids(local.reshape(e, p * 8, -1), shape)
        return flat.reshape(e, p, 8, -1)

    def forces(self, *, corner: bool = False) -> Recovery:
        """Nastran's shell forces at the center, with `corner` also at the corners."""
        resultant = self.resultants(corner=corner)
        resultant[:, :, 3:6] *= -1.0
        e, p = resultant.shape[:2]
        return Recovery(
            table=self.card,
            columns=point_names(SHELL_FORCE, p),
            matrix=resultant.reshape(e, p * 8, -1),
            id=self.id,
        )

    def stresses(self, *, corner: bool = False) -> Recovery:
        """Stresses at both fibres; of laminates the ply stresses (center)."""
        if self.property_card == "PCOMP":
            return self._plies()
        resultant = self.resultants(corner=corner)
        thickness, inertia = self.section.thickness, self.section.inertia
        fibre = self.section.fibre
        uniform = resultant[:, :, None, 0:3] / thickness[:, None, None, None, None]
        bent = resultant[:, :, None, 3:6] / inertia[:, None, None, None, None]
        matrix = uniform + fibre[:, None, :, None, None] * bent
        e, p = matrix.shape[:2]
        return FibreRecovery(
            table=self.card,
            columns=stress_names(p),
            matrix=matrix.reshape(e, p * 6, -1),
            id=self.id,
            fibre=fibre,
        )

    def strains(self, *, corner: bool = False, curvature: bool = True) -> Recovery:
        """Strains of the reference surface and curvatures (Nastran's STRCUR).

        With `curvature` False the strains at both fibres (FIBER), of laminates always
        the strains of the plies. Nastran's curvature
        has the sign of its M; the first column is then 0 and -1.
        """
        if self.property_card == "PCOMP":
            return self._plies(strain=True)
        resultant = self.resultants(corner=corner)
        plane = self.flexibility(corner=corner) @ resultant[:, :, :6]
        membrane, bent = plane[:, :, :3], plane[:, :, 3:]
        fibre = np.broadcast_to([0.0, -1.0], (len(self.id), 2))
        if not curvature:
            fibre = self.section.fibre
        height = fibre[:, None, :, None, None]
        if curvature:
            matrix = np.stack([membrane, -bent], axis=2)
        else:
            matrix = membrane[:, :, None] + height * bent[:, :, None]
        e, p = matrix.shape[:2]
        return FibreRecovery(
            table=self.card,
            columns=strain_names(p),
            matrix=matrix.reshape(e, p * 6, -1),
            id=self.id,
            fibre=fibre,
            strain=True,
        )

    def recovery(self, kind: Kind, detail: Detail = CENTER) -> Recovery | None:
        """Results at the center or with the corners, strains of surface or fibres."""
        if kind == "failure":
            return self._failures()
        if kind == "force":
            return self.forces(corner=detail.corner)
        if kind == "stress":
            return self.stresses(corner=detail.corner)
        return self.strains(corner=detail.corner, curvature=not detail.fibre)

    def flexibility(self, *, corner: bool = False) -> Float64:
        """(e, 1, 6, 6) pseudo-inverse of [A B; B D]: absent parts give no strain.

        One for each point, as in `resultants`, where the element axes turn.
        """
        return section_flexibility(self.section)[:, None]

    def _material_resultants(self) -> Float64:
        """(e, 8, 6 n) N, M and Q at the center in material axes."""
        resultant = self.resultants()[:, 0]
        turn = strain_rotation(self.angle)
        # Stresses turn with the inverse transpose of what turns strains.
        turn = np.linalg.inv(turn).transpose(0, 2, 1)
        return np.concatenate(
            [
                turn @ resultant[:, 0:3],
                turn @ resultant[:, 3:6],
                vector_rotation(self.angle) @ resultant[:, 6:8],
            ],
            axis=1,
        )

    def _plies(self, *, strain: bool = False) -> Recovery:
        """Ply results from the resultants at the center, turned to material axes."""
        found = [p.ply_map(strain=strain) for p in self.properties]
        most = max(map(len, found))
        maps = np.full((len(found), 5 * most, 8), np.nan)
        for k, ply in enumerate(found):
            maps[k, : 5 * len(ply)] = ply.reshape(-1, 8)
        return PlyRecovery(
            table=f"{self.card}_COMPOSITE",
            columns=of_plies(PLY_STRAIN if strain else PLY_STRESS, most),
            matrix=self._material_resultants(),
            id=self.id,
            laminate=self.which,
            maps=tuple(maps),
            residual=self._residual(most, strain=strain),
            strain=strain,
        )

    def _residual(self, most: int, *, strain: bool) -> tuple[Float64, ...]:
        """Per laminate (5 most, 2): what degree and gradient leave in the plies."""
        found = []
        for p in self.properties:
            own = np.full((5 * most, 2), np.nan)
            if p.laminate is not None and p.expansion.plies is not None:
                left = residual_map(p.laminate, p.expansion.plies, strain=strain)
                own[: 5 * len(left)] = left.reshape(-1, 2)
            found.append(own)
        return tuple(found)

    def _failures(self) -> Recovery | None:
        """Failure indices; None where no property of the block asks for them."""
        failures = tuple(p.failure for p in self.properties)
        if not any(failures):
            return None
        maps = [
            np.stack([p.ply_map(), p.ply_map(strain=True)], axis=1)
            for p in self.properties
        ]
        return FailureRecovery(
            table=f"{self.card}_COMPOSITE",
            columns=failure_names(max(map(len, maps))),
            matrix=self._material_resultants(),
            id=self.id,
            laminate=self.which,
            maps=tuple(maps),
            residual=self._residuals_of_failure(),
            failures=failures,
        )

    def _residuals_of_failure(self) -> tuple[Float64, ...]:
        """Per laminate (p, 2, 5, 2): stresses and strains, as in the maps."""
        return tuple(
            np.stack(
                [
                    residual_map(p.laminate, p.expansion.plies, strain=strain)
                    for strain in (False, True)
                ],
                axis=1,
            )
            for p in self.properties
            if p.laminate is not None and p.expansion.plies is not None
        )
