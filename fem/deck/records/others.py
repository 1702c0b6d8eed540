"""Modes, and lines of plots."""

from fem.deck.cards import finish, from_pynastran
from fem.deck.records.card import Card, Element, Topology

_MODES = "Modes"

RECORDS = (
    Card(
        name="EIGRL",
        group=_MODES,
        fields="sid:i v1:f=nan[1] v2:f=nan[1] nd:i=0 msglvl:i=0 maxset:i=0 shfscl:f=0. "
        "norm:s=MASS",
        finish=finish.eigrl,
    ),
    Card(
        name="EIGR",
        group=_MODES,
        fields="sid:i method:s f1:f=nan f2:f=nan ne:i=0 nd:i=0 - - norm:s=MASS g:i=0 "
        "c:i=0",
        finish=finish.eigr,
        table="EIGRL",
    ),
    Card(
        name="EIGB",
        group=_MODES,
        fields="sid:i method:s=INV l1:f=nan l2:f=nan nep:i=0 ndp:i=0 ndn:i=0 - "
        "norm:s=MAX g:i=0 c:i=0",
    ),
    Card(
        name="TABDMP1",
        group=_MODES,
        extract=from_pynastran.tabdmp1,
        more="tid:i type:s fs:*[1] gs:*",
    ),
    Card(
        name="PLOTEL",
        group="Other",
        fields="eid:i g1:i>GRID g2:i>GRID -",
        element=Element(
            topology=Topology(
                kind="line", grids=("g1", "g2"), corners=2, edges=((0, 1),)
            )
        ),
    ),
)
