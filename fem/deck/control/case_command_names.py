"""Names of case control commands, and what becomes of each."""

QUANTITIES = {
    "DISPLACEMENT": "DISPLACEMENT",
    "VECTOR": "DISPLACEMENT",
    "VELOCITY": "VELOCITY",
    "ACCELERATION": "ACCELERATION",
    "SPCFORCES": "SPCFORCES",
    "MPCFORCES": "MPCFORCES",
    "OLOAD": "OLOAD",
    "FORCE": "FORCE",
    "ELFORCE": "FORCE",
    "STRESS": "STRESS",
    "ELSTRESS": "STRESS",
    "STRAIN": "STRAIN",
    "ELSTRN": "STRAIN",
    "GPFORCE": "GPFORCE",
    "ESE": "ESE",
    "EKE": "EKE",
    "EDE": "EDE",
    "GPKE": "GPKE",
}
# Command -> attribute of a subcase that holds its number.
NUMBERS = {
    "SPC": "spc",
    "MPC": "mpc",
    "LOAD": "load",
    "DLOAD": "dload",
    "LOADSET": "loadset",
    "IC": "ic",
    "TSTEP": "tstep",
    "METHOD": "method",
    "SUPORT1": "suport1",
    "SUPORT": "suport1",
    "SDAMPING": "sdamping",
    "FREQUENCY": "frequency",
    "NSM": "nsm",
    "MASSSET": "massset",
    "DEFORM": "deform",
    "TFL": "tfl",
    "NONLINEAR": "nonlinear",
}
NAMES = {
    name: name.lower() for name in "ANALYSIS K2GG M2GG B2GG K2PP M2PP B2PP P2G".split()
}
TITLES = {"TITLE": "title", "SUBTITLE": "subtitle", "LABEL": "label"}

# They change the structure itself, whatever is solved.
MODEL_REFUSED = {
    "A2GG": "there is no coupling to fluids",
    "MFLUID": "there is no virtual mass of fluids",
    "RGYRO": "there are no rotors",
    "DSYM": "there is no symmetry about planes",
    "HARMONICS": "there are no axisymmetric elements",
}
# Added to the matrices by dynamic solutions of the deck's own.
DYNAMIC_INPUT = ("K2PP", "B2PP", "M2PP", "TFL")
# They change what a solution of the deck's own finds, and nothing here does it.
SOLUTION_REFUSED = {
    "BCONTACT": "there is no contact",
    "BCSET": "there is no contact",
    "BGSET": "there is no glue",
    "BOLTLD": "there are no bolt preloads",
    "MODSEL": "EIGRL, PARAM LFREQ, HFREQ and LMODES choose modes",
    "MODESELECT": "EIGRL, PARAM LFREQ, HFREQ and LMODES choose modes",
    "RSDAMP": "there is no damping of residual structures",
    "TSTRU": "temperatures are given by TEMP cards",
}
# Requests, printing and what belongs to other disciplines: no answer of the
# solutions here depends on them. They are named in a notice.
_WITHOUT_EFFECT = """
    ACFPMRESULT ACPOWER ADACT ADAMSMNF ADAPT AECONFIG AERCONFIG AEROF AESYMXY AESYMXZ
    AEUXREF APRES AUXCASE AUXMODEL BC BOUTPUT BCRESULTS BGRESULTS CLOAD CMETHOD
    CMSENERGY CSSCHD DATAREC DESGLB DESMOD DESOBJ DESSUB DESVAR DIVERG DRSPAN DSAPRT
    DYNRED ECHO ECHOOFF ECHOON ELSDCON ELSUM ELAR ELDELIM ENTHALPY EQUILIBRIUM EXPORTLD
    EXTDRIN FATIGUE FBODYLD FLSFSEL FLSPOUT FLSTCNT FLUX FMETHOD FRF
    GPRSORT GPSDCON GPSTRAIN GPSTRESS GROUNDCHECK GUST GVECTOR HDOT HOUTPUT HTFLOW
    INTENSITY INTERFACE IRLOAD LINE LOADNAME MASTER MAXLINES MAXMAX MAXMIN MCFRACTION
    MCHSTAT MODALKE MODALSE MODCON MODES MODTRAK MONITOR MONVAR MPRES NCHECK
    NLCNTL NLHARM NLIC NLLOAD NLOPRM NLPARM NLRESTART NLSTRESS NLSTEP NOUTPUT OEFTTSU
    OFREQUENCY OMODES OPRESS OSTNINI OTEMP OTIME OTMFORC OUTRCV PACCELERATION PAGE
    PANCON PARTN PEAKOUT PLOTID POST PRESSURE PROPERTY PSDF RANDOM RCROSS RIGID RSMETHOD
    ALOAD ELSTRAIN
    SACCELERATION SDISPLACEMENT SEALL SEDR SEDV SEEXCLUDE SEFINAL SEKREDUCE SELGENERATE
    SELREDUCE SEMGENERATE SEMREDUCE SENSITY SERESP SETP SETMC SHELLTHK SKIP SMETHOD
    STATVAR STRFIELD SURFACE SVECTOR SVELOCITY TERMIN THERMAL TRIM TSTEPNL VCCT VOLUME
    VUGRID WEIGHTCHECK XSDAMP
""".split()
# Carried out by name.
_OWN = """
    AUTOSPC OUTPUT PARAM SET SUBCASE SUBCOM SUBSEQ SUBSEQ1 SYM SYMCOM SYMSEQ REPCASE
    TEMPERATURE STATSUB MEFFMASS SUPER EXTSEOUT RESVEC
""".split()

SELECTIONS = (*NUMBERS, "TEMPERATURE", "SUBCASE", "SUBCOM")
KNOWN: frozenset[str] = frozenset(
    (
        *QUANTITIES,
        *NUMBERS,
        *NAMES,
        *TITLES,
        *MODEL_REFUSED,
        *SOLUTION_REFUSED,
        *_WITHOUT_EFFECT,
        *_OWN,
    )
)
_ENOUGH = 4  # letters by which Nastran tells commands apart
NEAR = 0.75  # how alike a word must be to be taken for one: LAOD and LOAD are so


def canonical(word: str) -> str:
    """The command that a word stands for; '' for a word that is none.

    Four letters are enough, and letters after the fourth are not looked at, where that
    leaves one command only.
    """
    if word in KNOWN or len(word) < _ENOUGH:
        return word if word in KNOWN else ""
    found = [name for name in KNOWN if name.startswith(word)]
    if len(found) != 1:
        beginning = word[:_ENOUGH]
        found = [
            name for name in KNOWN if len(name) > _ENOUGH and name.startswith(beginning)
        ]
    return found[0] if len(found) == 1 else ""
