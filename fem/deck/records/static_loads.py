"""Static loads."""

from fem.deck.cards import lists
from fem.deck.records.card import Card

GROUP = "Static loads"
_VECTOR = "n1:f=0. n2:f=0. n3:f=0."


def _regular(name: str, fields: str) -> Card:
    return Card(name=name, group=GROUP, fields=fields, load=True)


RECORDS = (
    _regular("FORCE", f"sid:i g:i>GRID cid:i=0>CORD f:f {_VECTOR}"),
    _regular("MOMENT", f"sid:i g:i>GRID cid:i=0>CORD m:f {_VECTOR}"),
    _regular("FORCE1", "sid:i g:i>GRID f:f g1:i>GRID g2:i>GRID"),
    _regular("MOMENT1", "sid:i g:i>GRID m:f g1:i>GRID g2:i>GRID"),
    _regular("FORCE2", "sid:i g:i>GRID f:f g1:i>GRID g2:i>GRID g3:i>GRID g4:i>GRID"),
    _regular("MOMENT2", "sid:i g:i>GRID m:f g1:i>GRID g2:i>GRID g3:i>GRID g4:i>GRID"),
    _regular("SLOAD", "sid:i (id:i>POINT f:f)"),
    _regular("PLOAD", "sid:i p:f g1:i>GRID g2:i>GRID g3:i>GRID g4:i=0>GRID?"),
    _regular(
        "PLOAD1",
        "sid:i eid:i>CBAR|CBEAM|CBEND type:s scale:s x1:f=0. p1:f=0. x2:f=nan p2:f=0.",
    ),
    Card(
        name="PLOAD2",
        group=GROUP,
        read=lists.pload2,
        more="sid:i p:f eids:*>SURFACE",
        load=True,
    ),
    Card(
        name="PLOAD4",
        group=GROUP,
        read=lists.pload4,
        more="sid:i eids:*>FACES p1:f p2:f p3:f p4:f g1:i>GRID? g34:i>GRID? cid:i>CORD "
        "n1:f n2:f n3:f sorl:s ldir:s",
        load=True,
    ),
    _regular("PLOADX", "sid:i p1:f p3:f g1:i>GRID g2:i=0>GRID? g3:i>GRID"),
    _regular(
        "PLOADX1",
        "sid:i eid:i>CTRIAX6 pa:f pb:f=nan ga:i>GRID gb:i>GRID theta:f=0.",
    ),
    _regular("GRAV", f"sid:i cid:i=0>CORD a:f {_VECTOR} -"),
    Card(
        name="ACCEL",
        group=GROUP,
        read=lists.accel,
        more="sid:i cid:i>CORD n1:f n2:f n3:f dir:s locs:* vals:*",
        load=True,
    ),
    Card(
        name="ACCEL1",
        group=GROUP,
        read=lists.accel1,
        more="sid:i cid:i>CORD a:f n1:f n2:f n3:f grids:*>GRID",
        load=True,
    ),
    _regular(
        "RFORCE",
        "sid:i g:i=0>GRID? cid:i=0>CORD a:f=0. r1:f=0. r2:f=0. r3:f=0. method:i=1 "
        "racc:f=0. -",
    ),
    _regular("TEMP", "sid:i (g:i>POINT t:f)"),
    _regular("TEMPD", "(sid:i t:f)"),
    # Temperatures at the ends, and gradients along y and z (plane 1, plane 2).
    Card(
        name="TEMPRB",
        group=GROUP,
        read=lists.temprb,
        more="sid:i eid:i ta:f tb:f tp1a:f tp1b:f tp2a:f tp2b:f",
        load=True,
    ),
    # Mean temperature and gradient along z; TS1 and TS2 at the fibres are passed over.
    Card(
        name="TEMPP1",
        group=GROUP,
        read=lists.tempp1,
        more="sid:i eid:i tbar:f tprime:f",
        load=True,
    ),
    _regular("DEFORM", "sid:i (eid:i d:f)"),
    _regular("SPCD", "sid:i (g:i>POINT c:c=0 d:f=0.)"),
    Card(
        name="LOAD",
        group=GROUP,
        read=lists.load,
        more="sid:i s:f scales:* lids:*",
        load=True,
    ),
)
