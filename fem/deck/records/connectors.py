"""Connectors: axial bushings, gaps, general elements."""

from fem.deck import conversions
from fem.deck.cards import finish, general_element
from fem.deck.records.card import Card, Element, Result, Topology

_GROUP = "Connectors"
_BETWEEN = Topology(kind="spring", grids=("ga", "gb"), corners=2, edges=((0, 1),))
AXIAL_FORCE = ("axial_force",)
AXIAL_STRESS = ("axial",)
GAP_FORCE = ("fx", "sfy", "sfz", "u", "v", "w")

RECORDS = (
    # cid -1: blank
    Card(
        name="CBUSH1D",
        group=_GROUP,
        fields="eid:i pid:i=eid>PBUSH1D ga:i>GRID gb:i=0>GRID? cid:i=-1>CORD",
        ids="own",
        element=Element(
            reader="scalars.bush1d:read_cbush1d",
            topology=_BETWEEN,
            results=(
                Result(
                    kinds=("force",),
                    columns=AXIAL_FORCE,
                    remark="with the dashpot in transients",
                ),
                Result(
                    kinds=("stress", "strain"),
                    columns=AXIAL_STRESS,
                    remark="by SA and SE",
                ),
            ),
        ),
    ),
    # What follows SE describes nonlinear solutions.
    Card(
        name="PBUSH1D",
        group=_GROUP,
        fields="pid:i k:f=0.[M] c:f=0.[M] m:f=0.[M] - sa:f=0.[/L2] se:f=0.[/L]",
        ids="own",
    ),
    Card(
        name="CGAP",
        group=_GROUP,
        fields="eid:i pid:i=eid>PGAP ga:i>GRID gb:i>GRID x1:u=nan[1] x2:f=nan x3:f=nan "
        "cid:i=-1>CORD",
        finish=finish.orientation,
        more="g0:i>GRID?",
        ids="own",
        element=Element(
            reader="scalars.gap:read_cgap",
            topology=_BETWEEN,
            results=(
                Result(
                    kinds=("force",),
                    columns=GAP_FORCE,
                    remark="pressing force, shears, shortening, slips",
                ),
            ),
        ),
    ),
    Card(
        name="PGAP",
        group=_GROUP,
        fields="pid:i u0:f=0.[L] f0:f=0.[ML] ka:f=1.+8[M] kb:f=nan[M] kt:f=nan[M] "
        "mu1:f=0. mu2:f=0. tmax:f=0.[L] mar:f=100. trmin:f=.001",
        ids="own",
    ),
    # UI, then UD; k: (m, m) stiffness of UI, s: (m, n), or (0, 0) where not given.
    Card(
        name="GENEL",
        group=_GROUP,
        read=general_element.genel,
        more="eid:i grids:*>POINT comps:* k:* s:*",
        ids="own",
        convert=conversions.general,
        element=Element(reader="scalars.general:read_genel"),
    ),
)
