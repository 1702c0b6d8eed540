"""Connectors: axial bushings, gaps, general elements."""

from functools import partial

from fem.deck.cards import conversions, finish, general_element, welds
from fem.deck.records.card import Card, Element, Op2, Result, Topology
from fem.deck.records.lines import BAR_FORCE
from fem.deck.records.scalars import BUSH_FORCE

_GROUP = "Connectors"
_BETWEEN = Topology(kind="spring", grids=("ga", "gb"), corners=2, edges=((0, 1),))
AXIAL_FORCE = ("axial_force",)
AXIAL_STRESS = ("axial",)
WELD_FORCE = BAR_FORCE
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
    # ida and idb: properties (PROP) or elements (ELEM).
    Card(
        name="CFAST",
        group=_GROUP,
        fields="eid:i pid:i=eid>PFAST form:s ida:i idb:i gs:i=0>GRID? ga:i=0>GRID? "
        "gb:i=0>GRID? xs:f=nan[L] ys:f=nan[L] zs:f=nan[L]",
        finish=finish.fastener,
        ids="own",
        element=Element(
            reader="connectors.reader:read_cfast",
            results=(
                Result(
                    kinds=("force",),
                    columns=BUSH_FORCE,
                    remark="at the middle, axes of PFAST",
                ),
            ),
        ),
    ),
    Card(
        name="PFAST",
        group=_GROUP,
        fields="pid:i d:f[L] mcid:i=-1>CORD mflag:i=0 kt1:f=0.[M] kt2:f=0.[M] "
        "kt3:f=0.[M] kr1:f=0.[ML2] kr2:f=0.[ML2] kr3:f=0.[ML2] mass:f=0.[M] ge:f=0.",
        finish=partial(finish.diameter, card="PFAST"),
        ids="own",
    ),
    # ida and idb by form: properties, elements; gas, gbs: corner grids (GRIDID).
    Card(
        name="CWELD",
        group=_GROUP,
        read=welds.cweld,
        more="eid:i pid:i>PWELD form:s ida:i idb:i gs:i>GRID? ga:i>GRID? gb:i>GRID? "
        "xs:f[L] ys:f[L] zs:f[L] gas:*>GRID? gbs:*>GRID? mcid:i>CORD",
        ids="own",
        element=Element(
            reader="connectors.reader:read_cweld",
            op2=Op2(type=117, force="simple"),
            results=(Result(kinds=("force",), columns=WELD_FORCE, remark="as CBAR"),),
        ),
    ),
    Card(
        name="PWELD",
        group=_GROUP,
        fields="pid:i mid:i>MAT1 d:f[L] - - mset:s=OFF - type:s= ldmin:f=.2 ldmax:f=5.",
        finish=partial(finish.diameter, card="PWELD"),
        ids="own",
    ),
)
