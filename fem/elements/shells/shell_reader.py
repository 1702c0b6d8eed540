"""CQUAD4 and CTRIA3 cards to blocks: properties, thickness, material direction."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Bool, Float64, Int64
from fem.deck.references import column, table, where
from fem.elements.shells.convex import bad_facets
from fem.elements.shells.material_axes import without_projection
from fem.elements.shells.shell import Shell
from fem.elements.shells.shell_geometry import facet
from fem.elements.shells.shell_normals import deck_normals
from fem.errors import InputError, Problems, nearest
from fem.geometry.points import Points, grid_freedoms
from fem.properties.shells import ShellProperty, read_shell_properties, sections

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_shells(deck: "Deck", points: Points, card: str, corners: int) -> list[Shell]:
    """Blocks of one card: those with PSHELL, then those with PCOMP.

    Raises:
        InputError: undefined references, missing thickness, material directions normal
            to the element; all of them.
    """
    rows = table(deck, card).sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    check_properties(deck, rows, card)
    properties = read_shell_properties(deck, rows["pid"])
    normals = deck_normals(deck, points)
    kind = np.array([properties[int(p)].card for p in rows["pid"]])
    blocks, problems = [], Problems()
    for name in ("PSHELL", "PCOMP"):
        part = rows[kind == name].reset_index(drop=True)
        if part.empty:
            continue
        with problems.gathered():
            blocks.append(
                _block(deck, points, part, card, corners, properties, normals)
            )
    problems.report()
    return blocks


def check_properties(deck: "Deck", rows: pd.DataFrame, card: str) -> None:
    """Refuse elements whose property is no shell.

    Raises:
        InputError: all of them.
    """
    known = np.concatenate([table(deck, k)["pid"] for k in ("PSHELL", "PCOMP")])
    absent = rows[~rows["pid"].isin(known)]
    if len(absent):
        ids = sorted(int(i) for i in known)
        raise InputError(
            f"{where(card, users.iloc[0])}"
            + (f" and {len(users) - 1} more" if len(users) > 1 else "")
            + f": property {pid} is no PSHELL or PCOMP of the deck"
            + nearest(str(pid), [str(i) for i in ids])
            for pid, users in absent.groupby("pid", sort=True)
        )


def _block(
    deck: "Deck",
    points: Points,
    rows: pd.DataFrame,
    card: str,
    corners: int,
    properties: dict[int, ShellProperty],
    normals: Float64,
) -> Shell:
    grids = rows[[f"g{k}" for k in range(1, corners + 1)]].to_numpy(np.int64)
    at = points.rows(grids)
    pid = rows["pid"].to_numpy(np.int64)
    pids, which = np.unique(pid, return_inverse=True)
    used = tuple(properties[int(p)] for p in pids)
    xyz = points.xyz[at]
    bad, texts = bad_facets(xyz)
    if len(bad):
        raise InputError(
            f"{where(card, rows.iloc[i])}: {text}" for i, text in zip(bad, texts)
        )
    free = np.array([p.isotropic for p in used])[which]
    angle = _material_angle(points, rows, card, xyz, free)
    thickness = corner_thickness(rows, card, used, which, corners)
    return Shell(
        card=card,
        id=rows["eid"].to_numpy(np.int64),
        dof=grid_freedoms(at),
        pid=pid,
        property_card=used[0].card,
        corners=xyz,
        offset=column(rows, "zoffs"),
        normals=normals[at],
        section=sections(list(used), which, angle, thickness),
        k6rot=deck.number("K6ROT"),
        properties=used,
        which=which,
        angle=angle,
    )


def _material_angle(
    points: Points, rows: pd.DataFrame, card: str, xyz: Float64, isotropic: Bool
) -> Float64:
    """(e,) rad from the element x axis: THETA from side 1-2, or the x axis of MCID.

    Isotropic elements may have a system whose x axis is normal to them: they take side
    1-2, which changes nothing.
    """
    axes = facet(xyz).axes
    mcid = rows["mcid"].to_numpy(np.int64)
    direction = xyz[:, 1] - xyz[:, 0]
    given = mcid >= 0
    if given.any():
        center = xyz[given].mean(axis=1)
        direction[given] = points.frames.triads(mcid[given], center)[:, :, 0]
    x, y, _ = np.einsum("eij,ej->ie", axes, direction)
    normal = given & without_projection(direction, axes[:, 2])
    side = xyz[normal, 1] - xyz[normal, 0]
    x[normal], y[normal], _ = np.einsum("eij,ej->ie", axes[normal], side)
    normal &= ~isotropic
    if normal.any():
        raise InputError(
            f"{where(card, rows.iloc[i])}: the x axis of its material system MCID "
            f"{mcid[i]} is normal to the element, expected a direction in its plane"
            for i in np.flatnonzero(normal)
        )
    return np.arctan2(y, x) + np.where(given, 0.0, np.radians(column(rows, "theta")))


def corner_thickness(
    rows: pd.DataFrame,
    card: str,
    used: tuple[ShellProperty, ...],
    which: Int64,
    corners: int,
) -> Float64:
    """(e, n): T1 ... of the element (TFLAG 1: times T), else T of the property."""
    nominal = np.array([p.thickness for p in used])[which][:, None]
    own = rows[[f"t{k}" for k in range(1, corners + 1)]].to_numpy(float)
    relative = rows["tflag"].to_numpy(np.int64)[:, None] == 1
    own = np.where(relative, own * nominal, own)
    laminate = np.array([p.laminate is not None for p in used])[which][:, None]
    thickness = np.where(np.isnan(own) | laminate, nominal, own)
    bad = ~(thickness > 0.0).all(axis=1)
    if bad.any():
        raise InputError(
            f"{where(card, rows.iloc[i])}: thickness {thickness[i].tolist()} from the "
            f"element and {used[which[i]].card} {used[which[i]].pid}, expected "
            "positive values"
            for i in np.flatnonzero(bad)
        )
    return thickness
