"""CFAST and CWELD: rigid motion, patches, bars, formats, refusals."""

import numpy as np
import pytest

from fem.elements.registry import element_notices
from fem.errors import InputError
from fem.model.weight import rigid_modes

FORMATS = {
    "partpat": "CWELD,90,9,,PARTPAT,,,,,+\n+,1,2,,,,,,,+\n+,.9,.8,.1",
    "elpat": "CWELD,90,9,80,ELPAT,,,,,+\n+,11,21",
    "elemid": "CWELD,90,9,,ELEMID,81,82,,,+\n+,11,21",
    "gridid": "CWELD,90,9,80,GRIDID,,,QQ,,+\n+,1,2,5,4,,,,,+\n+,11,12,15,14",
    "triangle": "CWELD,90,9,80,GRIDID,,,QT,,+\n+,1,2,5,4,,,,,+\n+,11,12,15",
    "align": "CWELD,90,9,,ALIGN,5,15",
    "to a grid": "CWELD,90,9,15,ELEMID,,,,,+\n+,14",
    "prop": "CFAST,90,8,PROP,1,2,80",
    "elem": "CFAST,90,8,ELEM,11,21,,81,82",
    "place": "CFAST,90,8,PROP,1,2,,,,+\n+,1.,1.,.1",
}


def plates(gap: float = 0.2, tilt: float = 0.0) -> str:
    """Two plates of 2 by 2 elements above each other, the upper one tilted."""
    lines = ["MAT1,1,70.,,.3", "PSHELL,1,1,.1,1", "PSHELL,2,1,.3,1"]
    for part, z in ((0, 0.0), (1, gap)):
        for k in range(9):
            x, y = k % 3, k // 3
            height = z + tilt * x * part
            lines.append(f"GRID,{10 * part + k + 1},,{x}.,{y}.,{height}")
        for k, (i, j) in enumerate(((0, 0), (1, 0), (0, 1), (1, 1))):
            g = 10 * part + 1 + i + 3 * j
            e = 10 * part + 11 + k
            lines.append(f"CQUAD4,{e},{part + 1},{g},{g + 1},{g + 4},{g + 3}")
    lines += [
        f"GRID,80,,.8,.7,{0.4 * gap}",
        "GRID,81,,.8,.7,0.",
        f"GRID,82,,.8,.7,{gap}",
    ]
    lines.append("PWELD,9,1,.3\nPFAST,8,.3,,,5.,2.,2.,.1,+\n+,.2,.2,.5,.02")
    return "\n".join(lines) + "\n"


def connectors(made):
    return [b for b in made.blocks if b.card in ("CWELD", "CFAST")]


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("tilt", [0.0, 0.3])
def test_rigid_motion_costs_no_force(model, name, tilt):
    made = model(plates(tilt=tilt) + FORMATS[name])
    (block,) = connectors(made)
    body = rigid_modes(made.points, np.zeros(3))
    k = block.stiffness()[0]
    assert np.abs(k @ body[block.dof[0]]).max() < 1e-11 * np.abs(k).max()
    assert np.linalg.matrix_rank(k, tol=1e-9 * np.abs(k).max()) == 6
    (notice,) = [
        n for n in element_notices(made.deck, made.points) if "linear springs" in n
    ]
    assert f"{block.card} (1)" in notice


def test_a_weld_between_grids_is_a_bar_of_its_section(model):
    """Of constant strain: the bar's shear relief gives L / G A in all."""
    radius, length = 0.15, 0.2
    inertia = 0.25 * np.pi * radius**4
    bending = (70.0 / 2.6) * np.pi * radius**2 * length**2 / (12.0 * 70.0 * inertia)
    k = 1.0 / (1.0 - bending)
    made = model(
        plates() + FORMATS["align"] + "\nCBAR,91,7,5,15,1.,0.,0.\n"
        f"PBAR*,7,1,{np.pi * radius**2:.9f},{inertia:.9e},+\n"
        f"*,{inertia:.9e},{2.0 * inertia:.9e},,,+\n*,,,,,+\n*,,,,,+\n*,{k:.9f},{k:.9f}"
    )
    (weld,) = connectors(made)
    (bar,) = [b for b in made.blocks if b.card == "CBAR"]
    area = np.pi * radius**2
    scale = np.abs(bar.stiffness()).max()
    np.testing.assert_allclose(
        weld.stiffness(), bar.stiffness(), atol=1e-8 * scale, rtol=1e-7
    )
    pulled = np.zeros(12)
    pulled[[6, 8, 9]] = 0.01, 0.02, 0.03
    force = {b.card: b.forces().matrix[0] @ pulled for b in (weld, bar)}
    assert force["CWELD"][6] == pytest.approx(70.0 * area / length * 0.02)
    np.testing.assert_allclose(force["CWELD"], force["CBAR"], rtol=1e-7, atol=1e-9)
    assert weld.mass(coupled=False) is None


@pytest.mark.parametrize("name", ["elpat", "elem"])
def test_one_point_pierces_tilted_surfaces_in_the_middle(model, name):
    """z = 0 and z = h + 0.3 x, the two ways over from P in closed form."""
    gap, tilt = 0.2, 0.3
    text = plates(gap, tilt) + FORMATS[name].replace(",,81,82", ",80")
    made = model(text)
    (block,) = connectors(made)
    unit = np.array([-tilt, 0.0, 1.0]) / np.hypot(1.0, tilt)
    start = np.array([0.8, 0.7, 0.4 * gap])

    def upper(p):
        return p + ((np.array([0.0, 0.0, gap]) - p) @ unit) * unit

    def lower(p):
        return p * [1.0, 1.0, 0.0]

    expected = (
        0.5 * (lower(start) + lower(upper(start))),
        0.5 * (upper(start) + upper(lower(start))),
    )
    assert block.length[0] == pytest.approx(np.linalg.norm(expected[1] - expected[0]))
    if name == "elpat":
        # Motion u = x of the grids: the feet's translations are where they stand.
        motion = np.zeros(made.points.size)
        motion.reshape(-1, 6)[:, :3] = made.points.xyz
        feet = block.feet[0] @ motion[block.dof[0]]
        np.testing.assert_allclose(feet, np.concatenate(expected), atol=1e-9)


@pytest.mark.parametrize(
    ("mcid", "y"), [("", [1.0, 0.0, 0.0]), ("0", [0.0, 1.0, 0.0]), ("5", [-1, 0, 0])]
)
def test_axes_of_a_weld(model, mcid, y):
    """Near the first of the basic axes across, or near that of MCID."""
    frame = "CORD2R,5,,0.,0.,0.,0.,0.,1.,+\n+,0.,1.,0.\n"
    card = FORMATS["elpat"].replace("ELPAT,,,,,", f"ELPAT,,,,{mcid},")
    made = model(frame + plates() + card)
    (block,) = connectors(made)
    upper = np.zeros((made.points.size, 3))  # the upper plate moves as one
    for j in range(3):
        upper[6 * made.points.rows(np.arange(11, 20)) + j, j] = 1.0
    np.testing.assert_allclose(
        block.motion[0, :3] @ upper[block.dof[0]],
        np.array([(0, 0, 1), y, np.cross((0, 0, 1), y)]),
        atol=1e-12,
    )


def test_a_system_along_a_weld_gives_no_axes(model):
    card = FORMATS["elpat"].replace("ELPAT,,,,,", "ELPAT,,,,5,")
    frame = "CORD2R,5,,0.,0.,0.,1.,0.,0.,+\n+,0.,1.,0.\n"
    with pytest.raises(InputError, match=r"CWELD 90.*y axis of MCID 5 lies along"):
        model(frame.replace("+,0.,1.,0.", "+,0.,-1.,0.") + plates() + card)


@pytest.mark.parametrize("name", ["elemid", "elem", "partpat", "place"])
def test_feet_follow_linear_fields(model, name):
    """Patch test: both plates in one linear field; the spring sees its gradient."""
    made = model(plates() + FORMATS[name])
    (block,) = connectors(made)
    gradient = np.array([[0.1, 0.4, 0.3], [-0.2, 0.5, 0.6], [0.7, -0.8, 0.0]])
    field = made.points.xyz @ gradient.T
    motion = np.zeros(made.points.size)
    motion.reshape(-1, 6)[:, :3] = field
    shift = block.feet[0] @ motion[block.dof[0]]
    place = np.array([0.9, 0.8]) if name == "partpat" else np.array([0.8, 0.7])
    place = np.array([1.0, 1.0]) if name == "place" else place
    for k, z in ((0, 0.0), (3, 0.2)):
        np.testing.assert_allclose(shift[k : k + 3], gradient @ [*place, z], atol=1e-12)
    # Both feet turn alike: w,y; -w,x; (v,x - u,y)/2. The rest is translation.
    turn = np.array([-0.8, -0.7, 0.5 * (-0.2 - 0.4)])
    relative = gradient @ [0.0, 0.0, 0.2] - np.cross(turn, [0.0, 0.0, 0.2])
    expected = np.zeros(6)
    axes = block.motion[0]
    expected[:3] = relative @ _axes(block)
    np.testing.assert_allclose(axes @ motion[block.dof[0]], expected, atol=1e-12)


def _axes(block):
    """R_BE from the motion that translations of foot B alone make."""
    upper = block.feet[0, 3:]
    return np.linalg.lstsq(upper.T, block.motion[0, :3].T, rcond=None)[0]


def test_grids_of_fasteners_follow_the_surface(model):
    """GA and GB, in turned frames, move as the shells do; a mass there, too."""
    text = plates() + FORMATS["elem"]
    text = text.replace("GRID,81,,.8,.7,0.", "GRID,81,,.8,.7,0.,5").replace(
        "GRID,1,,0.,0.,0.0", "GRID,1,,0.,0.,0.0,5"
    )
    frame = "CORD2R,5,,0.,0.,0.,1.,1.,1.,+\n+,1.,0.,0.\nCONM2,99,81,,3.\n"
    made = model(f"{frame}{text}")
    dependent = {made.points.label(int(dof)) for dof in made.elimination.m}
    assert dependent == {
        f"grid {g} {c}{i}" for g in (81, 82) for c in "TR" for i in (1, 2, 3)
    }
    body = rigid_modes(made.points, np.zeros(3))
    m = made.elimination
    np.testing.assert_allclose(m.dependence @ body, body[m.m], atol=1e-12)


@pytest.mark.parametrize(
    ("card", "message"),
    [
        ("CFAST,90,8,PROP,1,7,80", "property 7 of side B"),
        ("CFAST,90,8,ELEM,11,99,80", "element 99 of side B"),
        ("CFAST,90,8,PROP,1,2", "no place, expected GS"),
        ("CFAST,90,8,PROP,1,2,,,,+\n+,2.5,1.,0.", "0.5 beside the surface"),
        ("CFAST,90,8,FACE,1,2,80", "expected PROP or ELEM"),
        ("CWELD,90,9,80,PATCH,,,,,+\n+,1,2", "expected one of PARTPAT"),
        ("CWELD,90,9,80,GRIDID,,,QQ,,+\n+,1,2", "expected three corner grids"),
        ("CWELD,90,7,,ALIGN,5,15", "PWELD 7 is not defined"),
        ("PFAST,7,-.3", "PFAST 7 field D: found -0.3, expected a positive number"),
        ("PWELD,7,1,0.", "PWELD 7 field D: found 0, expected a positive number"),
    ],
)
def test_what_a_connector_lacks_is_said(model, card, message):
    with pytest.raises(InputError, match=message):
        model(plates() + card)


def test_a_spot_weld_is_as_long_as_the_sheets_are_thick(model):
    """And others at least LDMIN and at most LDMAX diameters."""
    stiff = {}
    for name, extra in {
        "spot": ",,,OFF,,SPOT",
        "plain": "",
        "short": ",,,,,,+\n+,.9",
        "long": ",,,,,,+\n+,.1,.4",
    }.items():
        text = plates() + FORMATS["elemid"]
        made = model(text.replace("PWELD,9,1,.3", f"PWELD,9,1,.3{extra}"))
        stiff[name] = connectors(made)[0].k[0, 0]
    ea = 70.0 * np.pi * 0.15**2
    for name, length in {
        "spot": 0.2,
        "plain": 0.2,
        "short": 0.27,
        "long": 0.12,
    }.items():
        assert stiff[name] == pytest.approx(ea / length), name
