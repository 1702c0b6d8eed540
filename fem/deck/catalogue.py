"""Cards that are not used: which may be passed over, and why others are refused."""

# Cards that cannot change the answer of the solutions here, by what they serve: output,
# other solutions, sets that a selection would bring in (and a selection is refused).
PASSED_OVER: dict[str, tuple[str, ...]] = {
    what: tuple(cards.split())
    for what, cards in (
        (
            "Printing, plots, ordering",
            "CBARAO CONTRLT DTI ECHOOFF ECHOON GEOMIN MDLPRM OUTRCV PLOTEL3 PLOTEL4 "
            "SEQGP USET USET1 UXVEC VIEW VIEW3D WEIGHT BOUTPUT CAMERA GMCURV GMSURF "
            "SEUSET SEUSET1 STREAMLINE SWLDPRM ELIST CYJOIN MONSUM "
            "MONSUM1 MONSUMT MONDSP1 DEBUG GROUP GROUPM ABSNMVS ABSTRCT ABSLABEL "
            "PLOTE PLOTG PLOTOPT FREEPT",
        ),
        (
            "Tree, names and further boundary points of superelements",
            "SEELT SETREE SELABEL SESUP RELEASE CSUPEXT",
        ),
        (
            "Design optimisation",
            "DCONSTR DEQATN DESVAR DLINK DOPTPRM DRESP1 DRESP2 DRESP3 DSCREEN DTABLE "
            "DVCREL1 DVCREL2 DVMREL1 DVMREL2 DVPREL1 DVPREL2 DVGRID DVBSHAP DVSHAP "
            "DRESP DCONADD DLINK2 DOPTPRM DVGEOM BNDGRID BEADVAR TOPVAR MODTRAK "
            "DESVAR1 DVTREL1 DMNCON DMRLAW MODTRK TOMVAR DSPNOPT",
        ),
        (
            "Frequency response, random response, complex modes",
            "EIGC RANDPS RANDT1 RCROSS "
            "TABRND1 TABRNDG RANDT2 ACSRCE EIGP RANDVAR "
            "ROTORG ROTORSE RSPINR RSPINT UNBALNC RGYRO RVDOF RVDOF1 TABLED5",
        ),
        (
            "Temperatures, nonlinear solutions",
            "CREEP MATHE MATHP MATS1 MATS3 MATS8 MATF1 MATT1 MATT2 MATT3 MATT8 MATT9 "
            "NLPARM NLPCI NLSTEP NLCNTL NLCNTL2 NLCNTLG TABLEM1 TABLEM2 TABLEM3 "
            "TABLEM4 TABLES1 TABLEST TEMPP3 TEMPN1 TSTEPNL TSTEP1 NLRGAP",
        ),
        (
            "Heat",
            "MAT4 MAT5 MATT4 MATT5 QBDY1 QBDY2 QBDY3 QHBDY QVECT QVOL CONV CONVM "
            "PCONV PCONVM CHBDYE CHBDYG CHBDYP PHBDY RADBC RADBND RADCAV RADLST RADM "
            "RADMT RADMTX RADSET VIEWEX TEMPBC",
        ),
        (
            "Contact, glue, bolts",
            "BCBODY BCBODY1 BCBMRAD BCBZIER BCHANGE BCMATL BCMOVE BCNURBS BCNURB2 "
            "BCONP BCONPRG BCONPRP BCPARA BCPATCH BCPROP BCPROP1 BCRIGID BCRGSRF "
            "BCRPARA BCTABLE BCTABL1 BCTADD BCTPARA BCTPARM BCTSET BCONECT BCAUTOP "
            "BCSCAP BFRIC BGADD BGPARM BGSET BLSEG BSURF BSURFS BOLT BOLTFOR BOLTLD "
            "BOLTSEQ BWIDTH BCBDPRP BCSURF BCGRID BCTABLE1 BCTRIM BCPFLG BCBNDRY "
            "BCPROPS BCPROP2",
        ),
        (
            "Aeroelasticity",
            "AEDW AEFACT AEFORCE AEGRID AELINK AELIST AELISTC AEPARM "
            "AEPRESS AEQUAD4 AERO AEROS AESCALE AESTAT AESURF AESURFS AETRIA3 CAERO1 "
            "CAERO2 CAERO3 CAERO4 CAERO5 CSSCHD DIVERG DMI DMIJ DMIJI DMIK FLFACT "
            "FLUTTER GUST MKAERO1 MKAERO2 MONCNCM MONGRP MONPNT2 "
            "PAERO1 PAERO2 PAERO3 PAERO4 PAERO5 SET2 SET3 SPBLND1 SPBLND2 "
            "SPLINE1 SPLINE2 SPLINE3 SPLINE4 SPLINE5 SPLINE6 SPLINE7 SPLINEX SPLINRB "
            "TRIM TRIM2",
        ),
    )
}
WITHOUT_EFFECT = frozenset().union(*PASSED_OVER.values())


def _words(text: str) -> tuple[str, ...]:
    return tuple(text.split())


# Why cards are not supported, by the beginning of their names.
_REASONS: tuple[tuple[tuple[str, ...], str], ...] = (
    (("PLPLANE", "PLSOLID"), "materials are linear here"),
    (
        _words("CGEN EGRID GRIDG SPCG GRIDD GRIDMOD GRIDU"),
        "the generator MSGMESH is not; give the cards that it makes",
    ),
    (
        _words(
            "ADAPT FEEDGE FEFACE GMBC GMBND GMLOAD GMSPC GMINT PVAL PINTC PINTS OUTPUT "
            "TEMPF"
        ),
        "p-elements and interfaces are not",
    ),
    (
        _words(
            "ACMODL MAT10 PANEL ACPLNW AMLREG CHACAB CHACBR CAABSF CACINF ACADAPT "
            "ACPOLE ALOAD ACFPM TRMC PMIC"
        ),
        "fluids (acoustics) are not",
    ),
    (
        _words(
            "AXIC CCONEAX FORCEAX PCONEAX RINGAX MOMAX SPCAX PRESAX TEMPAX CTRIAX "
            "PTRIAX CTRAX CQUADX PAXSYMH"
        ),
        "of bodies of revolution only CTRIAX6 is",
    ),
    (("PCOMPLS",), "PCOMPS describes layered solids"),
    (
        ("CSUPER",),
        "superelements in databases of Nastran are not; their matrices are read from "
        "the files of EXTSEOUT (DMIG, OUTPUT2, OUTPUT4)",
    ),
    (("PFASTT",), "fasteners by frequency and temperature are not; PFAST is"),
    (("CBEAM3", "PBEAM3"), "three-grid beams are not; two CBEAM, or CBEND, are"),
)


def reason(name: str) -> str:
    """Why a card is not supported, as a clause, or the empty string."""
    for beginnings, text in _REASONS:
        if name.startswith(beginnings):
            return f": {text}"
    return ""


# Property cards that are harmless where no element has them, and once their elements
# are passed over.
PROPERTY_OF: dict[str, str] = {
    "CBEAM3": "PBEAM3",
    "CSEAM": "PSEAM",
    "CBUSH2D": "PBUSH2D",
    "CAABSF": "PAABSF",
    "CDAMP5": "PDAMP5",
    "CQUADX": "PLPLANE",
    "CAERO1": "PAERO1",
    "CHBDYP": "PHBDY",
    "CCONEAX": "PCONEAX",
    "CACINF3": "PACINF",
    "CHACAB": "PACABS",
    "CHACBR": "PACBAR",
    "CQUADR": "PCOMPLS",
    "CRAC2D": "PRAC2D",
    "CRAC3D": "PRAC3D",
    "CTRAX3": "PAXSYMH",
    "CDUM8": "PDUM8",
}
