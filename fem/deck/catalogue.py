"""Cards that are not used: which may be passed over, and why others are refused."""

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
        ("Aeroelasticity", "MONPNT1 MONPNT2 MONPNT3 SET2 SET3 SPLINE1"),
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
