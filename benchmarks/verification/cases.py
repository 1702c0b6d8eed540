"""All cases, in the order of the table."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from benchmarks.verification import (
    beam_masses,
    beam_warping,
    bricks,
    buckling,
    cantilevers,
    commercial,
    curved_shells,
    drilling_shells,
    drop_tests,
    joints,
    macneal_harder,
    nafems_beams,
    nafems_plates,
    patches,
    plate_shear,
    quadratic_solids,
    rigid_motion,
    rings,
    sections,
    small_systems,
    thermal,
)
from benchmarks.verification.row import Row

REFERENCES = Path(__file__).resolve().parents[3] / "shared" / "references"


@dataclass(frozen=True)
class Case:
    """A function that returns rows.

    Attributes:
        group: heading of its table.
        compute: the function.
    """

    group: str
    compute: Callable[..., list[Row]]

    @property
    def name(self) -> str:
        """Name of the function."""
        return self.compute.__name__

    @property
    def needs_references(self) -> bool:
        """Whether the reference decks are needed."""
        return bool(inspect.signature(self.compute).parameters.keys() & {"references"})

    def rows(self, references: Path = REFERENCES) -> list[Row] | None:
        """The rows; None where the reference decks are needed and absent."""
        if not self.needs_references:
            return self.compute()
        return self.compute(references) if references.is_dir() else None


_GROUPS: dict[str, tuple[Callable[..., list[Row]], ...]] = {
    "Decks and figures of other solvers": (
        commercial.trusses_and_beams,
        commercial.solid_shell_bar_statics,
        commercial.solid_shell_bar_modes,
        commercial.solid_shell_bar_buckling,
        commercial.solid_shell_bar_transient,
        commercial.line_elements_transient,
        quadratic_solids.single_hexa20,
        quadratic_solids.cubes_under_a_corner_force,
        quadratic_solids.cubes_in_time,
        quadratic_solids.distorted_tetra10,
        bricks.layered_bricks,
        rings.rings_under_pressure,
        bricks.brick_without_bubbles,
        cantilevers.cantilever_bar,
        cantilevers.cantilever_plate,
        commercial.reductions,
        commercial.rbe3_matrices,
        commercial.truss_frame,
    ),
    "Patch tests and rigid motions": (
        patches.patches,
        rigid_motion.rigid_motions,
    ),
    "NAFEMS and closed forms": (
        nafems_beams.fv2,
        nafems_beams.fv4,
        nafems_beams.fv5,
        nafems_beams.deep_beam_transient,
        nafems_beams.euler_cantilever,
        beam_masses.masses_of_beams,
        beam_warping.restrained_torsion,
        beam_warping.warping_of_two_beams,
        sections.shear_factors,
        sections.round_cantilever_modes,
        small_systems.damped_oscillator,
        small_systems.four_points,
        quadratic_solids.chains_of_hexa20,
        quadratic_solids.quadratic_cantilevers,
        quadratic_solids.thick_plate,
        nafems_plates.plates,
        nafems_plates.free_plate_against_optistruct,
        nafems_plates.tapered_membrane,
        nafems_plates.solids,
        nafems_plates.plate_transients,
        plate_shear.plate_reactions,
    ),
    "MacNeal and Harder": (
        macneal_harder.straight_beam,
        macneal_harder.curved_beam,
        macneal_harder.twisted_beam,
        macneal_harder.scordelis_lo,
        macneal_harder.hemisphere,
        macneal_harder.rectangular_plates,
        macneal_harder.thick_cylinder,
    ),
    "Shells with mid-sides": (
        curved_shells.patches_with_mid_sides,
        curved_shells.curved_roof,
        curved_shells.curved_hemisphere,
        curved_shells.plates_of_any_thickness,
        curved_shells.shear_forces,
        curved_shells.pressurised_cylinder,
        curved_shells.single_elements,
        curved_shells.pairs_without_shear_flexibility,
    ),
    "Shells with drilling": (
        drilling_shells.drilling_patches,
        drilling_shells.cook_membrane,
        drilling_shells.sheet_cantilever,
    ),
    "Joints": (joints.lap_joint, joints.shell_in_solid),
    "Temperatures": (thermal.bimetal_plate,),
    "Linear buckling": (
        buckling.euler_columns,
        buckling.beams_sideways,
        buckling.plates_that_buckle,
        buckling.stiffened_panel,
        buckling.solid_column,
    ),
    "Landing gear": (drop_tests.main_gear,),
}

CASES = [Case(group, f) for group, functions in _GROUPS.items() for f in functions]
