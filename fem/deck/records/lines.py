"""Bars, beams, rods, tubes, viscous rods, with their properties."""

from fem.deck.cards import finish, from_pynastran, shapes
from fem.deck.records.card import Card, Element, Op2, Result, Topology

_GROUP, _DEFAULTS = "Line elements", "Defaults of line elements"

# Orientation: by grid g0 > 0, else by the vector x1 x2 x3.
_ORIENTED = "ga:i>GRID gb:i>GRID x1:u=nan x2:f=nan x3:f=nan offt:s=GGG"
_OFFSETS = (
    "pa:c= pb:c= w1a:f=0.[L] w2a:f=0.[L] w3a:f=0.[L] w1b:f=0.[L] w2b:f=0.[L] "
    "w3b:f=0.[L]"
)
_DEFAULTS_OF = "- pid:i=0 - - x1:u=nan x2:f=nan x3:f=nan offt:s=GGG"
_STATIONS = (
    "as:*[L2] i1s:*[L4] i2s:*[L4] i12s:*[L4] js:*[L4] nsms:*[M/L] c1s:*[L] c2s:*[L] "
    "d1s:*[L] d2s:*[L] e1s:*[L] e2s:*[L] f1s:*[L] f2s:*[L]"
)

_A_TO_B = Topology(kind="line", grids=("ga", "gb"), corners=2, edges=((0, 1),))
_1_TO_2 = Topology(kind="line", grids=("g1", "g2"), corners=2, edges=((0, 1),))

_OF_BAR = ("bending_moment1", "bending_moment2", "shear1", "shear2", "axial", "torque")
BAR_FORCE = (
    *("bending_moment_a1", "bending_moment_a2"),
    *("bending_moment_b1", "bending_moment_b2"),
    *("shear1", "shear2", "axial", "torque"),
)
BAR_ENDS = tuple(f"{name}_{end}" for end in "ab" for name in _OF_BAR)
BAR_STRESS = (
    *("s1a", "s2a", "s3a", "s4a", "axial", "smaxa", "smina"),
    *("s1b", "s2b", "s3b", "s4b", "smaxb", "sminb"),
)
# Of one section of a beam.
BEAM_FORCE = (
    *("bending_moment1", "bending_moment2", "shear1", "shear2"),
    *("axial_force", "total_torque", "warping_torque"),
)
BEAM_STRESS = ("sxc", "sxd", "sxe", "sxf", "smax", "smin")
BOTH = ("stress", "strain")


BEND_FORCE = tuple(
    f"{name}_{end}"
    for end in "ab"
    for name in (
        *("bending_moment1", "bending_moment2", "shear1", "shear2"),
        *("axial", "torque"),
    )
)


def at_ends(columns: tuple[str, ...]) -> tuple[str, ...]:
    """Columns of a beam at both ends."""
    return tuple(f"{name}_{end}" for end in "ab" for name in columns)


def at_stations(columns: tuple[str, ...], count: int) -> tuple[str, ...]:
    """Columns of the stations from A to B with the suffixes `_s1`, `_s2`, ..."""
    return tuple(
        f"{name}_s{k}" for k in range(1, count + 1) for name in ("x", *columns)
    )


ROD = ("axial", "torsion")
_ROD_RESULTS = (
    Result(kinds=("force",), columns=ROD),
    Result(kinds=BOTH, columns=ROD),
)

RECORDS = (
    Card(
        name="CBAR",
        group=_GROUP,
        fields=f"eid:i pid:i=eid>PBAR {_ORIENTED} {_OFFSETS}",
        finish=finish.beam,
        more="g0:i>GRID?",
        ids="own",
        element=Element(
            reader="lines.bar:read_cbar",
            topology=_A_TO_B,
            op2=Op2(type=34, force="simple", stress="bar"),
            results=(
                Result(
                    kinds=("force",),
                    columns=BAR_FORCE,
                    remark="shear, axial force, torque of end A",
                ),
                Result(
                    kinds=("force",),
                    columns=BAR_ENDS,
                    table="_ENDS",
                    remark="bars under PLOAD1",
                ),
                Result(kinds=BOTH, columns=BAR_STRESS),
            ),
        ),
    ),
    Card(
        name="CBEAM",
        group=_GROUP,
        fields=f"eid:i pid:i=eid>PBEAM {_ORIENTED} {_OFFSETS} sa:i=0>POINT "
        "sb:i=0>POINT",
        finish=finish.beam,
        more="g0:i>GRID?",
        ids="own",
        element=Element(
            reader="lines.beam_reader:read_cbeam",
            topology=_A_TO_B,
            op2=Op2(type=2, force="beam", stress="beam"),
            results=(
                Result(
                    kinds=("force",), columns=at_ends(BEAM_FORCE), remark="both ends"
                ),
                Result(kinds=BOTH, columns=at_ends(BEAM_STRESS), remark="both ends"),
                Result(
                    kinds=("force",),
                    columns=at_stations(BEAM_FORCE, 1),
                    table="_STATIONS",
                    remark="stations between with SO YES, suffix _s1, _s2, ...; not "
                    "under PLOAD1",
                ),
                Result(
                    kinds=BOTH,
                    columns=at_stations(BEAM_STRESS, 1),
                    table="_STATIONS",
                    remark="likewise",
                ),
            ),
        ),
    ),
    # The last five are those of CONROD, whose pid is 0.
    Card(
        name="CROD",
        group=_GROUP,
        fields="(eid:i pid:i=eid>PROD g1:i>GRID g2:i>GRID)",
        finish=finish.crod,
        more="mid:i>MAT1 a:f[L2] j:f[L4] c:f[L] nsm:f[M/L]",
        ids="own",
        element=Element(
            reader="lines.rod:read_crod",
            topology=_1_TO_2,
            op2=Op2(type=1, force="simple", stress="rod"),
            results=_ROD_RESULTS,
        ),
    ),
    Card(
        name="CONROD",
        group=_GROUP,
        fields="eid:i g1:i>GRID g2:i>GRID mid:i>MAT1 a:f j:f=0. c:f=0. nsm:f=0.",
        finish=finish.conrod,
        table="CROD",
        extent="length",
        element=Element(
            topology=_1_TO_2,
            op2=Op2(type=10, force="simple", stress="rod"),
            results=_ROD_RESULTS,
        ),
    ),
    Card(
        name="CTUBE",
        group=_GROUP,
        fields="(eid:i pid:i=eid>PTUBE g1:i>GRID g2:i>GRID)",
        ids="own",
        element=Element(
            reader="lines.rod:read_ctube",
            topology=_1_TO_2,
            op2=Op2(type=3, force="simple", stress="rod"),
            results=_ROD_RESULTS,
        ),
    ),
    Card(
        name="CVISC",
        group=_GROUP,
        fields="(eid:i pid:i=eid>PVISC g1:i>GRID g2:i>GRID)",
        ids="own",
        element=Element(
            reader="scalars.visc:read_cvisc",
            topology=Topology(
                kind="spring", grids=("g1", "g2"), corners=2, edges=((0, 1),)
            ),
            op2=Op2(type=24, force="simple"),
            results=(Result(kinds=("force",), columns=ROD, remark="transients"),),
        ),
    ),
    Card(
        name="PBAR",
        group=_GROUP,
        fields="pid:i mid:i>MAT1 a:f=0.[L2] i1:f=0.[L4] i2:f=0.[L4] j:f=0.[L4] "
        "nsm:f=0.[M/L] - c1:f=0.[L] c2:f=0.[L] d1:f=0.[L] d2:f=0.[L] e1:f=0.[L] "
        "e2:f=0.[L] f1:f=0.[L] f2:f=0.[L] k1:f=nan k2:f=nan i12:f=0.[L4]",
        finish=finish.pbar,
        ids="own",
        extent="length",
    ),
    # Constants of the section are computed while reading.
    Card(name="PBARL", group=_GROUP, read=shapes.pbarl, table="PBAR", extent="length"),
    # Sequences over the stations xxb = 0 ... 1, all stations present.
    Card(
        name="PBEAM",
        group=_GROUP,
        extract=from_pynastran.pbeam,
        more=f"pid:i mid:i>MAT1 xxbs:* sos:* {_STATIONS} k1:f k2:f s1:f s2:f "
        "nsia:f[ML] nsib:f[ML] cwa:f[L6] cwb:f[L6] m1a:f[L] m2a:f[L] m1b:f[L] "
        "m2b:f[L] n1a:f[L] n2a:f[L] n1b:f[L] n2b:f[L]",
        ids="own",
        extent="length",
    ),
    Card(
        name="PBEAML", group=_GROUP, read=shapes.pbeaml, table="PBEAM", extent="length"
    ),
    Card(
        name="PROD",
        group=_GROUP,
        fields="pid:i mid:i>MAT1 a:f[L2] j:f=0.[L4] c:f=0.[L] nsm:f=0.[M/L]",
        ids="own",
        extent="length",
    ),
    Card(
        name="PTUBE",
        group=_GROUP,
        fields="pid:i mid:i>MAT1 od1:f[L] t:f=nan[L] nsm:f=0.[M/L] od2:f=od1[L]",
        finish=finish.ptube,
        ids="own",
        extent="length",
    ),
    Card(
        name="PVISC",
        group=_GROUP,
        fields="(pid:i ce:f=0.[M] cr:f=0.[ML2] -)",
        ids="own",
    ),
    # Blank GEOM: 1.
    Card(
        name="CBEND",
        group=_GROUP,
        fields="eid:i pid:i=eid>PBEND ga:i>GRID gb:i>GRID x1:u=nan[1] x2:f=nan "
        "x3:f=nan geom:i=1",
        finish=finish.bend,
        more="g0:i>GRID?",
        ids="own",
        element=Element(
            reader="lines.bend:read_cbend",
            topology=_A_TO_B,
            results=(
                Result(
                    kinds=("force",),
                    columns=BEND_FORCE,
                    remark="planes 1 (of the arc) and 2, both ends; no stresses",
                ),
            ),
        ),
    ),
    Card(
        name="PBEND",
        group=_GROUP,
        fields="pid:i mid:i>MAT1 a:u[L2] i1:f[L4] i2:f[L4] j:f=0.[L4] rb:f=0.[L] "
        "thetab:f=0. c1:f=0.[L] c2:f=0.[L] d1:f=0.[L] d2:f=0.[L] e1:f=0.[L] e2:f=0.[L] "
        "f1:f=0.[L] f2:f=0.[L] k1:f=0. k2:f=0. nsm:f=0.[M/L] rc:f=0.[L] zc:f=0.[L] "
        "deltan:f=nan[L]",
        finish=finish.pbend,
        more="fsi:i rm:f[L] wall:f[L] pressure:f[M/L]",
        ids="own",
        extent="length",
    ),
    Card(
        name="BAROR",
        group=_DEFAULTS,
        fields=_DEFAULTS_OF,
        fills=("CBAR", (2, 5, 6, 7, 8)),
    ),
    Card(
        name="BEAMOR",
        group=_DEFAULTS,
        fields=_DEFAULTS_OF,
        fills=("CBEAM", (2, 5, 6, 7, 8)),
    ),
)
