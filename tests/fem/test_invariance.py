"""Whole decks under changes that must not change the answer.

A small structure of shells, laminates, a solid, bars, rigid elements and all kinds of
loads: results do not depend on the frames of its grids (CP, CD), nor on the numbers of
grids and elements; a bar or a plate may be cut anywhere.
"""

from dataclasses import dataclass

import h5py
import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from mixed_structure import ELEMENTS, XYZ, deck, plain
from scipy.spatial.transform import Rotation

import fem
from fem.model.points import read_points
from fem.solution import run_deck

QUIET = settings(
    max_examples=3,
    deadline=None,
    derandomize=True,
    phases=[Phase.explicit, Phase.generate],
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)

FRAMES = """
CORD2R,101,,.3,-.2,.5,.8,.1,1.3,
,1.2,.6,.4
CORD2C,102,,5.,6.,-4.,5.3,6.5,1.,
,8.,5.,-3.
CORD2S,103,101,-6.,3.,-5.,-5.,3.4,2.,
,2.,5.,-4.
"""


@dataclass(frozen=True)
class Results:
    """Of one run, grids and elements in the order of the original numbers."""

    displacement: np.ndarray
    spc_force: np.ndarray
    hertz: np.ndarray
    tables: dict[str, np.ndarray]


def solve(text: str, folder, number=lambda grid: grid, element=lambda e: e) -> Results:
    """Run a deck; displacements and forces are turned to the basic frame."""
    path = folder / "model.bdf"
    path.write_text(text)
    model = fem.read_deck(path)
    points = read_points(model)
    grids = np.searchsorted(points.grid_id, [number(n) for n in XYZ])
    turn = points.rotation[grids]

    def basic(values: np.ndarray) -> np.ndarray:
        both = values[grids].reshape(-1, 2, 3)
        return np.einsum("gij,gkj->gki", turn, both).reshape(-1, 6)

    new = {element(e): e for e, _, _ in ELEMENTS}
    with h5py.File(run_deck(model, folder / "model.h5")) as file:
        tables = {}
        for kind in ("element_force", "element_stress", "element_strain"):
            for name, group in file[f"static/1/{kind}"].items():
                order = np.argsort([new[int(e)] for e in group["id"][:]])
                tables[f"{kind}/{name}"] = group["value"][:][order]
        for name, group in file["static/1/strain_energy"].items():
            order = np.argsort([new[int(e)] for e in group["id"][:]])
            tables[f"energy/{name}"] = group["value"][:][order]
        return Results(
            basic(file["static/1/displacement"][:]),
            basic(file["static/1/spc_force"][:]),
            file["modes/frequency_hz"][:],
            tables,
        )


def agree(a: Results, b: Results, tolerance: float) -> None:
    np.testing.assert_allclose(a.hertz, b.hertz, rtol=tolerance)
    for part in (slice(0, 3), slice(3, 6)):
        for x, y in ((a.displacement, b.displacement), (a.spc_force, b.spc_force)):
            scale = np.abs(x[:, part]).max()
            assert np.abs(x[:, part] - y[:, part]).max() < tolerance * scale
    assert a.tables.keys() == b.tables.keys()
    assert len(a.tables) > 25
    for name, values in a.tables.items():
        scale = np.abs(values).max()
        # Energies of stiff elements that hardly strain are differences of large terms.
        allowed = 1e-4 if name.startswith("energy") else 10.0 * tolerance
        assert np.abs(values - b.tables[name]).max() < allowed * scale, name


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    return solve(deck(plain()), tmp_path_factory.mktemp("reference"))


def in_frame(kind: int, p: np.ndarray) -> np.ndarray:
    """Coordinates of a basic point in one of FRAMES, angles in degrees."""
    r101, o101 = _triad((0.3, -0.2, 0.5), (0.8, 0.1, 1.3), (1.2, 0.6, 0.4))
    if kind == 101:
        return r101.T @ (p - o101)
    if kind == 102:
        r, o = _triad((5, 6, -4), (5.3, 6.5, 1), (8, 5, -3))
        x, y, z = r.T @ (p - o)
        return np.array([np.hypot(x, y), np.degrees(np.arctan2(y, x)), z])
    points = ((-6, 3, -5), (-5, 3.4, 2), (2, 5, -4))
    r, o = _triad(*(o101 + r101 @ np.array(q) for q in points))
    x, y, z = r.T @ (p - o)
    distance = np.sqrt(x * x + y * y + z * z)
    polar = np.degrees(np.arccos(z / distance))
    return np.array([distance, polar, np.degrees(np.arctan2(y, x))])


def _triad(a, b, c):
    a, b, c = (np.array(x, float) for x in (a, b, c))
    z = (b - a) / np.linalg.norm(b - a)
    y = np.cross(z, c - a)
    y /= np.linalg.norm(y)
    return np.stack([np.cross(y, z), y, z], axis=1), a


FRAME = st.sampled_from([0, 101, 102, 103])


@QUIET
@given(st.lists(st.tuples(FRAME, FRAME), min_size=len(XYZ), max_size=len(XYZ)))
def test_frames_of_grids_do_not_matter(reference, tmp_path_factory, frames):
    """Rectangular, cylindrical, spherical and nested frames, mixed at random."""
    grids = FRAMES
    for (n, xyz), (cp, cd) in zip(XYZ.items(), frames):
        x = np.array(xyz, float) if cp == 0 else in_frame(cp, np.array(xyz, float))
        fields = "".join(f"{v:16.9E}" for v in x)
        grids += (
            f"GRID*   {n:16d}{cp:16d}{fields[:32]}\n*       {fields[32:]}{cd:16d}\n"
        )
    # Vectors of bars stand in the frame CD of their first grid.
    text = deck(grids)
    model = read_points(_read(text, tmp_path_factory))
    turn = model.rotation[np.searchsorted(model.grid_id, 5)]
    v, offset = (turn.T @ np.array(x) for x in ((0.0, 1.0, 1.0), (0.05, 0.0, 0.1)))
    end = model.rotation[np.searchsorted(model.grid_id, 20)].T @ [0.0, 0.0, 0.1]
    old = "CBAR,7,4,5,20,0.,1.,1.\n,,,.05,0.,.1,0.,0.,.1"
    assert old in text
    text = text.replace(old, _large_bar(v, offset, end))
    found = solve(text, tmp_path_factory.mktemp("frames"))
    agree(reference, found, 1e-7)


def _large_bar(v: np.ndarray, offset_a: np.ndarray, offset_b: np.ndarray) -> str:
    """CBAR 7 in large fields."""
    fields = [7, 4, 5, 20, *v, "", "", "", *offset_a, *offset_b]
    texts = [f"{f:16.9E}" if isinstance(f, float) else f"{f:>16}" for f in fields]
    lines = ["".join(texts[k : k + 4]) for k in range(0, len(texts), 4)]
    return "CBAR*   " + "\n*       ".join(lines)


def _read(text: str, tmp_path_factory):
    path = tmp_path_factory.mktemp("read") / "a.bdf"
    path.write_text(text)
    return fem.read_deck(path)


@QUIET
@given(st.randoms(use_true_random=False))
def test_numbers_do_not_matter(reference, tmp_path_factory, random):
    """Random ids of grids and elements, hence other orders of everything."""
    grids = dict(zip(XYZ, random.sample(range(1, 99999), len(XYZ))))
    elements = dict(
        zip((e for e, _, _ in ELEMENTS), random.sample(range(1, 99999), len(ELEMENTS)))
    )
    cards = [f"GRID,{grids[n]},,{x},{y},{z}\n" for n, (x, y, z) in XYZ.items()]
    random.shuffle(cards)
    text = deck("".join(cards), grids.__getitem__, elements.__getitem__)
    found = solve(
        text,
        tmp_path_factory.mktemp("numbers"),
        grids.__getitem__,
        elements.__getitem__,
    )
    agree(reference, found, 1e-9)


@QUIET
@given(
    st.floats(0.05, 0.95),
    st.sampled_from(["CBAR", "CBEAM"]),
    st.integers(0, 2**31),
)
def test_a_bar_may_be_cut_anywhere(tmp_path_factory, at, card, seed):
    """Statics with a load along it, anywhere in space: the same end displacements."""
    rng = np.random.default_rng(seed)
    turn = Rotation.random(random_state=seed).as_matrix()
    x, v = 3.0 * turn[:, 0], turn[:, 1] + 0.3 * turn[:, 0]
    prop = "PBAR,1,1,4.-3,2.-6,3.-6,4.-6\n,\n,.8,.7\n"
    if card == "CBEAM":
        prop = (
            "PBEAM,1,1,4.-3,2.-6,3.-6,,4.-6\n,\n,YES,1.,4.-3,2.-6,3.-6,,4.-6\n,.8,.7\n"
        )
    force, moment = rng.normal(size=(2, 3)) * 1000.0
    ends = []
    for cut in (False, True):
        text = f"SOL 101\nCEND\nSPC=1\nLOAD=1\nDISP=ALL\nBEGIN BULK\n{prop}"
        text += "MAT1,1,7.+10,,.3\nSPC1,1,123456,1\n" + _grid(1, 0 * x) + _grid(3, x)
        text += _grid(2, at * x) if cut else ""
        pairs = [(1, 2), (2, 3)] if cut else [(1, 3)]
        for e, (a, b) in enumerate(pairs, start=1):
            text += f"{card},{e},1,{a},{b},{v[0]:.5f},{v[1]:.5f},{v[2]:.5f}\n"
            p = [100.0, 100.0 + 200.0 * at, 300.0]
            p = p[e - 1 : e + 1] if cut else [100.0, 300.0]
            text += f"PLOAD1,1,{e},FY,FR,0.,{p[0]:.5f},1.,{p[1]:.5f}\n"
        text += "FORCE,1,3,,1.,{:.3f},{:.3f},{:.3f}\n".format(*force)
        text += "MOMENT,1,3,,1.,{:.3f},{:.3f},{:.3f}\nENDDATA\n".format(*moment)
        path = tmp_path_factory.mktemp("cut") / "a.bdf"
        path.write_text(text)
        with h5py.File(run_deck(fem.read_deck(path), path.with_suffix(".h5"))) as file:
            ends.append(file["static/1/displacement"][-1])
    for part in (slice(0, 3), slice(3, 6)):
        scale = np.abs(ends[0][part]).max()
        assert np.abs(ends[0][part] - ends[1][part]).max() < 2e-6 * scale


def _grid(n: int, x: np.ndarray) -> str:
    return f"GRID*   {n:16d}{'':16}{x[0]:16.9E}{x[1]:16.9E}\n*       {x[2]:16.9E}\n"


@QUIET
@given(st.floats(0.1, 0.9), st.floats(0.1, 0.9), st.booleans(), st.integers(0, 2**31))
def test_a_plate_may_be_cut_anywhere(tmp_path_factory, s, t, triangles, seed):
    """Constant membrane strain, curvature and twist: the same forces at the corners.

    A rectangle is cut into four quadrilaterals about a random point, or these into
    eight triangles; the corners are moved by the exact field, cuts on the edges too.
    """
    turn = Rotation.random(random_state=seed).as_matrix()
    rng = np.random.default_rng(seed)
    strain, curvature = rng.normal(size=(2, 3)) * [[1e-3], [1e-2]]
    size = np.array([2.0, 1.5])
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]) * size
    edge = np.array([[s, 0], [1, t], [t, 1], [0, s]]) * size
    inner = np.array([[0.3 + 0.4 * s, 0.3 + 0.4 * t]]) * size
    xy = np.concatenate([corners, edge, inner])
    quads = [(0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3)]
    if triangles:
        cells = [c for q in quads for c in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
    else:
        cells = quads
    energies = []
    for points, parts in ((corners, [(0, 1, 2, 3)]), (xy, cells)):
        field = _field(points, strain, curvature)
        moved = np.concatenate([field[:, :3] @ turn.T, field[:, 3:] @ turn.T], axis=1)
        text = "SOL 101\nCEND\nSPC=1\nLOAD=1\nESE=ALL\nSTRESS=ALL\nBEGIN BULK\n"
        text += "PARAM,K6ROT,0.\nPSHELL,1,1,.02,1,,1\nMAT1,1,7.+10,,.3\n"
        for n, p in enumerate(points, start=1):
            text += _grid(n, turn @ np.array([*p, 0.0]))
            if n == 9:  # the inner point is free and must find its place
                continue
            text += f"SPC1,1,123456,{n}\n"
            for c, value in enumerate(moved[n - 1], start=1):
                text += f"SPCD*   {1:16d}{n:16d}{c:16d}{value:16.9E}\n"
        for e, cell in enumerate(parts, start=1):
            card = "CQUAD4" if len(cell) == 4 else "CTRIA3"
            text += f"{card},{e},1," + ",".join(str(n + 1) for n in cell) + "\n"
        path = tmp_path_factory.mktemp("plate") / "a.bdf"
        path.write_text(text + "ENDDATA\n")
        with h5py.File(run_deck(fem.read_deck(path), path.with_suffix(".h5"))) as file:
            groups = file["static/1/strain_energy"].values()
            energies.append(sum(group["value"][:].sum() for group in groups))
            stress = np.concatenate(
                [
                    group["value"][:].reshape(-1, 2, 8)
                    for group in file["static/1/element_stress"].values()
                ]
            )
            # Von Mises of both fibres is the same everywhere, in whatever axes.
            mises = stress[:, :, 7]
            assert np.ptp(mises, axis=0).max() < 1e-5 * mises.max()
    assert energies[1] == pytest.approx(energies[0], rel=1e-6)


def _field(xy: np.ndarray, strain: np.ndarray, curvature: np.ndarray) -> np.ndarray:
    """(n, 6) motion with constant strains and curvatures of a plate in x-y."""
    x, y = xy.T
    exx, eyy, exy = strain
    kxx, kyy, kxy = curvature
    w = 0.5 * (kxx * x * x + kyy * y * y + kxy * x * y)
    slope_x, slope_y = kxx * x + 0.5 * kxy * y, kyy * y + 0.5 * kxy * x
    zero = np.zeros_like(x)
    return np.stack(
        [exx * x + 0.5 * exy * y, eyy * y + 0.5 * exy * x, w, slope_y, -slope_x, zero],
        axis=1,
    )
