"""Springs, dampers and bushings.

c is 0 for a scalar point, g is 0 for the ground; `card` says how the element was
spelled.
"""

from functools import partial

from fem.deck.cards import conversions, finish, from_pynastran, lists
from fem.deck.records.card import Card, Element, Op2, Result, Topology

_GROUP = "Springs, dampers"
_ENDS = "g1:i=0>POINT c1:i=0 g2:i=0>POINT c2:i=0"
_SCALAR = "g1:i=0>POINT g2:i=0>POINT"

_BETWEEN = Topology(kind="spring", grids=("g1", "g2"), corners=2, edges=((0, 1),))
SPRING = ("spring_force", "spring_stress", "spring_strain")
DAMPER = ("damper_force",)
BUSH_FORCE = ("fx", "fy", "fz", "mx", "my", "mz")
BUSH_STRESS = ("tx", "ty", "tz", "rx", "ry", "rz")


def _spring(number: int, reader: str = "") -> Element:
    kinds = ("force", "stress", "strain")
    return Element(
        reader=reader,
        topology=_BETWEEN,
        op2=Op2(type=number, force="simple", stress="simple"),
        results=(Result(kinds=kinds, columns=SPRING, remark="one column each"),),
    )


def _damper(number: int, reader: str = "") -> Element:
    return Element(
        reader=reader,
        topology=_BETWEEN,
        op2=Op2(type=number, force="simple"),
        results=(Result(kinds=("force",), columns=DAMPER, remark="transients"),),
    )


RECORDS = (
    Card(
        name="CELAS1",
        group=_GROUP,
        fields=f"eid:i pid:i=eid>PELAS {_ENDS}",
        more="card:s",
        ids="own",
        element=_spring(11, "scalars.scalar:read_celas1"),
    ),
    Card(
        name="CELAS2",
        group=_GROUP,
        fields="eid:i k:f g1:i=0>POINT c1:i=0 g2:i=0>POINT c2:i=0 ge:f=0. s:f=0.",
        more="card:s",
        ids="own",
        convert=partial(conversions.direct, column="k"),
        element=_spring(12, "scalars.scalar:read_celas2"),
    ),
    Card(
        name="CELAS3",
        group=_GROUP,
        fields=f"(eid:i pid:i=eid>PELAS {_SCALAR})",
        finish=finish.scalar,
        table="CELAS1",
        element=_spring(13),
    ),
    Card(
        name="CELAS4",
        group=_GROUP,
        fields=f"(eid:i k:f {_SCALAR})",
        finish=finish.celas4,
        table="CELAS2",
        element=_spring(14),
    ),
    Card(
        name="PELAS",
        group=_GROUP,
        fields="(pid:i k:f=0. ge:f=0. s:f=0.)",
        ids="own",
        convert=partial(conversions.by_use, column="k", user="CELAS1"),
    ),
    Card(
        name="CDAMP1",
        group=_GROUP,
        fields=f"eid:i pid:i=eid>PDAMP {_ENDS}",
        more="card:s",
        ids="own",
        element=_damper(20, "scalars.scalar:read_cdamp"),
    ),
    Card(
        name="CDAMP2",
        group=_GROUP,
        fields=f"eid:i b:f {_ENDS}",
        more="card:s",
        ids="own",
        convert=partial(conversions.direct, column="b"),
        element=_damper(21),
    ),
    Card(
        name="CDAMP3",
        group=_GROUP,
        fields=f"(eid:i pid:i=eid>PDAMP {_SCALAR})",
        finish=finish.scalar,
        table="CDAMP1",
        element=_damper(22),
    ),
    Card(
        name="CDAMP4",
        group=_GROUP,
        fields=f"(eid:i b:f {_SCALAR})",
        finish=finish.scalar,
        table="CDAMP2",
        element=_damper(23),
    ),
    Card(
        name="PDAMP",
        group=_GROUP,
        fields="(pid:i b:f=0.)",
        ids="own",
        convert=partial(conversions.by_use, column="b", user="CDAMP1"),
    ),
    # cid and ocid -1: blank
    Card(
        name="CBUSH",
        group=_GROUP,
        fields="eid:i pid:i=eid>PBUSH ga:i>GRID gb:i=0>GRID? x1:u=nan x2:f=nan "
        "x3:f=nan cid:i=-1>CORD s:f=.5 ocid:i=-1>CORD s1:f=0.[L] s2:f=0.[L] s3:f=0.[L]",
        finish=finish.orientation,
        more="g0:i>GRID?",
        ids="own",
        element=Element(
            reader="scalars.bush:read_cbush",
            topology=Topology(
                kind="spring", grids=("ga", "gb"), corners=2, edges=((0, 1),)
            ),
            op2=Op2(type=102, force="simple", stress="simple"),
            results=(
                Result(
                    kinds=("force",),
                    columns=BUSH_FORCE,
                    remark="with dashpots in transients",
                ),
                Result(
                    kinds=("stress", "strain"),
                    columns=BUSH_STRESS,
                    remark="by the coefficients RCV",
                ),
            ),
        ),
    ),
    # k, b, ge per component (6,), 0 where blank; k and b 'RIGID' is refused.
    # sa st ea et: stress and strain coefficients (RCV)
    Card(
        name="PBUSH",
        group=_GROUP,
        extract=from_pynastran.pbush,
        more="pid:i ks:* bs:* ges:* mass:f[M] sa:f st:f ea:f et:f",
        ids="own",
        convert=conversions.bush,
    ),
    # Tables of frequency, 0: none; ks, bs, k, b: factors of their units.
    Card(
        name="PBUSHT",
        group=_GROUP,
        read=lists.pbusht,
        more="pid:i ktables:* btables:* getables:* ks:* bs:*",
        ids="own",
        convert=conversions.bush,
    ),
    Card(
        name="PELAST",
        group=_GROUP,
        read=lists.pelast,
        more="pid:i ktable:i getable:i k:f",
        ids="own",
        convert=partial(conversions.by_use, column="k", user="CELAS1"),
    ),
    Card(
        name="PDAMPT",
        group=_GROUP,
        read=lists.pdampt,
        more="pid:i btable:i b:f",
        ids="own",
        convert=partial(conversions.by_use, column="b", user="CDAMP1"),
    ),
)
