"""Dynamic loads: patterns, functions of time, steps."""

from fem.deck.cards import finish, from_pynastran, lists
from fem.deck.records.card import Card

_GROUP = "Dynamic loads"
# delay: in seconds, delayid: of a DELAY set; type LOAD, DISP, VELO or ACCE
_TLOAD = "sid:i exciteid:i delay:u=0 type:s=0"


RECORDS = (
    Card(
        name="DAREA", group=_GROUP, fields="sid:i (id:i>FREEDOM c:i=0 a:f)", load=True
    ),
    Card(name="LSEQ", group=_GROUP, fields="sid:i exciteid:i lid:i=0 -", load=True),
    Card(
        name="DLOAD",
        group=_GROUP,
        read=lists.load,
        more="sid:i s:f scales:* lids:*",
        load=True,
    ),
    Card(
        name="TLOAD1",
        group=_GROUP,
        fields=f"{_TLOAD} tid:u us0:f=0. vs0:f=0.",
        finish=finish.tload1,
        more="delayid:i tid:i>TABLED1|TABLED2",
        load=True,
    ),
    Card(
        name="TLOAD2",
        group=_GROUP,
        fields=f"{_TLOAD} t1:f=0. t2:f f:f=0. p:f=0. c:f=0. b:f=0. us0:f=0. vs0:f=0.",
        finish=finish.tload,
        more="delayid:i",
        load=True,
    ),
    Card(
        name="RLOAD1",
        group=_GROUP,
        fields="sid:i exciteid:i delay:u=0 phase:u=0 tc:u=0 td:u=0 type:s=0",
        finish=finish.rload1,
        more="delayid:i phaseid:i tcid:i>TABLED1|TABLED2 tdid:i>TABLED1|TABLED2",
        load=True,
    ),
    Card(
        name="RLOAD2",
        group=_GROUP,
        fields="sid:i exciteid:i delay:u=0 phase:u=0 tb:u tp:u=0 type:s=0",
        finish=finish.rload2,
        more="delayid:i phaseid:i tbid:i>TABLED1|TABLED2 tpid:i>TABLED1|TABLED2",
        load=True,
    ),
    Card(
        name="DPHASE",
        group=_GROUP,
        fields="sid:i (id:i>FREEDOM c:i=0 th:f=0.)",
        load=True,
    ),
    Card(
        name="FREQ",
        group=_GROUP,
        read=lists.freq,
        more="sid:i fs:*",
        load=True,
    ),
    Card(name="FREQ1", group=_GROUP, fields="sid:i f1:f=0. df:f ndf:i=1", load=True),
    Card(name="FREQ2", group=_GROUP, fields="sid:i f1:f f2:f nf:i=1", load=True),
    Card(
        name="FREQ3",
        group=_GROUP,
        fields="sid:i f1:f f2:f=nan type:s=LINEAR nef:i=10 cluster:f=1.",
        finish=finish.freq3,
        load=True,
    ),
    Card(
        name="FREQ4",
        group=_GROUP,
        fields="sid:i f1:f=0. f2:f=1.+20 fspd:f=.1 nfm:i=3",
        finish=finish.freq4,
        load=True,
    ),
    Card(
        name="FREQ5",
        group=_GROUP,
        read=lists.freq5,
        more="sid:i f1:f f2:f frs:*",
        load=True,
    ),
    Card(
        name="DELAY",
        group=_GROUP,
        fields="sid:i (id:i>FREEDOM c:i=0 t:f=0.)",
        load=True,
    ),
    Card(
        name="TABLED1",
        group=_GROUP,
        extract=from_pynastran.tabled1,
        more="tid:i xaxis:s yaxis:s xs:* ys:* extrap:i",
        ids="own",
        load=True,
    ),
    Card(
        name="TABLED2",
        group=_GROUP,
        read=lists.tabled2,
        more="tid:i x1:f x2:f kind:i xs:* ys:* extrap:i",
        load=True,
    ),
    Card(name="TABLED3", group=_GROUP, read=lists.tabled3, table="TABLED2"),
    Card(name="TABLED4", group=_GROUP, read=lists.tabled4, table="TABLED2"),
    # Rows b0, b1, b2 of the freedom itself; factors: (n, 3) of the others.
    Card(
        name="TF",
        group=_GROUP,
        read=lists.tf,
        more="sid:i gd:i>FREEDOM cd:i b0:f b1:f b2:f grids:*>FREEDOM comps:* factors:*",
        load=True,
    ),
    # Loads that depend on displacements, or velocities (components of 10 and more).
    *(
        Card(
            name=f"NOLIN{kind}",
            group=_GROUP,
            fields=f"sid:i gi:i>FREEDOM ci:i=0 s:f gj:i>FREEDOM cj:i=0 {rest}",
            load=True,
        )
        for kind, rest in (
            (1, "tid:i>TABLED1|TABLED2"),
            (2, "gk:i>FREEDOM ck:i=0"),
            (3, "a:f"),
            (4, "a:f"),
        )
    ),
    Card(
        name="TIC",
        group=_GROUP,
        fields="sid:i id:i>FREEDOM c:i=0 u0:f=0. v0:f=0.",
        load=True,
    ),
    Card(
        name="TSTEP",
        group=_GROUP,
        read=lists.tstep,
        more="sid:i counts:* steps:* outputs:*",
        ids="own",
        load=True,
    ),
)
