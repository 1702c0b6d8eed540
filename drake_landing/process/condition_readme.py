"""README.txt of a folder of `drake-landing conditions`: files, axes and signs."""

from pathlib import Path

from fem.files.atomic import write_aside

README = "README.txt"
_LINES = {
    "conditions.csv": "the cases: paragraph, pose, load factors, accelerations, "
    "imbalance, remarks",
    "gear_places.csv": "where axles and ground points of the gears are in every pose, "
    "ground axes from the center of gravity; its height and the pitch",
    "gear_loads.csv": "loads on the gears, ground axes; loads of zero are left out",
    "attachment_loads.csv": "loads of the gears on the airframe's nodes, deck's axes",
    "worst_stresses.csv": "elements with the largest stresses over all cases",
    "section_loads.csv": "extremes of section loads over all cases, without the 1 g of "
    "flight",
    "monitor_points.csv": "extremes of the deck's monitor points, where it has any",
    "conditions_sol101.bdf": "one SOL 101 deck, a subcase each, in the deck's units",
    "pictures": "loads on the gears as arrows, a case a row; of mirror images one",
}
_SIGNS = """
Units: SI, in the headings; in the column `unit` where rows differ.
Ground axes: aft, starboard, up. Drag is positive aft, side to starboard, vertical up.
Moments and angular accelerations turn right-handed about these axes:
  about aft        positive lifts the starboard wing
  about starboard  positive lifts the nose
  about up         positive turns the nose to port
The usual body axes (forward, starboard, down) have roll and yaw the other way round.
Accelerations are about the aircraft's own axes, which are pitched against the ground.
"""


def write_readme(folder: Path) -> None:
    """Writes what each file is, and the signs."""
    width = max(map(len, _LINES))
    text = "Ground-load conditions as balanced static cases\n\n" + "".join(
        f"{name:<{width}}  {line}\n"
        for name, line in _LINES.items()
        if (folder / name).exists()
    )
    write_aside(
        folder / README,
        lambda to: to.write_text(text + _SIGNS, encoding="utf-8") and None,
    )
