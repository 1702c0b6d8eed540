"""Which cards are read, which may be passed over, and which are not supported."""

# Cards that cannot change the answer of the solutions here, by what they serve: output,
# other solutions, sets that a selection would bring in (and a selection is refused).
PASSED_OVER: dict[str, tuple[str, ...]] = {
    what: tuple(cards.split())
    for what, cards in (
        (
            "Printing, plots, ordering",
            "CBARAO CONTRLT DTI ECHOOFF ECHOON GEOMIN MDLPRM OUTRCV PLOTEL3 PLOTEL4 "
            "SEQGP USET USET1 UXVEC VIEW VIEW3D WEIGHT",
        ),
        (
            "Design optimisation",
            "DCONSTR DEQATN DESVAR DLINK DOPTPRM DRESP1 DRESP2 DRESP3 DSCREEN DTABLE "
            "DVCREL1 DVMREL1 DVPREL1 DVPREL2",
        ),
        (
            "Frequency response, random response, complex modes, buckling",
            "EIGB EIGC FREQ FREQ1 FREQ2 FREQ3 FREQ4 FREQ5 RANDPS RANDT1 RCROSS RLOAD1 "
            "RLOAD2 TABLED2 TABRND1",
        ),
        (
            "Temperatures, nonlinear solutions",
            "MATS1 NLPARM NLPCI TABLEM1 TABLEM2 TABLEM3 TABLEM4 TABLES1 TABLEST TEMP "
            "TEMPD TEMPP1 TEMPP3 TEMPRB TSTEPNL",
        ),
        ("Aeroelasticity", "MONPNT1 MONPNT2 MONPNT3 SET1 SET2 SET3 SPLINE1"),
    )
}
WITHOUT_EFFECT = frozenset().union(*PASSED_OVER.values())

# Why cards are not supported, by the beginning of their names.
_REASONS: tuple[tuple[tuple[str, ...], str], ...] = (
    (
        ("MATT",),
        "materials do not depend on temperature here; without it, the constants of "
        "the MAT card hold",
    ),
    (("MATS", "CREEP", "MATHP", "PLPLANE", "PLSOLID"), "materials are linear here"),
    (("PELAST", "PDAMPT", "PBUSHT"), "springs and dampers are linear here"),
    (("NLRGAP", "NOLIN", "CGAP", "BCTABLE", "BCONP", "BSURF"), "no contact here"),
    (("CAERO", "AERO", "AESURF", "SPLINE", "PAERO"), "no aerodynamics here"),
)


def reason(name: str) -> str:
    """Why a card is not supported, as a clause, or the empty string."""
    for beginnings, text in _REASONS:
        if name.startswith(beginnings):
            return f": {text}"
    return ""


# Property cards that are harmless once their elements are passed over.
PROPERTY_OF: dict[str, str] = {
    "CBEND": "PBEND",
    "CBEAM3": "PBEAM3",
    "CGAP": "PGAP",
    "CFAST": "PFAST",
    "CWELD": "PWELD",
    "CSEAM": "PSEAM",
    "CBUSH1D": "PBUSH1D",
    "CBUSH2D": "PBUSH2D",
    "CAABSF": "PAABSF",
    "CDAMP5": "PDAMP5",
    "CQUADX": "PLPLANE",
    "CAERO1": "PAERO1",
    "CHBDYP": "PHBDY",
    "CCONEAX": "PCONEAX",
}

# Defaults for the blank fields of other cards, by index of the field.
DEFAULTS_FOR: dict[str, tuple[str, tuple[int, ...]]] = {
    "GRDSET": ("GRID", (2, 6, 7)),
    "BAROR": ("CBAR", (2, 5, 6, 7, 8)),
    "BEAMOR": ("CBEAM", (2, 5, 6, 7, 8)),
}

ELEMENTS = tuple(
    """
    CBAR CBEAM CROD CTUBE CELAS1 CELAS2 CDAMP1 CDAMP2 CMASS1 CMASS2 CVISC CBUSH
    CONM1 CONM2 CQUAD4 CTRIA3 CSHEAR CHEXA CPENTA CTETRA CPYRAM RBE2 RBE3 RBAR
    """.split()
)

# Property tables whose ids are their own; PSHELL and PCOMP share theirs.
SINGLE_PROPERTIES = tuple(
    "PBAR PBEAM PROD PTUBE PELAS PDAMP PMASS PVISC PBUSH PSHEAR PSOLID".split()
)

# Element column -> tables that may hold the property.
PROPERTIES: dict[str, tuple[str, ...]] = {
    "CBAR": ("PBAR",),
    "CBEAM": ("PBEAM",),
    "CROD": ("PROD",),
    "CTUBE": ("PTUBE",),
    "CELAS1": ("PELAS",),
    "CDAMP1": ("PDAMP",),
    "CMASS1": ("PMASS",),
    "CVISC": ("PVISC",),
    "CBUSH": ("PBUSH",),
    "CQUAD4": ("PSHELL", "PCOMP"),
    "CTRIA3": ("PSHELL", "PCOMP"),
    "CSHEAR": ("PSHEAR",),
    "CHEXA": ("PSOLID",),
    "CPENTA": ("PSOLID",),
    "CTETRA": ("PSOLID",),
    "CPYRAM": ("PSOLID",),
}

_PLANE = ("MAT1", "MAT2", "MAT8")
# Property table -> its columns of material ids and the tables they may point to.
MATERIALS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "PBAR": (("mid",), ("MAT1",)),
    "PBEAM": (("mid",), ("MAT1",)),
    "PROD": (("mid",), ("MAT1",)),
    "PTUBE": (("mid",), ("MAT1",)),
    "CROD": (("mid",), ("MAT1",)),
    "PSHELL": (("mid1", "mid2", "mid3", "mid4"), _PLANE),
    "PCOMP": (("mids",), _PLANE),
    "PSHEAR": (("mid",), ("MAT1",)),
    "PSOLID": (("mid",), ("MAT1", "MAT9")),
}

# Columns that hold grids, per table; a `?` also admits scalar points and the ground, 0;
# a `-` admits a blank, 0.
GRIDS: dict[str, str] = {
    "CBAR": "ga gb g0-",
    "CBEAM": "ga gb g0- sa? sb?",
    "CROD": "g1 g2",
    "CTUBE": "g1 g2",
    "CELAS1": "g1? g2?",
    "CELAS2": "g1? g2?",
    "CDAMP1": "g1? g2?",
    "CDAMP2": "g1? g2?",
    "CMASS1": "g1? g2?",
    "CMASS2": "g1? g2?",
    "CVISC": "g1 g2",
    "CBUSH": "ga gb- g0-",
    "CONM1": "g",
    "CONM2": "g",
    "CQUAD4": "g1 g2 g3 g4",
    "CTRIA3": "g1 g2 g3",
    "CSHEAR": "g1 g2 g3 g4",
    "CHEXA": "nodes-",
    "CPENTA": "nodes-",
    "CTETRA": "nodes-",
    "CPYRAM": "nodes-",
    "RBE2": "gn gms",
    "RBE3": "refgrid grids umgrids",
    "RBAR": "ga gb",
    "MPC": "grids?",
    "SPC": "g?",
    "SUPORT": "id?",
    "ASET": "id?",
    "QSET": "id?",
    "DMIG": "rowids? colids?",
    "FORCE": "g",
    "MOMENT": "g",
    "FORCE1": "g g1 g2",
    "MOMENT1": "g g1 g2",
    "FORCE2": "g g1 g2 g3 g4",
    "MOMENT2": "g g1 g2 g3 g4",
    "SLOAD": "id?",
    "RFORCE": "g-",
    "ACCEL1": "grids",
    "SPCD": "g?",
    "DAREA": "id?",
    "DELAY": "id?",
    "TIC": "id?",
    "PLOTEL": "g1 g2",
    "PLOAD": "g1 g2 g3 g4-",
    "PLOAD4": "g1- g34-",
}

# Columns that hold coordinate systems.
FRAMES: dict[str, tuple[str, ...]] = {
    "GRID": ("cp", "cd"),
    "CONM1": ("cid",),
    "CONM2": ("cid",),
    "CBUSH": ("cid", "ocid"),
    "CQUAD4": ("mcid",),
    "CTRIA3": ("mcid",),
    "PSOLID": ("cordm",),
    "MAT1": ("mcsid",),
    "FORCE": ("cid",),
    "MOMENT": ("cid",),
    "PLOAD4": ("cid",),
    "GRAV": ("cid",),
    "ACCEL1": ("cid",),
    "RFORCE": ("cid",),
}

# Columns that hold elements, per load table, and the tables they may point to.
LOADED_ELEMENTS: dict[str, tuple[str, tuple[str, ...]]] = {
    "PLOAD1": ("eid", ("CBAR", "CBEAM")),
    "PLOAD2": ("eids", ("CQUAD4", "CTRIA3", "CSHEAR")),
    "PLOAD4": (
        "eids",
        ("CQUAD4", "CTRIA3", "CSHEAR", "CHEXA", "CPENTA", "CTETRA", "CPYRAM"),
    ),
}
