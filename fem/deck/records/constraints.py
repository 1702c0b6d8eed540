"""Rigid elements, constraints, sets of a reduction."""

from fem.deck.cards import conversions, finish, from_pynastran, lists, rigid_bodies
from fem.deck.records.card import Card

_GROUP, _SETS = "Rigid elements, constraints", "Sets of a reduction"
_FREEDOMS = "(id:i>POINT c:c=0)"

RECORDS = (
    Card(
        name="RBE2",
        group=_GROUP,
        read=lists.rbe2,
        more="eid:i gn:i>GRID cm:c gms:*>GRID",
        ids="own",
    ),
    # Weights, components, grids: parallel sequences, one entry per (weight, grid).
    Card(
        name="RBE3",
        group=_GROUP,
        extract=from_pynastran.rbe3,
        more="eid:i refgrid:i>GRID refc:c weights:*[1] comps:* grids:*>GRID "
        "umgrids:*>GRID umcomps:*",
        ids="own",
    ),
    Card(
        name="RBAR",
        group=_GROUP,
        fields="eid:i ga:i>GRID gb:i>GRID cna:c= cnb:c= cma:c= cmb:c= -",
        ids="own",
    ),
    # Grids and components of independent (n) and dependent (m) freedoms.
    Card(
        name="RBE1",
        group=_GROUP,
        read=rigid_bodies.rbe1,
        more="eid:i card:s ns:*>GRID cns:* ms:*>GRID cms:* grids:*>GRID",
        ids="own",
    ),
    Card(name="RBAR1", group=_GROUP, read=rigid_bodies.rbar1, table="RBE1"),
    Card(name="RJOINT", group=_GROUP, read=rigid_bodies.rbar1, table="RBE1"),
    Card(name="RTRPLT", group=_GROUP, read=rigid_bodies.rtrplt, table="RBE1"),
    Card(name="RTRPLT1", group=_GROUP, read=rigid_bodies.rtrplt1, table="RBE1"),
    Card(
        name="RROD",
        group=_GROUP,
        fields="eid:i ga:i>GRID gb:i>GRID cma:c= cmb:c= -",
        ids="own",
    ),
    Card(
        name="RSPLINE",
        group=_GROUP,
        read=rigid_bodies.rspline,
        more="eid:i ratio:f[1] grids:*>GRID comps:*",
        ids="own",
    ),
    # ELEM: a shell and a solid; GRID: two grids of a shell, each with two of a solid.
    Card(
        name="RSSCON",
        group=_GROUP,
        fields="eid:i type:s=ELEM es1:i ea1:i eb1:i=0 es2:i=0 ea2:i=0 eb2:i=0",
        finish=finish.rsscon,
        more="shell:i>SURFACE solid:i>CHEXA|CPENTA|CTETRA|CPYRAM s1:i>GRID? a1:i>GRID? "
        "b1:i>GRID? s2:i>GRID? a2:i>GRID? b2:i>GRID?",
        ids="own",
    ),
    # comps: integers, 0 for a scalar point
    Card(
        name="MPC",
        group=_GROUP,
        read=lists.mpc,
        more="sid:i grids:*>POINT comps:* coefficients:*",
        convert=conversions.equation,
    ),
    Card(name="MPCADD", group=_GROUP, read=lists.add, more="sid:i sets:*"),
    # c text of digits ('0' scalar point), d enforced value
    Card(
        name="SPC",
        group=_GROUP,
        fields="sid:i (g:i>POINT c:c=0 d:f=0.)",
        convert=conversions.enforced,
    ),
    Card(name="SPC1", group=_GROUP, read=lists.spc1, table="SPC"),
    Card(name="SPCADD", group=_GROUP, read=lists.add, more="sid:i sets:*"),
    Card(name="SUPORT", group=_GROUP, fields=_FREEDOMS),
    Card(name="SUPORT1", group=_GROUP, fields=f"sid:i {_FREEDOMS}"),
    # Of the sets with fixed boundary, reductions here take all.
    Card(name="ASET", group=_SETS, fields=_FREEDOMS),
    Card(name="ASET1", group=_SETS, read=lists.freedoms, table="ASET"),
    Card(name="BSET", group=_SETS, fields=_FREEDOMS, table="ASET"),
    Card(name="BSET1", group=_SETS, read=lists.freedoms, table="ASET"),
    Card(name="BNDFIX", group=_SETS, fields=_FREEDOMS, table="ASET"),
    Card(name="BNDFIX1", group=_SETS, read=lists.freedoms, table="ASET"),
    # Lists of grids or elements for what refers to them; nothing here checks which.
    Card(name="SET1", group="Lists", read=lists.set1, more="sid:i ids:*"),
    # Those with free boundary stand in ASET, too, once the deck is read.
    Card(name="CSET", group=_SETS, fields=_FREEDOMS),
    Card(name="CSET1", group=_SETS, read=lists.freedoms, table="CSET"),
    Card(name="BNDFREE", group=_SETS, fields=_FREEDOMS, table="CSET"),
    Card(name="BNDFREE1", group=_SETS, read=lists.freedoms, table="CSET"),
    Card(name="OMIT", group=_SETS, fields=_FREEDOMS),
    Card(name="OMIT1", group=_SETS, read=lists.freedoms, table="OMIT"),
    Card(name="QSET", group=_SETS, fields=_FREEDOMS),
    Card(name="QSET1", group=_SETS, read=lists.freedoms, table="QSET"),
    # Superelements of one section: interior points, boundary, modal coordinates.
    Card(name="SESET", group=_SETS, read=lists.seset, more="seid:i id:i thru:*"),
    *(
        card
        for letter in "BCQ"
        for card in (
            Card(
                name=f"SE{letter}SET",
                group=_SETS,
                read=lists.se_set,
                more="seid:i id:i c:c thru:*",
            ),
            Card(
                name=f"SE{letter}SET1",
                group=_SETS,
                read=lists.se_set1,
                table=f"SE{letter}SET",
            ),
        )
    ),
    Card(name="SENQSET", group=_SETS, fields="seid:i n:i=0"),
    # Partitioned superelements: SEBULK in the main section, grids joined by SECONCT.
    Card(
        name="SEBULK",
        group=_SETS,
        fields="seid:i type:s rseid:i=0 method:s=AUTO tol:f=1.E-5[1] loc:s=YES "
        "unitno:i=0",
    ),
    # Rows of the matrices of an external superelement.
    Card(name="EXTRN", group=_SETS, fields=_FREEDOMS),
    # The plane of an image by MIRROR, through three points of the main section.
    Card(name="SEMPLN", group=_SETS, fields="seid:i plane:s p1:i p2:i p3:i"),
    # Three points of the superelement and their places in the main section.
    Card(
        name="SELOC",
        group=_SETS,
        fields="seid:i pa1:i pa2:i pa3:i pb1:i pb2:i pb3:i",
    ),
    Card(
        name="SECONCT",
        group=_SETS,
        read=lists.seconct,
        more="sea:i seb:i gidas:* gidbs:*",
    ),
)
