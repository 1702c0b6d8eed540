"""The shell fuselage by itself, on a coarse mesh: shape, symmetry, stiffness, modes."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from pyNastran.bdf.bdf import read_bdf

from drake_landing.reference.d150.beams import add_materials, logarithmic
from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.fuselage import FuselageShell, add_fuselage_shell
from drake_landing.reference.d150.geometry import fuselage_point, fuselage_section
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.reference_axis import frame_id, reference_nodes
from fem import read_deck
from fem.algebra.linear_solver import factorize
from fem.algebra.modes import normal_modes
from fem.model.structure import Structure

COARSE = {
    "size": 0.55,
    "lines": {
        **{"window_top": 5, "window_bottom": 2, "floor": 2, "wing": 1},
        **{"cargo": 3, "keel": 2, "bottom": 1},
    },
}
FLIP = np.array([1.0, -1.0, 1.0])


@dataclass
class Alone:
    """The fuselage without wing and tails."""

    bench: ModelBuilder
    shell: FuselageShell
    path: Path


@pytest.fixture(scope="module")
def alone(tmp_path_factory) -> Alone:
    bench, reference = ModelBuilder(), reference_nodes()
    add_materials(bench)
    frames = reference["fuselage"]
    bench.grids("fuselage", frames.ids, frames.p)
    shell = add_fuselage_shell(bench, reference, COARSE)
    path = tmp_path_factory.mktemp("fuselage") / "fuselage.bdf"
    path.write_text(bench.deck("fuselage", {1: frames.ids}, 10), encoding="ascii")
    return Alone(bench, shell, path)


@pytest.fixture(scope="module")
def structure(alone) -> Structure:
    return Structure.from_deck(read_deck(alone.path))


@pytest.fixture(scope="module")
def bdf(alone):
    return read_bdf(str(alone.path), debug=None, xref=True)


def test_every_frame_has_a_row_of_grids(alone):
    hull = alone.shell.hull
    frames = table("fuselage_frames")
    assert len(frames) == 86
    for name, x in zip(frames.frame, frames.x):
        row = hull.rows.at(name)
        assert hull.rows.x[row] == pytest.approx(x)
        ring = hull.lines.p[row]
        exact = fuselage_point(np.full(len(ring), x), hull.lines.angle[row])
        assert ring == pytest.approx(exact, abs=1e-12)


def test_named_lines_run_where_structure_meets_the_skin(alone):
    hull, data = alone.shell.hull, facts("fuselage_shell")
    at = {name: hull.lines.p[:, line] for name, line in hull.lines.index.items()}
    barrel = hull.rows.between("C26", "C55")
    floor = hull.rows.between("C02", "C69")
    z_floor = facts("fuselage")["passenger_floor_z"]
    assert at["floor"][floor, 2] == pytest.approx(z_floor, abs=1e-9)
    assert at["cargo"][barrel, 2] == pytest.approx(-1.916, abs=1e-3)
    for name in ("window_top", "window_bottom", "wing"):
        assert at[name][barrel, 2] == pytest.approx(data["lines"][name], abs=1e-3)
    assert at["keel"][barrel, 1] == pytest.approx(0.25, abs=1e-3)
    assert np.all(np.diff(hull.lines.angle, axis=1) > 0)


def test_skin_covers_the_hull_but_for_its_openings(alone, bdf):
    """Area of the elements and the openings against the integral of the perimeter."""
    hull = alone.shell.hull
    p = hull.lines.p
    corners = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    cross = np.cross(corners[2] - corners[0], corners[3] - corners[1])
    panels = np.linalg.norm(cross, axis=2) / 2
    x = np.linspace(0.96, 37.569, 2000)
    half, bottom, top = fuselage_section(x).T
    high = (top - bottom) / 2
    h = ((half - high) / (half + high)) ** 2
    perimeter = np.pi * (half + high) * (1 + 3 * h / (10 + np.sqrt(4 - 3 * h)))
    slope = np.hypot(1.0, np.gradient((half + high) / 2, x))
    area = (perimeter * slope).mean() * np.ptp(x)
    assert 2 * panels.sum() == pytest.approx(area, rel=0.015)
    skin = set(alone.bench.parts["fuselage skin"])
    elements = [
        e
        for e in bdf.elements.values()
        if e.type == "CQUAD4"
        and skin.issuperset(e.node_ids)
        and e.pid_ref.type == "PCOMP"
    ]
    covered = sum(e.Area() for e in elements)
    assert covered == pytest.approx(2 * panels[hull.present].sum(), rel=1e-5)
    for e in elements[::7]:
        center = e.Centroid()
        section = fuselage_section(center[0])[0]
        outward = center - [center[0], 0.0, section[1:].mean()]
        assert e.Normal() @ outward > 0.5 * np.linalg.norm(outward)


def test_elements_are_mirror_images(alone, bdf):
    position = {i: np.round(x, 5) + 0.0 for i, x in alone.bench.position.items()}
    at = {tuple(x): i for i, x in position.items()}
    mirror = {i: at[tuple(x * FLIP + 0.0)] for i, x in position.items()}
    found = Counter((e.type, e.pid, frozenset(e.node_ids)) for e in _elements(bdf))
    twins = Counter(
        (e.type, e.pid, frozenset(mirror[i] for i in e.node_ids))
        for e in _elements(bdf)
    )
    assert found == twins
    assert max(found.values()) == 1


def test_stringers_run_along_the_fuselage(bdf):
    """Side 1-2 of an element is the material axis; the nose rises steeply."""
    for e in bdf.elements.values():
        if e.type == "CQUAD4" and e.pid_ref.type == "PCOMP":
            a, b = (n.get_position() for n in e.nodes_ref[:2])
            assert abs(b[0] - a[0]) > 0.7 * np.linalg.norm(b - a)


def test_every_grid_belongs_to_an_element(alone, bdf):
    used = {i for e in _elements(bdf) for i in e.node_ids}
    reference = set(alone.bench.parts["fuselage"])
    assert used == set(bdf.nodes) - reference


def test_free_body_has_six_rigid_modes_and_none_that_is_local(structure):
    modes = normal_modes(
        structure.stiffness, structure.mass, count=9, rigid_body=structure.rigid_body
    )
    assert modes.rigid == 6
    assert modes.frequency_hz[6] > 8.0


def test_weight_is_what_the_generator_counted(alone, structure):
    counted = sum(m for part in alone.bench.structure.values() for m, _ in part)
    assert structure.weight.total == pytest.approx(counted, rel=1e-6)
    assert structure.weight.center[1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("component", "column", "tolerance"), [(5, 1, 0.2), (6, 1, 0.2), (4, 2, 0.3)]
)
def test_barrel_is_as_stiff_as_the_beam_of_the_other_levels(
    structure, component, column, tolerance
):
    """Moment over change of rotation, amid a tube bent or twisted at its ends."""
    moment = 1e6
    first, last = frame_id("C04"), frame_id("C84")
    points = structure.points
    load = np.zeros(points.size)
    load[points.dof([first], [component])] = moment
    load[points.dof([last], [component])] = -moment
    # A soft elastic foundation holds the free body; the loads balance by themselves.
    held = structure.stiffness + 1e-3 * structure.mass
    u = structure.displacement(factorize(held).solve(structure.load(load)))
    for a, b in (("C26", "C33"), ("C50", "C56")):
        dof = points.dof([frame_id(a), frame_id(b)], [component] * 2)
        x = [structure.points.xyz[points.rows(frame_id(f))][0] for f in (a, b)]
        stiffness = moment * (x[1] - x[0]) / abs(np.diff(u[dof])[0])
        rows = np.array(facts("fuselage")["stiffness"])
        beam = logarithmic(np.array([np.mean(x)]), rows[:, 0], rows[:, column])[0]
        assert stiffness == pytest.approx(beam, rel=tolerance)


def _elements(bdf):
    return [e for e in bdf.elements.values() if e.type in ("CQUAD4", "CTRIA3", "CBAR")]
