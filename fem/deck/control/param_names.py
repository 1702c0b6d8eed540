"""PARAM values: names known here, their defaults, and those that change nothing."""

from typing import TypeAlias

Value: TypeAlias = int | float | str

# Parameters that the solutions look at, with Nastran's defaults.
DEFAULTS: dict[str, Value] = {
    "ALPHA1": 0.0,
    "ALPHA2": 0.0,
    "AUTOSPC": "YES",
    "BAILOUT": 0,
    "CB1": 1.0,
    "CB2": 1.0,
    "CK1": 1.0,
    "CK2": 1.0,
    "CM1": 1.0,
    "CM2": 1.0,
    "CP2": 1.0,
    "COUPMASS": -1,
    "DFREQ": 1e-5,
    "ENFMOTN": "ABS",
    "EPZERO": 1e-8,
    "G": 0.0,
    "GRDPNT": -1,
    "HFREQ": 1e30,
    "INREL": 0,
    "K6ROT": 100.0,
    "KDAMP": 1,
    "LFREQ": 0.0,
    "LMODES": 0,
    "POST": 0,
    "RESVEC": "YES",
    "SNORM": 20.0,
    "W3": 0.0,
    "W4": 0.0,
    "WTMASS": 1.0,
}

# System cells that the solutions look at: of the NASTRAN statement, no PARAM.
CELLS: dict[str, Value] = {"BARMASS": 0}

# Printing, files, checks: nothing to do with the answer.
WITHOUT_EFFECT = frozenset(
    """
    AUTOMSET CHECKOUT CSEID DBALL DBDICT DDRMM ERROR EXTOUT GEOMCHECK
    GRAVDIR GRAVFELD GPECT HDF5 IRES KDAMPFE LANGLE LGDISP LINC MAXLINES MAXRATIO MODACC
    MPCX NASPRT NEWSEQ NLINES NOCOMPS NOELOF NOELOP NOGPF NT OEE OELMOPT OGEOM OGPS
    OMACHPR OMAXR OMID OPGEOM OPPHIPB OPTEXIT OSWELM OSWPPT OUGCORD OUNIT2 PATVER
    PBAA PBHH PDRG PRFMODES PRGPST PRINT PROUT PRPA PRPHIVZ PRPJ PRTMAXIM RESPATH
    RMCSET S1G S1M SEMAP SESDAMP SIGMA STRESS TABID TABS TESTNEG TINY UNITSYS UNSYMF
    USETPRT USETSEL USETSTR1 XFLAG XYUNIT
    """.split()
)


def convert(name: str, value: Value) -> Value:
    """A value in the type of the parameter's default, where it has one.

    Raises:
        ValueError: it cannot be; the text says what was expected.
    """
    default = DEFAULTS.get(name)
    if isinstance(default, float):
        if isinstance(value, str):
            raise ValueError("a real number")
        return float(value)
    if isinstance(default, int):
        if isinstance(value, float) and value == int(value):
            return int(value)
        if not isinstance(value, int):
            raise ValueError("an integer")
        return value
    if isinstance(default, str) and not isinstance(value, str):
        raise ValueError("a word")
    return value
