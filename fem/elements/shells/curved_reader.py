"""CQUAD8 and CTRIA6 cards to blocks: properties, thickness, material axes, shape."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Bool, Float64, Int64
from fem.deck.grids import grids_of
from fem.deck.records import CARDS
from fem.deck.references import column, table, where
from fem.elements.shells.convex import bad_facets
from fem.elements.shells.curved import SURFACES, CurvedShell, material_angle
from fem.elements.shells.material_axes import without_projection
from fem.elements.shells.quadratic_surface import Surface, base
from fem.elements.shells.shell_reader import check_properties, corner_thickness
from fem.errors import InputError, Problems
from fem.geometry.points import Points
from fem.properties.shells import ShellProperty, read_shell_properties, sections

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_curved(deck: "Deck", points: Points, card: str) -> list[CurvedShell]:
    """Blocks of one card: those with PSHELL, then those with PCOMP.

    Elements that lack the same mid-sides are together.

    Raises:
        InputError: undefined references, shapes that cannot be, missing thickness; all
            of them.
    """
    rows = table(deck, card).sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    check_properties(deck, rows, card)
    properties = read_shell_properties(deck, rows["pid"])
    kind = np.array([properties[int(p)].card for p in rows["pid"]])
    topology = CARDS[card].topology
    assert topology is not None
    there = grids_of(rows, topology)[:, topology.corners :] > 0
    blocks, problems = [], Problems()
    for name in ("PSHELL", "PCOMP"):
        for present in np.unique(there[kind == name], axis=0):
            part = rows[(kind == name) & (there == present).all(axis=1)]
            part = part.reset_index(drop=True)
            surface = SURFACES[card]
            if not present.all():
                surface = surface.without(present.tolist())
            with problems.gathered():
                blocks.append(_block(deck, points, part, card, surface, properties))
    problems.report()
    return blocks


def _block(
    deck: "Deck",
    points: Points,
    rows: pd.DataFrame,
    card: str,
    surface: Surface,
    properties: dict[int, ShellProperty],
) -> CurvedShell:
    topology = CARDS[card].topology
    assert topology is not None
    grids, corners = grids_of(rows, topology), surface.corners
    at = points.rows(grids[:, grids[0] > 0])
    nodes = points.xyz[at]
    bad, texts = bad_facets(nodes[:, :corners])
    if len(bad):
        raise InputError(
            f"{where(card, rows.iloc[i])}: {text}" for i, text in zip(bad, texts)
        )
    _check_folds(rows, card, surface, nodes)
    pids, which = np.unique(rows["pid"].to_numpy(np.int64), return_inverse=True)
    used = tuple(properties[int(p)] for p in pids)
    thickness = corner_thickness(rows, card, used, which, corners)
    theta, towards = _material(points, rows, nodes)
    center = base(surface, nodes, surface.results[:1])
    normal = without_projection(towards, center.normal[:, 0])
    # Isotropic elements take the first tangent, which changes nothing.
    isotropic = np.array([p.isotropic for p in used])[which]
    towards[normal & isotropic] = np.nan
    angle = material_angle(center, theta, towards)[:, 0]
    text = "the x axis of its material system MCID is normal to the element"
    text += ", expected a direction in its plane"
    _refuse(rows, card, normal & ~isotropic, text)
    return CurvedShell(
        card=card,
        id=rows["eid"].to_numpy(np.int64),
        dof=(6 * at[:, :, None] + np.arange(6)).reshape(len(rows), -1),
        pid=rows["pid"].to_numpy(np.int64),
        property_card=used[0].card,
        corners=nodes[:, :corners],
        offset=column(rows, "zoffs"),
        normals=np.zeros((len(rows), corners, 3)),
        section=sections(list(used), which, angle, thickness),
        k6rot=deck.number("K6ROT"),
        properties=used,
        which=which,
        angle=angle,
        surface=surface,
        nodes=nodes,
        corner_thickness=thickness,
        theta=theta,
        towards=towards,
        oblique=_oblique(points, at, base(surface, nodes, surface.nodes).normal),
    )


def _oblique(points: Points, at: Int64, normal: Float64) -> Bool:
    """(e, n) whether normals (e, n, 3) are no axes of their grids' systems."""
    along = np.abs(np.einsum("enij,eni->enj", points.rotation[at], normal))
    return along.max(axis=2) < 1.0 - 1e-12


def _refuse(rows: pd.DataFrame, card: str, bad: Bool, text: str) -> None:
    if bad.any():
        raise InputError(
            f"{where(card, rows.iloc[i])}: {text}" for i in np.flatnonzero(bad)
        )


def _check_folds(
    rows: pd.DataFrame, card: str, surface: Surface, nodes: Float64
) -> None:
    """Refuse elements that are folded over: the normal turns against the center's."""
    center = base(surface, nodes, surface.results[:1]).normal
    for p in (surface.nodes, surface.points):
        here = base(surface, nodes, p)
        turned = np.einsum("eqi,ei->eq", here.normal, center[:, 0]).min(axis=1)
        _refuse(rows, card, ~(turned > 0.0), "it is folded over: a mid-side is too far "
                "from the middle of its edge, or out of order")  # fmt: skip


def _material(
    points: Points, rows: pd.DataFrame, nodes: Float64
) -> tuple[Float64, Float64]:
    """(e,) THETA in rad, and (e, 3) x axis of MCID at the center, NaN without one."""
    mcid = rows["mcid"].to_numpy(np.int64)
    towards = np.full((len(rows), 3), np.nan)
    given = mcid >= 0
    if given.any():
        center = nodes[given].mean(axis=1)
        towards[given] = points.frames.triads(mcid[given], center)[:, :, 0]
    return np.radians(column(rows, "theta")), towards


def _reader(card: str) -> Callable[["Deck", Points], list[CurvedShell]]:
    return lambda deck, points: read_curved(deck, points, card)


read_cquad8, read_ctria6 = _reader("CQUAD8"), _reader("CTRIA6")
