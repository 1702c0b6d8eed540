"""Grids, scalar points, coordinate systems."""

from functools import partial

from fem.deck.cards import conversions, finish, lists
from fem.deck.records.card import Card

_GROUP = "Points, frames"
_FORM = {
    1: "(cid:i g1:i g2:i g3:i)",
    2: "cid:i rid:i=0 a1:f=0. a2:f=0. a3:f=0. b1:f=0. b2:f=0. b3:f=0. c1:f=0. c2:f=0. "
    "c3:f=0.",
}

RECORDS = (
    Card(
        name="GRID",
        group=_GROUP,
        # ps: text of digits, '' if none
        fields="id:i cp:i=0>CORD x1:f=0. x2:f=0. x3:f=0. cd:i=0>CORD ps:c= seid:i=0",
        ids="point",
        convert=conversions.grid,
    ),
    Card(
        name="GRDSET",
        group=_GROUP,
        fields="- cp:i=0 - - - cd:i=0 ps:c= -",
        fills=("GRID", (2, 6, 7)),
    ),
    # Places without freedoms: planes of mirrors, seats of superelements.
    Card(
        name="POINT",
        group=_GROUP,
        fields="id:i cp:i=0>CORD x1:f=0. x2:f=0. x3:f=0.",
        convert=conversions.grid,
    ),
    Card(name="SPOINT", group=_GROUP, read=lists.spoint, more="id:i", ids="point"),
    # Freedoms of dynamic solutions: of control systems, with K2PP or TF.
    Card(name="EPOINT", group=_GROUP, read=lists.spoint, more="id:i", ids="point"),
    # Normal of the shells at a grid, where PARAM SNORM is above 0.
    Card(
        name="SNORM",
        group=_GROUP,
        fields="g:i>GRID cid:i=0>CORD n1:f=0.[1] n2:f=0.[1] n3:f=1.[1]",
    ),
    # Type R, C or S; form 1 by grids g1 g2 g3, form 2 by points a b c in frame rid.
    Card(
        name="CORD",
        group=_GROUP,
        more="cid:i type:s form:i rid:i g1:i g2:i g3:i a1:f a2:f a3:f b1:f b2:f b3:f "
        "c1:f c2:f c3:f",
        ids="own",
        convert=conversions.frame,
    ),
    *(
        Card(
            name=f"CORD{form}{kind}",
            group=_GROUP,
            fields=text,
            finish=partial(finish.frame, kind, form),
            table="CORD",
        )
        for form, text in _FORM.items()
        for kind in "RCS"
    ),
)
