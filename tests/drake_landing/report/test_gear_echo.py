"""All gear data stand in the order of their fields, whichever gear has them."""

from drake_landing.reference.d150.gears import landing_gears
from drake_landing.report.gear_echo import gear_echo


def test_what_only_a_later_gear_has_stands_in_its_place() -> None:
    rows = [[cell.text for cell in row] for row in gear_echo(landing_gears(), "x").rows]
    fields = [row[0] for row in rows]
    at = fields.index("tyre.radius")  # the nose gear's tire has a table instead
    assert fields[at + 1 : at + 4] == [
        "tyre.stiffness",
        "tyre.load_table",
        "tyre.damping",
    ]
    assert rows[at + 1][2:] == ["–", "2e+06", "2e+06"]
    assert len(set(fields)) == len(fields)
