"""Plates, shells and shear panels, with their properties."""

from dataclasses import replace

from fem.deck.cards import conversions, finish, laminates
from fem.deck.records.card import Card, Element, Op2, Result, Topology

_GROUP = "Shells, panels"
_MATERIAL = "MAT1|MAT2|MAT8"

QUAD = Topology(
    kind="surface",
    grids=("g1", "g2", "g3", "g4"),
    corners=4,
    edges=((0, 1), (1, 2), (2, 3), (3, 0)),
    faces=((0, 1, 2, 3),),
)
TRIA = Topology(
    kind="surface",
    grids=("g1", "g2", "g3"),
    corners=3,
    edges=((0, 1), (1, 2), (2, 0)),
    faces=((0, 1, 2),),
)

# With mid-sides.
QUAD8 = replace(QUAD, grids=tuple(f"g{k}" for k in range(1, 9)), cells={8: 23})
TRIA6 = replace(TRIA, grids=tuple(f"g{k}" for k in range(1, 7)), cells={6: 22})

SHELL_FORCE = ("fx", "fy", "fxy", "mx", "my", "mxy", "tx", "ty")
_DERIVED = ("angle", "major", "minor")
# At one fibre.
SHELL_STRESS = ("fibre", "oxx", "oyy", "txy", *_DERIVED, "von_mises")
SHELL_STRAIN = ("fibre", "exx", "eyy", "exy", *_DERIVED, "von_mises")
# Of one ply.
PLY_STRESS = ("o11", "o22", "t12", "t1z", "t2z", *_DERIVED, "max_shear")
PLY_STRAIN = ("e11", "e22", "e12", "e1z", "e2z", *_DERIVED, "max_shear")
PLY_FAILURE = ("ply_index", "bond_index")
PANEL_FORCE = (
    *("f41", "f21", "f12", "f32", "f23", "f43", "f34", "f14"),
    *("kick1", "shear12", "kick2", "shear23", "kick3", "shear34", "kick4", "shear41"),
)
PANEL_STRESS = ("max_shear", "avg_shear")


def at_fibres(columns: tuple[str, ...]) -> tuple[str, ...]:
    """Columns at the lower and the upper fibre."""
    return tuple(f"{name}_{fibre}" for fibre in (1, 2) for name in columns)


def of_plies(columns: tuple[str, ...], plies: int) -> tuple[str, ...]:
    """Columns of plies, ply k from the bottom with the suffix `_p<k>`."""
    return tuple(f"{name}_p{k}" for k in range(1, plies + 1) for name in columns)


SHELL_RESULTS = (
    Result(kinds=("force",), columns=SHELL_FORCE, remark="center, CORNER: + corners"),
    Result(
        kinds=("stress", "strain"),
        columns=at_fibres(SHELL_STRESS),
        remark="both fibres (strains: surface and curvature, FIBER: both fibres)",
    ),
    Result(
        kinds=("stress", "strain"),
        columns=of_plies(PLY_STRESS, 1),
        table="_COMPOSITE",
        remark="each ply, suffix _p1, _p2, ... from the bottom",
    ),
    Result(
        kinds=("failure",),
        columns=(*of_plies(PLY_FAILURE, 1), "max_index"),
        table="_COMPOSITE",
        remark="each ply, with STRESS where PCOMP gives FT or SB",
    ),
)
# Those with mid-sides print their corners always.
CURVED_RESULTS = tuple(
    replace(result, remark=result.remark.replace("CORNER: + ", ""))
    for result in SHELL_RESULTS
)

_OWNER = "eid:i pid:i=eid>PSHELL|PCOMP g1:i>GRID g2:i>GRID g3:i>GRID "
_QUAD = (
    f"{_OWNER}g4:i>GRID theta:u=0. zoffs:f=0.[L] - tflag:i=0 "
    "t1:f=nan t2:f=nan t3:f=nan t4:f=nan"
)
_TRIA = f"{_OWNER}theta:u=0. zoffs:f=0.[L] - - tflag:i=0 t1:f=nan t2:f=nan t3:f=nan"


def _shell(
    name: str,
    fields: str,
    reader: str,
    topology: Topology,
    op2: Op2,
    results: tuple[Result, ...] = SHELL_RESULTS,
) -> Card:
    """Thicknesses at corners are NaN where the property gives them; mcid -1: none."""
    return Card(
        name=name,
        group=_GROUP,
        fields=fields,
        finish=finish.shell,
        more="mcid:i>CORD",
        ids="own",
        convert=conversions.corners,
        element=Element(
            reader=f"shells.{reader}", topology=topology, op2=op2, results=results
        ),
    )


def _op2(**types: int) -> Op2:
    """Numbers of the tables of an element, in the layout of plates."""
    return Op2(**types, force="plate", stress="plate")


RECORDS = (
    _shell(
        "CQUAD4", _QUAD, "quad4:read_cquad4", QUAD, _op2(type=33, corners=144, plies=95)
    ),
    _shell("CTRIA3", _TRIA, "tria3:read_ctria3", TRIA, _op2(type=74, plies=97)),
    # Their rotations about the normal are true freedoms.
    _shell(
        "CQUADR",
        _QUAD,
        "quad4:read_cquadr",
        QUAD,
        _op2(type=228, corners=82, plies=232),
    ),
    _shell("CTRIAR", _TRIA, "tria3:read_ctriar", TRIA, _op2(type=227, plies=233)),
    _shell(
        "CQUAD8",
        f"{_OWNER}g4:i>GRID g5:i=0>GRID? g6:i=0>GRID? g7:i=0>GRID? g8:i=0>GRID? "
        "t1:f=nan t2:f=nan t3:f=nan t4:f=nan theta:u=0. zoffs:f=0.[L] tflag:i=0",
        "curved_reader:read_cquad8",
        QUAD8,
        _op2(type=64, plies=96),
        CURVED_RESULTS,
    ),
    _shell(
        "CTRIA6",
        f"{_OWNER}g4:i=0>GRID? g5:i=0>GRID? g6:i=0>GRID? theta:u=0. zoffs:f=0.[L] "
        "t1:f=nan t2:f=nan t3:f=nan tflag:i=0",
        "curved_reader:read_ctria6",
        TRIA6,
        _op2(type=75, plies=98),
        CURVED_RESULTS,
    ),
    Card(
        name="CSHEAR",
        group=_GROUP,
        fields="eid:i pid:i=eid>PSHEAR g1:i>GRID g2:i>GRID g3:i>GRID g4:i>GRID",
        ids="own",
        element=Element(
            reader="shells.shear_panel:read_cshear",
            topology=QUAD,
            op2=Op2(type=4, force="simple", stress="panel"),
            results=(
                Result(kinds=("force",), columns=PANEL_FORCE),
                Result(kinds=("stress", "strain"), columns=PANEL_STRESS),
            ),
        ),
    ),
    Card(
        name="PSHELL",
        group=_GROUP,
        fields=f"pid:i mid1:i=0>{_MATERIAL} t:f=nan[L] mid2:i=0>{_MATERIAL} bk:f=1. "
        f"mid3:i=0>{_MATERIAL} tst:f=.833333 nsm:f=0.[M/L2] z1:f=nan[L] z2:f=nan[L] "
        f"mid4:i=0>{_MATERIAL}",
        ids="shell property",
        extent="area",
    ),
    Card(
        name="PCOMP",
        group=_GROUP,
        read=laminates.pcomp,
        more="pid:i z0:f[L] nsm:f[M/L2] sb:f[M/L] ft:s tref:f ge:f lam:s "
        f"mids:*>{_MATERIAL} ts:*[L] thetas:* souts:* plies:*",
        ids="shell property",
        extent="area",
    ),
    Card(
        name="PCOMPG",
        group=_GROUP,
        read=laminates.pcompg,
        table="PCOMP",
        extent="area",
    ),
    Card(
        name="PCOMP1", group=_GROUP, read=laminates.pcomp1, table="PCOMP", extent="area"
    ),
    Card(
        name="PCOMP2", group=_GROUP, read=laminates.pcomp2, table="PCOMP", extent="area"
    ),
    Card(
        name="PSHEAR",
        group=_GROUP,
        fields="pid:i mid:i>MAT1 t:f[L] nsm:f=0.[M/L2] f1:f=0. f2:f=0.",
        ids="own",
        extent="area",
    ),
)
