"""Solids and their property.

nodes: (n,) corners, then mid-sides, 0 for those that are not there.
"""

from functools import partial

from fem.deck.cards import laminates, solids
from fem.deck.records.card import Card, Element, Op2, Result, Topology
from fem.deck.records.shells import of_plies

_GROUP = "Solids"
_COLUMNS = "eid:i pid:i>PSOLID|PCOMPS nodes:*>GRID?"
_PRINCIPAL = ("major", "mid", "minor", "von_mises")
SOLID_STRESS = ("oxx", "oyy", "ozz", "txy", "tyz", "txz", *_PRINCIPAL)
SOLID_STRAIN = ("exx", "eyy", "ezz", "exy", "eyz", "exz", *_PRINCIPAL)
RING_STRESS = (
    *("radial", "azimuthal", "axial", "shear"),
    *("major", "max_shear", "von_mises"),
)
# Of slices; the shear is that in their plane.
PLANE_STRESS = ("oxx", "oyy", "ozz", "shear", "von_mises")
# In the middle of plies (PCOMPS), in their axes.
LAYER_STRESS = ("o11", "o22", "o33", "t12", "t23", "t13", "von_mises")
LAYER_STRAIN = ("e11", "e22", "e33", "e12", "e23", "e13", "von_mises")
_LAYERS = Result(
    kinds=("stress", "strain"),
    columns=of_plies(LAYER_STRESS, 1),
    table="_COMPOSITE",
    remark="PCOMPS, one group per ply",
)
_RESULTS = (
    Result(
        kinds=("stress", "strain"),
        columns=SOLID_STRESS,
        remark="center, then corners (prefix c1_, c2_, ...)",
    ),
)

HEXA = Topology(
    kind="solid",
    grids=("nodes",),
    corners=8,
    edges=(
        *((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 5)),
        *((2, 6), (3, 7), (4, 5), (5, 6), (6, 7), (7, 4)),
    ),
    faces=(
        *((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4)),
        *((1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    ),
    cells={8: 12, 20: 25},
    order={20: (*range(12), 16, 17, 18, 19, 12, 13, 14, 15)},
)
PENTA = Topology(
    kind="solid",
    grids=("nodes",),
    corners=6,
    edges=(
        *((0, 1), (1, 2), (2, 0), (0, 3), (1, 4), (2, 5)),
        *((3, 4), (4, 5), (5, 3)),
    ),
    faces=((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    cells={6: 13, 15: 26},
    order={15: (*range(9), 12, 13, 14, 9, 10, 11)},
)
TETRA = Topology(
    kind="solid",
    grids=("nodes",),
    corners=4,
    edges=((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    faces=((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    triangles="opposite",
    cells={4: 10, 10: 24},
)
PYRAMID = Topology(
    kind="solid",
    grids=("nodes",),
    corners=5,
    edges=((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    faces=((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    triangles="base",
    cells={5: 14, 13: 27},
)


def _op2(type: int, plies: int = 0) -> Op2:
    return Op2(type=type, plies=plies, stress="solid")


def _solid(
    name: str,
    topology: Topology,
    reader: str,
    op2: Op2,
    results: tuple[Result, ...] = _RESULTS,
) -> Card:
    most = topology.corners + len(topology.edges)
    return Card(
        name=name,
        group=_GROUP,
        read=partial(solids.solid, most=most, corners=topology.corners),
        more=_COLUMNS,
        ids="own",
        element=Element(
            reader=reader,
            topology=topology,
            op2=op2,
            results=results,
        ),
    )


RECORDS = (
    _solid(
        "CHEXA",
        HEXA,
        "solids.hexa:read_chexa",
        _op2(67, plies=269),
        (*_RESULTS, _LAYERS),
    ),
    _solid("CPENTA", PENTA, "solids.penta:read_cpenta", _op2(68)),
    _solid("CTETRA", TETRA, "solids.tetra:read_ctetra", _op2(39)),
    _solid("CPYRAM", PYRAMID, "solids.pyramid:read_cpyram", _op2(255)),
    # Rings about the z axis of the basic frame; g2, g4, g6 are mid-sides.
    Card(
        name="CTRIAX6",
        group=_GROUP,
        fields="eid:i mid:i>MAT1|MAT3 g1:i>GRID g2:i=0>GRID? g3:i>GRID g4:i=0>GRID? "
        "g5:i>GRID g6:i=0>GRID? th:f=0.[1]",
        ids="own",
        element=Element(
            reader="solids.ring:read_ctriax6",
            op2=Op2(type=53, stress="ring"),
            results=(
                Result(
                    kinds=("stress", "strain"),
                    columns=RING_STRESS,
                    remark="center, then corners (prefix c1_, c2_, c3_)",
                ),
            ),
        ),
    ),
    *(
        Card(
            name=f"CPLST{kind}{count}",
            group=_GROUP,
            read=partial(solids.plane, count=count),
            more="eid:i pid:i>PPLANE nodes:*>GRID",
            ids="own",
            element=Element(
                reader="solids.plane_reader:read_" + f"cplst{kind}{count}".lower(),
                results=(
                    Result(
                        kinds=("stress", "strain"),
                        columns=PLANE_STRESS,
                        remark="center; of 4 and 6 grids corners (prefix c1_, ...)",
                    ),
                ),
            ),
        )
        for kind in "NS"
        for count in (3, 4, 6, 8)
    ),
    Card(
        name="PPLANE",
        group=_GROUP,
        fields="pid:i mid:i>MAT1 t:f=1.[L] nsm:f=0.[M/L2] foropt:i=0",
        ids="solid property",
        extent="area",
    ),
    # cordm -1: element, 0: basic
    Card(
        name="PSOLID",
        group=_GROUP,
        fields="pid:i mid:i>MAT1|MAT9 cordm:i=0>CORD integ:s= stress:s= isop:s= "
        "fctn:s=SMECH",
        ids="solid property",
    ),
    # psdir: directions of plies at 0 degrees and of the stack, in CORDM
    Card(
        name="PCOMPS",
        group=_GROUP,
        read=laminates.pcomps,
        more="pid:i cordm:i>CORD psdir:c tref:f ge:f mids:*>MAT1|MAT9 ts:*[L] thetas:* "
        "plies:*",
        ids="solid property",
    ),
)
