"""Masses: concentrated, scalar, non-structural."""

from functools import partial

from fem.deck.cards import conversions, finish, lists, masses, solids
from fem.deck.records.card import Card, Element, Topology

_GROUP = "Masses"
_AT_GRID = Topology(kind="point", grids=("g",), corners=1)
_ENDS = "g1:i=0>POINT c1:i=0 g2:i=0>POINT c2:i=0"
_SCALAR = "g1:i=0>POINT g2:i=0>POINT"

RECORDS = (
    Card(
        name="CONM1",
        group=_GROUP,
        read=solids.conm1,
        more="eid:i g:i>GRID cid:i>CORD ms:*",  # ms: (6, 6) symmetric
        ids="own",
        convert=conversions.mass_matrix,
        element=Element(
            reader="scalars.concentrated_mass:read_conm1", topology=_AT_GRID
        ),
    ),
    Card(
        name="CONM2",
        group=_GROUP,
        fields="eid:i g:i>GRID cid:i=0>CORD m:f=0.[M] x1:f=0.[L] x2:f=0.[L] x3:f=0.[L] "
        "- i11:f=0.[ML2] i21:f=0.[ML2] i22:f=0.[ML2] i31:f=0.[ML2] i32:f=0.[ML2] "
        "i33:f=0.[ML2]",
        ids="own",
        element=Element(
            reader="scalars.concentrated_mass:read_conm2", topology=_AT_GRID
        ),
    ),
    # `card` says how the element was spelled.
    Card(
        name="CMASS1",
        group=_GROUP,
        fields=f"eid:i pid:i=eid>PMASS {_ENDS}",
        more="card:s",
        ids="own",
        element=Element(reader="scalars.scalar:read_cmass"),
    ),
    Card(
        name="CMASS2",
        group=_GROUP,
        fields=f"eid:i m:f {_ENDS}",
        more="card:s",
        ids="own",
        convert=partial(conversions.direct, column="m"),
    ),
    Card(
        name="CMASS3",
        group=_GROUP,
        fields=f"(eid:i pid:i=eid>PMASS {_SCALAR})",
        finish=finish.scalar,
        table="CMASS1",
    ),
    Card(
        name="CMASS4",
        group=_GROUP,
        fields=f"(eid:i m:f {_SCALAR})",
        finish=finish.scalar,
        table="CMASS2",
    ),
    Card(
        name="PMASS",
        group=_GROUP,
        fields="(pid:i m:f=0.)",
        ids="own",
        convert=partial(conversions.by_use, column="m", user="CMASS1"),
    ),
    # Type PSHELL, PBAR, ..., ELEMENT; ids of that type; per length or area.
    Card(
        name="NSM",
        group=_GROUP,
        read=masses.nsm,
        more="sid:i type:s ids:* values:*",
        convert=conversions.nonstructural,
    ),
    Card(name="NSM1", group=_GROUP, read=masses.nsm1, table="NSM"),
    # Lumped total.
    Card(
        name="NSML",
        group=_GROUP,
        read=masses.nsml,
        more="sid:i type:s ids:* value:f[M]",
    ),
    Card(name="NSML1", group=_GROUP, read=masses.nsml1, table="NSML"),
    Card(name="NSMADD", group=_GROUP, read=lists.add, more="sid:i sets:*"),
    # s0 times the sum of factors times the masses of BEGIN MASSID = n; 0: the base.
    Card(
        name="MASSSET",
        group=_GROUP,
        read=masses.massset,
        more="sid:i s0:f[1] factors:* massids:*",
        ids="own",
    ),
)
