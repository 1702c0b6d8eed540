"""Modes, lines of plots, monitor points."""

from fem.deck.cards import conversions, finish, from_pynastran, monitors
from fem.deck.records.card import Card, Element, Topology

_MODES, _MONITORS = "Modes", "Monitor points (of landings)"

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
        fields="sid:i method:s=INV l1:f=nan[1] l2:f=nan[1] nep:i=0 ndp:i=0 ndn:i=0 - "
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
    # What they refer to is looked at where they are used: decks of aeroelastic models
    # have some that have nothing to do with the structure.
    Card(
        name="MONPNT1",
        group=_MONITORS,
        read=monitors.monpnt1,
        more="name:s label:s axes:c comp:s cp:i x1:f x2:f x3:f cd:i",
        convert=conversions.grid,
    ),
    Card(
        name="MONPNT3",
        group=_MONITORS,
        read=monitors.monpnt3,
        more="name:s label:s axes:c gridset:i elemset:i cp:i x1:f x2:f x3:f xflag:s "
        "cd:i",
        convert=conversions.grid,
    ),
    Card(
        name="AECOMP",
        group=_MONITORS,
        read=monitors.aecomp,
        more="name:s type:s lists:*",
    ),
    Card(name="AECOMPL", group=_MONITORS, read=monitors.aecompl, table="AECOMP"),
)
