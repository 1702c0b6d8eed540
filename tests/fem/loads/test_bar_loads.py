"""PLOAD1 against beam theory: one element gives what many give."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve

from fem.errors import InputError
from fem.loads import static_load

E, A, I1, I2, J, K = 7e10, 0.02, 3e-5, 2e-5, 4e-5, 0.8
G = E / 2.6
L = 2.0


def deflections(model, bulk: str, fixed: tuple[int, ...]) -> tuple[np.ndarray, object]:
    """Displacements (g, 6) of a model with these grids clamped under load set 1."""
    m = model(bulk)
    load = static_load(m.deck, m.points, 1)
    held = m.points.dof(np.array(fixed)[:, None], np.arange(1, 7)).ravel()
    free = np.setdiff1d(np.arange(m.points.size), held)
    u = np.zeros(m.points.size)
    k = m.matrices.stiffness.tocsc()
    u[free] = spsolve(k[free][:, free], load[free])
    return u.reshape(-1, 6), m


def beam(n: int, element: str = "CBAR", pins: str = "", axis=(1.0, 0.0, 0.0)) -> str:
    """A beam of n elements from grid 1 to grid n + 1."""
    card = "PBAR,1,1,{},{},{},{}\n,\n,{},{}\n"
    bulk = card.format(A, I1, I2, J, K, K)
    if element == "CBEAM":
        bulk = f"PBEAM,1,1,{A},{I1},{I2},0.,{J}\n,\n,NO,1.,{A},{I1},{I2},0.,{J}\n"
        bulk += f",{K},{K}\n"
    bulk += f"MAT1,1,{E},,.3\n".replace("70000000000.0", "7.+10")
    x = np.linspace(0, L, n + 1)[:, None] * np.asarray(axis)
    bulk += "".join(
        f"GRID,{k + 1},,{p[0]:.6f},{p[1]:.6f},{p[2]:.6f}\n" for k, p in enumerate(x)
    )
    for k in range(n):
        bulk += f"{element},{k + 1},1,{k + 1},{k + 2},0.,1.,0.\n{pins}"
    return bulk


@pytest.mark.parametrize("element", ["CBAR", "CBEAM"])
@pytest.mark.parametrize(("kind", "i", "sign"), [("FYE", I1, 1), ("FZ", I2, 1)])
def test_cantilever_under_uniform_load(model, element, kind, i, sign):
    bulk = beam(1, element) + f"PLOAD1,1,1,{kind},FR,0.,100.,1.,100.\n"
    u, _ = deflections(model, bulk, (1,))
    component = {"Y": 1, "Z": 2}[kind[1]]
    expected = 100 * L**4 / (8 * E * i) + 100 * L**2 / (2 * K * G * A)
    assert u[1, component] == pytest.approx(expected, rel=1e-9)


LOADS = [
    ("FYE", "FR", 0.2, 50.0, 0.7, 90.0),
    ("FZE", "LE", 0.5, -50.0, 1.9, 10.0),
    ("FX", "FR", 0.0, 5.0, 1.0, 9.0),
    ("MZE", "FR", 0.1, 5.0, 0.9, 9.0),
    ("MYE", "FR", 0.3, 7.0, None, None),
    ("MXE", "FR", 0.25, 7.0, 0.5, 3.0),
    ("FY", "FR", 0.3, 70.0, None, None),
]


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("element", ["CBAR", "CBEAM"])
def test_one_element_gives_the_end_deflections_of_forty(model, load, element):
    """Uniform Timoshenko beams: equivalent loads make one element exact."""
    kind, scale, x1, p1, x2, p2 = load
    one, n = beam(1, element), 40
    tail = "" if x2 is None else f",{x2},{p2}"
    u, _ = deflections(model, f"{one}PLOAD1,1,1,{kind},{scale},{x1},{p1}{tail}\n", (1,))
    factor = L if scale == "LE" else 1.0
    many = beam(n, element)
    edges = np.linspace(0, 1, n + 1)
    for k, (a, b) in enumerate(pairwise(edges)):
        if x2 is None:
            if a <= x1 < b:
                many += f"PLOAD1,1,{k + 1},{kind},FR,{(x1 - a) * n:.9f},{p1}\n"
            continue
        s, e = max(a, x1 / factor), min(b, x2 / factor)
        if e > s:
            at = [
                p1 + (p2 - p1) * (q - x1 / factor) / ((x2 - x1) / factor)
                for q in (s, e)
            ]
            many += (
                f"PLOAD1,1,{k + 1},{kind},FR,{(s - a) * n:.9f},{at[0]:.9f},"
                f"{(e - a) * n:.9f},{at[1]:.9f}\n"
            )
    v, _ = deflections(model, many, (1,))
    np.testing.assert_allclose(u[-1], v[-1], rtol=1e-6, atol=1e-6 * abs(v).max())


def test_resultant_of_a_projected_load(loaded):
    """A load per projected length on a bar at 60 degrees."""
    axis = (0.5, np.sqrt(0.75), 0.0)
    bulk = beam(1, axis=axis).replace(",0.,1.,0.\n", ",0.,0.,1.\n")
    result = loaded(bulk + "PLOAD1,1,1,FY,FRPR,0.,10.,1.,10.\n").resultant()
    np.testing.assert_allclose(result[:3], [0, 10 * L * 0.5, 0], atol=1e-5)
    middle = 0.5 * L * 0.5
    assert result[5] == pytest.approx(10 * L * 0.5 * middle, rel=1e-5)


def test_offsets_carry_the_load_to_the_grids_without_changing_it(loaded):
    offset = ",,,0.,.1,.2,0.,.3,.4\n"
    bulk = beam(1, pins=offset) + "PLOAD1,1,1,FY,FR,0.,10.,1.,10.\n"
    result = loaded(bulk).resultant()
    length = L * 1.0
    true = np.hypot(np.hypot(L, 0.2), 0.2)
    total = 10 * true
    # The resultant acts in the middle of the offset line.
    np.testing.assert_allclose(
        result, [0, total, 0, -0.3 * total, 0, length / 2 * total], atol=1e-9
    )


def test_pinned_end_takes_no_moment(loaded):
    bulk = beam(1, pins=",,5\n") + "PLOAD1,1,1,FZ,FR,0.,10.,1.,10.\n"
    result = loaded(bulk)
    assert result.at(2)[4] == 0.0
    phi = 12 * E * I2 / (K * G * A * L**2)
    # Propped cantilever: 3/8 of the load without shear flexibility.
    expected = 10 * L * (0.5 - 1 / (2 * (4 + phi)))
    assert result.at(2)[2] == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(result.resultant()[2], 10 * L)


@pytest.mark.parametrize(
    ("card", "message"),
    [
        ("PLOAD1,1,1,FQ,FR,0.,1.", "TYPE FQ, expected one of FX"),
        ("PLOAD1,1,1,FX,XX,0.,1.", "SCALE XX"),
        ("PLOAD1,1,1,FX,FR,.5,1.,.2,1.", "must ascend"),
        ("PLOAD1,1,1,FX,LE,.5,1.,2.2,1.", "lie on the element"),
    ],
)
def test_impossible_loads_are_named(loaded, card, message):
    with pytest.raises(InputError, match=message):
        loaded(beam(1) + card)
