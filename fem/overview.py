"""What `fem` reads and writes, as a page section made from the program's own tables.

`python -m fem.overview docs/fem.md` puts the section between the marks of the page; a
test keeps both alike.
"""

import re
import sys
from pathlib import Path

from fem.deck.case_commands import QUANTITIES
from fem.deck.catalogue import PASSED_OVER
from fem.deck.params import DEFAULTS
from fem.deck.reader import SUPPORTED
from fem.elements.lines import bar, beam, beam_stations, rod
from fem.elements.scalars import bush, scalar, visc
from fem.elements.shells import shear_panel, shell_recovery
from fem.elements.shells.failure_recovery import failure_names
from fem.elements.solids import solid
from fem.solution.options import WRITTEN

BEGIN, END = "<!-- tables: python -m fem.overview -->", "<!-- end of tables -->"

# Group of a card by its name, first match first.
_GROUPS: tuple[tuple[str, str], ...] = (
    ("Points, frames", r"GRID|GRDSET|SPOINT|CORD.*"),
    ("Rigid elements, constraints", r"RBE\d|RBAR|MPC.*|SPC|SPC1|SPCADD|SUPORT"),
    ("Sets of a reduction", r"[ABQ]SET1?|BNDFIX1?|SE.*"),
    ("Masses", r"CONM\d|CMASS\d|PMASS|NSM.*"),
    ("Line elements", r"C(BAR|BEAM|ROD|ONROD|TUBE|VISC)|P(BAR|BEAM|ROD|TUBE|VISC)L?"),
    ("Defaults of line elements", r"BAROR|BEAMOR"),
    ("Springs, dampers", r"[CP](ELAS|DAMP|BUSH)\d?"),
    ("Shells, panels", r"C(QUAD4|TRIA3|SHEAR)|P(SHELL|COMPG?|SHEAR)"),
    ("Solids", r"C(HEXA|PENTA|TETRA|PYRAM)|PSOLID"),
    ("Materials", r"MAT\d"),
    ("Matrices", r"DMIG"),
    ("Static loads", r"(FORCE|MOMENT|PLOAD)\d?|GRAV|ACCEL1|RFORCE|SLOAD|SPCD|LOAD"),
    ("Dynamic loads", r"TLOAD\d|DLOAD|LSEQ|DAREA|DELAY|TABLED1|TIC|TSTEP"),
    ("Modes", r"EIGRL?|TABDMP1"),
    ("Other", r"PARAM|PLOTEL"),
)


def groups() -> dict[str, list[str]]:
    """Supported cards by group; a card of no group is a mistake of this module.

    Raises:
        LookupError: a card without a group.
    """
    found: dict[str, list[str]] = {name: [] for name, _ in _GROUPS}
    for card in SUPPORTED:
        for name, pattern in _GROUPS:
            if re.fullmatch(pattern, card):
                found[name].append(card)
                break
        else:
            raise LookupError(f"{card} has no group in fem.overview")
    return found


# Table of the result file -> kind -> columns of one point, and at which points.
_RESULTS: tuple[tuple[str, str, str, tuple[str, ...], str], ...] = (
    ("CBAR", "force", "", bar.FORCE_COLUMNS, "shear, axial force, torque of end A"),
    ("CBAR_ENDS", "force", "", bar.END_COLUMNS, "bars under PLOAD1"),
    ("CBAR", "stress", "strain", bar.STRESS_COLUMNS, ""),
    ("CBEAM", "force", "", beam.FORCE_COLUMNS, "both ends"),
    ("CBEAM", "stress", "strain", beam.STRESS_COLUMNS, "both ends"),
    (
        "CBEAM_STATIONS",
        "force",
        "",
        beam_stations.station_columns(beam_stations.FORCES, 1),
        "stations between with SO YES, suffix _s1, _s2, ...; not under PLOAD1",
    ),
    (
        "CBEAM_STATIONS",
        "stress",
        "strain",
        beam_stations.station_columns(beam_stations.STRESSES, 1),
        "likewise",
    ),
    ("CROD, CONROD, CTUBE", "force", "", rod.COLUMNS, ""),
    ("CROD, CONROD, CTUBE", "stress", "strain", rod.COLUMNS, ""),
    ("CELAS1 ... CELAS4", "force", "stress, strain", scalar.SPRING_COLUMNS, ""),
    ("CDAMP1 ... CDAMP4", "force", "", scalar.DAMPER_COLUMNS, "transients"),
    ("CVISC", "force", "", visc.COLUMNS, "transients"),
    ("CBUSH", "force", "", bush.COLUMNS, "with dashpots in transients"),
    ("CBUSH", "stress", "strain", bush.STRESS_COLUMNS, "by the coefficients RCV"),
    ("CQUAD4, CTRIA3", "force", "", shell_recovery.FORCE, "centre, CORNER: + corners"),
    (
        "CQUAD4, CTRIA3",
        "stress",
        "strain",
        shell_recovery.stress_names(1),
        "both fibres (strains: surface and curvature, FIBER: both fibres)",
    ),
    (
        "CQUAD4_COMPOSITE, CTRIA3_COMPOSITE",
        "stress",
        "strain",
        shell_recovery.ply_names(1),
        "each ply, suffix _p1, _p2, ... from the bottom",
    ),
    (
        "CQUAD4_COMPOSITE, CTRIA3_COMPOSITE",
        "failure",
        "",
        failure_names(1),
        "each ply, with STRESS where PCOMP gives FT or SB",
    ),
    ("CSHEAR", "force", "", shear_panel.FORCE, ""),
    ("CSHEAR", "stress", "strain", shear_panel.STRESS, ""),
    (
        "CHEXA, CPENTA, CTETRA, CPYRAM",
        "stress",
        "strain",
        solid.STRESS,
        "centre, then corners (prefix c1_, c2_, ...)",
    ),
)


def section() -> str:
    """Markdown of the section."""
    params = ", ".join(f"{name} {_short(DEFAULTS[name])}" for name in sorted(DEFAULTS))
    asked = list(dict.fromkeys(QUANTITIES.values()))
    missing = [name for name in asked if "yes" not in _marks(name)]
    return "\n".join(
        [
            "### Cards that are used",
            "",
            *_table("for", "cards"),
            *(_row(name, ", ".join(cards)) for name, cards in groups().items()),
            "",
            "### Cards that are passed over with a notice",
            "",
            *_table("for", "cards"),
            *(_row(name, ", ".join(cards)) for name, cards in PASSED_OVER.items()),
            "",
            "### Parameters that are used, with their defaults",
            "",
            f"{params}.",
            "",
            "### Requests of case control",
            "",
            *_table("request", "SOL 101", "103", "109, 112"),
            *(_row(name, *_marks(name)) for name in asked if "yes" in _marks(name)),
            "",
            f"Not written, and said so: {', '.join(missing)}.",
            "",
            "### Element results in the file",
            "",
            *_table("table", "kinds", "columns", "remark"),
            *(
                _row(table, ", ".join(filter(None, kinds)), " ".join(columns), remark)
                for table, *kinds, columns, remark in _RESULTS
            ),
        ]
    )


def _table(*heads: str) -> list[str]:
    return [_row(*heads), "|" + "---|" * len(heads)]


def _row(*cells: str) -> str:
    return f"| {' | '.join(cells)} |"


def _marks(quantity: str) -> list[str]:
    return ["yes" if quantity in WRITTEN[n] else "-" for n in (101, 103, 109)]


def _short(value: int | float | str) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def with_section(page: str) -> str:
    """A page with the section between its marks.

    Raises:
        ValueError: the page has no marks.
    """
    head, mark, rest = page.partition(BEGIN)
    _, end, tail = rest.partition(END)
    if not (mark and end):
        raise ValueError(f"the page lacks the marks {BEGIN} and {END}")
    return f"{head}{BEGIN}\n{section()}\n{END}{tail}"


if __name__ == "__main__":
    target = Path(sys.argv[1])
    target.write_text(
        with_section(target.read_text(encoding="utf-8")), encoding="utf-8"
    )
