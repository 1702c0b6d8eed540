"""A small structure of every kind of element and load, as the text of a deck.

Shells, laminates, a solid, bars, a panel, rigid elements and masses; statics and modes.
"""

XYZ = {
    **{1: (0, 0, 0), 2: (1.1, 0, 0), 3: (2, 0.1, 0), 4: (0, 1, 0.1), 5: (1, 1.05, 0)},
    **{6: (2.1, 1, 0.05), 7: (0, 2, 0), 8: (1, 2.1, 0.1), 9: (2, 2, 0)},
    **{11: (2, 0.1, 1), 12: (2.1, 1, 1.05), 13: (2.9, 0, 0), 14: (3, 1, 0.1)},
    **{15: (3, 0.1, 1), 16: (3.1, 1.1, 1), 20: (1, 1, 1.5), 21: (3.5, 0.6, 0.6)},
    22: (1.2, 2.4, 0.8),
}
# card, property, grids, what follows; 0 stands for the element's own number
ELEMENTS = [
    (1, "CQUAD4,{e},1,{},{},{},{},30.,.02", (1, 2, 5, 4)),
    (2, "CQUAD4,{e},1,{},{},{},{}", (2, 3, 6, 5)),
    (3, "CQUAD4,{e},2,{},{},{},{},7", (4, 5, 8, 7)),
    (4, "CTRIA3,{e},2,{},{},{},7", (5, 6, 9)),
    (5, "CTRIA3,{e},1,{},{},{},,-.01", (5, 9, 8)),
    (6, "CHEXA,{e},3,{},{},{},{},{},{},\n,{},{}", (3, 13, 14, 6, 11, 15, 16, 12)),
    (7, "CBAR,{e},4,{},{},0.,1.,1.\n,,,.05,0.,.1,0.,0.,.1", (5, 20)),
    (8, "CBEAM,{e},5,{},{},{}", (20, 11, 7)),
    (9, "CBUSH,{e},6,{},{},,,,7", (9, 16)),
    (10, "CROD,{e},8,{},{}", (8, 20)),
    (11, "RBE2,{e},{},123456,{}", (20, 22)),
    (12, "RBE3,{e},,{},123456,1.,123,{},{},\n,{},{}", (21, 13, 14, 15, 16)),
    (13, "CONM2,{e},{},,30.,.1,.2,.3\n,1.,,2.,,,3.", (22,)),
    (14, "CONM2,{e},{},,50.", (21,)),
    (15, "CSHEAR,{e},9,{},{},{},{}", (3, 6, 12, 11)),
]
PROPERTIES = """
PSHELL,1,1,.03,1,,1
PCOMP,2,,,,,,,SYM
,2,.004,0.,YES,2,.005,35.,YES
PSOLID,3,1
PBAR,4,1,4.-3,2.-6,3.-6,4.-6,1.5
,.05,.02
,.8,.7
PBEAM,5,1,4.-3,2.-6,3.-6,,4.-6
,.05,.02
,YES,1.,3.-3,1.-6,2.-6,,3.-6
PBUSH,6,K,1.+5,2.+5,3.+5,4.+4,5.+4,6.+4
PROD,8,1,2.-4,1.-7
PSHEAR,9,1,.01
MAT1,1,7.+10,,.3,2700.
MAT8,2,1.2+11,9.+9,.3,5.+9,4.+9,3.+9,1600.
CORD2R,7,,.1,.2,.3,.3,.1,1.3,
,1.,.5,.2
"""
CONTROL = """\
SOL 101
CEND
SPC=1
DISP=ALL
SPCF=ALL
FORCE=ALL
STRESS(CORNER)=ALL
STRAIN=ALL
ESE=ALL
SUBCASE 1
LOAD=1
SUBCASE 2
ANALYSIS=MODES
METHOD=5
BEGIN BULK
EIGRL,5,,,8
LOAD,1,1.,1.,2,1.,3,1.,4
"""


TRANSIENT = """\
SUBCASE 3
ANALYSIS=DTRAN
DLOAD=9
TSTEP=8
BEGIN BULK
TLOAD1,9,3,,,7
TABLED1,7
,0.,0.,.01,1.,.02,0.,ENDT
TSTEP,8,20,.001
"""


def deck(grids: str, number=lambda grid: grid, element=lambda e: e) -> str:
    """Text of the structure with other grid cards and other numbers."""
    text = CONTROL + PROPERTIES + grids
    for e, form, nodes in ELEMENTS:
        text += form.format(*(number(n) for n in nodes), e=element(e)) + "\n"
    clamped = ",".join(str(number(n)) for n in (1, 4, 7))
    text += f"SPC1,1,123456,{clamped}\n"
    text += (
        f"FORCE,2,{number(22)},7,1000.,1.,2.,-3.\nMOMENT,2,{number(9)},,90.,0.,1.,1.\n"
    )
    text += f"PLOAD4,3,{element(1)},500.,400.,300.,600.\n"
    text += f"PLOAD4,3,{element(6)},800.,,,,{number(13)},{number(16)}\n"
    text += f"PLOAD1,3,{element(7)},FZ,FR,.2,200.,.9,400.\n"
    text += f"PLOAD1,3,{element(8)},FYE,FR,0.,200.,1.,100.\n"
    return text + "GRAV,4,,9.81,.3,-.2,1.\nENDDATA\n"


def every_solution() -> str:
    """Text of the structure with statics, modes and a transient."""
    text = deck(plain()).replace("BEGIN BULK\n", TRANSIENT)
    return text.replace("ESE=ALL", "ESE=ALL\nOLOAD=ALL")


def plain() -> str:
    """Grid cards in the basic frame."""
    return "".join(f"GRID,{n},,{x},{y},{z}\n" for n, (x, y, z) in XYZ.items())
