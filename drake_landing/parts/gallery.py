"""Which pictures of the stress field a report shows, and what it says below them."""

from pathlib import Path

import numpy as np
import numpy.typing as npt

from drake_landing.case.parts import Parts
from drake_landing.parts.buckling import BuckledPanels
from drake_landing.parts.field_pictures import (
    can_draw,
    draw_field,
    mode_field,
    stress_field,
)
from drake_landing.parts.observers import PartsFound
from drake_landing.parts.stress import Stresses
from drake_landing.parts.stress_observer import Snapshot
from drake_landing.parts.tables import component_table
from fem.files.escaping import file_name
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

_CLOSE_UPS = 2
_UNABLE = (
    "No pictures of the stress field: VTK cannot draw off-screen on this machine (no "
    "graphics library, or switched off)."
)


def stress_pictures(
    out: Path,
    structure: Structure,
    stresses: Stresses,
    found: PartsFound,
    parts: Parts,
    R_AB: Float64,
    steady: Float64 | None = None,
) -> tuple[list[tuple[Path, str]], str]:
    """The whole airframe when its worst element sees its worst, and close-ups; before
    them steady flight, (f,) displacements where they are known.

    Returns:
        PNG files in `out/pictures` with captions, and a sentence where there are none.
    """
    components = component_table(found.judged, parts.ultimate_factor)
    components = components[components.component.isin(list(found.worst))]
    if not len(components):
        return [], ""
    if not can_draw():
        return [], _UNABLE
    up, aft = R_AB[2], R_AB[0]
    pictures: list[tuple[Path, str]] = []
    if steady is not None:
        pictures.append(_steady_picture(out, structure, stresses, steady, R_AB))
    worst = components.iloc[0]
    snapshot = found.worst[worst.component]
    field = stress_field(structure, stresses, snapshot)
    path = out / "pictures" / "stress_all.png"
    top = draw_field(path, field, close=False, up=up, aft=aft)[1]
    least = "highest stress" if np.isnan(worst.margin) else "least margin"
    upon = "" if found.total is None else ", steady flight included"
    pictures.append(
        (
            path,
            f"Equivalent stress at {snapshot.time:.3f} s, when the element with the "
            f"{least} sees its worst ({worst.component}, element {worst.id}){upon}. "
            f"Displacements times {field.factor:g}, without the motion as a rigid "
            f"body; the colour scale ends at {top / 1e6:.0f} MPa, which at most 0.5 % "
            "of the elements exceed.",
        )
    )
    by_component = found.landing.stress.groupby("component").id
    for row in components.head(_CLOSE_UPS).itertuples():
        name = str(row.component)
        snapshot = found.worst[name]
        own = frozenset(by_component.get_group(name).tolist())
        field = stress_field(structure, stresses, snapshot, own)
        if not len(field.faces):
            continue  # of sticks the whole shows as much
        path = out / "pictures" / f"stress_{file_name(name)}.png"
        draw_field(path, field, close=True, up=up, aft=aft)
        pictures.append(
            (
                path,
                f"{name[:1].upper()}{name[1:]} alone, at {snapshot.time:.3f} s, round "
                "its worst "
                f"element {snapshot.element} (outlined): "
                f"{row.equivalent / 1e6:.0f} MPa. "
                f"Displacements times {field.factor:g}.",
            )
        )
    return pictures, ""


def _steady_picture(
    out: Path, structure: Structure, stresses: Stresses, steady: Float64, R_AB: Float64
) -> tuple[Path, str]:
    """The stress field that the landing comes upon."""
    equivalent = stresses.of(steady[:, None])[0, :, 0]
    element = int(stresses.id[int(equivalent.argmax())])
    snapshot = Snapshot(time=0.0, element=element, displacement=steady)
    field = stress_field(structure, stresses, snapshot)
    path = out / "pictures" / "stress_steady.png"
    top = draw_field(path, field, close=False, up=R_AB[2], aft=R_AB[0])[1]
    return path, (
        "Equivalent stress in steady flight at 1 g, before touchdown: the largest is "
        f"{equivalent.max() / 1e6:.0f} MPa in element {element}. Displacements times "
        f"{field.factor:g}; colours end at {top / 1e6:.0f} MPa, another scale than "
        "below."
    )


def buckling_pictures(
    out: Path,
    structure: Structure,
    buckled: BuckledPanels | None,
    found: PartsFound,
    R_AB: Float64,
) -> list[tuple[Path, str]]:
    """The mode of the panel that buckles first: the whole, and a close-up of its
    component, which others may hide.
    """
    if buckled is None or buckled.table.empty or not can_draw():
        return []
    first, stress = buckled.table.iloc[0], found.landing.stress
    own = frozenset(stress.id[stress.component == first.component].tolist())
    pictures = []
    for name, close, chosen in (("all", False, None), ("close", True, own)):
        element = int(first["id"])
        field = mode_field(structure, buckled.shape, buckled.work, element, chosen)
        if not len(field.faces):
            continue
        path = out / "pictures" / f"buckling_{name}.png"
        draw_field(path, field, close=close, up=R_AB[2], aft=R_AB[0])
        where = (
            f"the component alone, round element {element}, on which most work is done"
            if close
            else "the place marked"
        )
        pictures.append(
            (
                path,
                f"The mode that buckles first ({first.component}, factor "
                f"{first.factor:.3g}), {where}; its size is arbitrary.",
            )
        )
    return pictures
