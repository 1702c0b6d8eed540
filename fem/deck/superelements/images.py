"""Images of superelements: SEBULK n REPEAT or MIRROR of a primary one.

An image has the bulk data of its primary but the loads, and loads of its own. A mirror
image is reflected by the plane of SEMPLN, as its primary's bulk data stand, then placed
by its SELOC. Displacements inside stand in the axes of the model, not in reflected
ones; elements keep the order of their grids. Pressure of a mirror image acts along the
reflected normals (NX Nastran's `see101nd` to its printed digits); other loads of mirror
images are refused, as which axes they stand in is not known here.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.deck import Deck
from fem.deck.records import CARDS
from fem.deck.text.lexer import Bulk, RawCard
from fem.geometry.coordinates import resolve

_TYPES = ("REPEAT", "MIRROR")
# What reflection leaves as it is, or what is reflected here.
_REFLECTED = {
    *("GRID", "POINT", "SPOINT", "CORD", "GRDSET", "PARAM", "PLOTEL"),
    *("CROD", "CONROD", "CTUBE", "PROD", "PTUBE", "CONM2", "RBE2"),
    *("CQUAD4", "CTRIA3", "CQUADR", "CTRIAR", "CQUAD8", "CTRIA6", "PSHELL", "MAT1"),
    *("SPC", "SPC1", "SPCADD", "ASET", "CSET", "QSET", "BSET", "OMIT", "EIGRL"),
    *("SENQSET", "NSM", "NSM1", "NSML", "NSML1", "NSMADD"),
}
_NEAR_AXIS = 1e-5
_PRESSURE = {"PLOAD": ("p",), "PLOAD2": ("p",), "PLOAD4": ("p1", "p2", "p3", "p4")}
_INERTIAL = (
    "GRAV",
    "RFORCE",
    "ACCEL",
    "ACCEL1",
    "LOAD",
)  # of the whole model, see `join`


def images(deck: Deck) -> dict[int, int]:
    """Superelement -> its primary, of the images of SEBULK in the main section."""
    rows = deck.cards["SEBULK"]
    rows = rows[rows["type"].isin(_TYPES)]
    return dict(zip(rows["seid"].tolist(), rows["rseid"].tolist()))


def check_images(deck: Deck, primaries: set[int]) -> list[str]:
    """Problems of images: sections and cards that they need.

    Args:
        deck: main bulk data.
        primaries: superelements with bulk data of their own.
    """
    problems, copies = [], images(deck)
    places, planes = _by_number(deck, "SELOC"), _by_number(deck, "SEMPLN")
    for _, row in deck.cards["SEBULK"].iterrows():
        number, primary = int(row["seid"]), int(row["rseid"])
        if number not in copies:
            continue
        said = f"{row['file']}:{row['line']}: SEBULK {number} {row['type']}"
        if primary in copies or primary not in primaries:
            problems.append(
                f"{said} of superelement {primary}: expected one with BEGIN SUPER = "
                f"{primary} that is no image itself"
            )
        if row["type"] == "MIRROR" and number not in planes:
            problems.append(f"{said}: expected SEMPLN {number} with the plane")
        if primary in places and number not in places:
            problems.append(
                f"{said}: its primary is placed by SELOC {primary}; expected SELOC "
                f"{number} with the place of the image"
            )
    return problems


def with_primary(own: Bulk | None, primary: Bulk) -> Bulk:
    """Cards of an image: those of its primary but loads, then its own."""
    kept = [card for card in primary.cards if not _is_load(card)]
    if own is None:
        return replace(primary, cards=kept)
    return replace(own, cards=[*kept, *own.cards])


def _is_load(card: RawCard) -> bool:
    return card.name == "LOAD" or (card.name in CARDS and CARDS[card.name].load)


def _by_number(deck: Deck, name: str) -> dict[int, pd.Series]:
    return {int(row["seid"]): row for _, row in deck.cards[name].iterrows()}


def mirrored(deck: Deck, part: Deck, number: int, problems: list[str]) -> Deck:
    """Bulk data of an image by MIRROR, reflected; others as they are.

    Args:
        deck: main bulk data.
        part: cards of the image, as its primary has them, and its loads.
        number: superelement.
        problems: what cannot be reflected is added here.
    """
    kinds = dict(zip(deck.cards["SEBULK"]["seid"], deck.cards["SEBULK"]["type"]))
    if kinds.get(number) != "MIRROR":
        return part
    found = _plane(deck, number)
    if isinstance(found, str):
        problems.append(found)
        return part
    origin, normal = found
    said = f"superelement {number}: an image by MIRROR"
    own = {name for name, table in part.cards.items() if len(table)}
    others = sorted(own - _REFLECTED - {*_PRESSURE, *_INERTIAL})
    directed = part.cards["PLOAD4"]
    if directed[["n1", "n2", "n3"]].to_numpy(float).any():
        others.append("PLOAD4 with a direction")
    if others:
        problems.append(
            f"{said} is not supported with {', '.join(others)}; write it as a "
            "superelement of its own, BEGIN SUPER"
        )
    shells = [n for n in own if "zoffs" in part.cards[n]]
    offset = any(
        np.nan_to_num(part.cards[n]["zoffs"].astype(float)).any() for n in shells
    )
    if (part.cards["GRID"]["cd"] > 0).any() or offset:
        problems.append(f"{said} is not supported with CD of GRID or ZOFFS of shells")
    if np.abs(np.abs(normal).max() - 1.0) > _NEAR_AXIS:
        problems.append(
            f"{said}: the normal of its plane is {normal.round(6).tolist()}, expected "
            "a basic axis"
        )
    if (part.cards["CONM2"]["cid"] != 0).any():
        problems.append(f"{said} is not supported with CID of CONM2")
    if problems:
        return part
    cards = dict(part.cards)
    reflect = np.eye(3) - 2.0 * np.outer(normal, normal)
    for name in ("GRID", "POINT"):
        cards[name] = _reflected_points(part, name, reflect, origin)
    cards["CONM2"] = _reflected_masses(part.cards["CONM2"], reflect)
    for name, columns in _PRESSURE.items():
        cards[name] = cards[name].assign(**{c: -cards[name][c] for c in columns})
    return replace(part, cards=cards)


def _plane(deck: Deck, number: int) -> tuple[Float64, Float64] | str:
    """A point of the plane and its unit normal, or what is wrong."""
    row = _by_number(deck, "SEMPLN")[number]
    said = f"{row['file']}:{row['line']}: SEMPLN {number}"
    points = [int(row[f"p{k}"]) for k in (1, 2, 3)]
    both = pd.concat(
        [deck.cards["GRID"], deck.cards["POINT"].assign(cd=0)], ignore_index=True
    )
    absent = [str(p) for p in points if p not in set(both["id"])]
    if absent:
        return f"{said}: point {', '.join(absent)} is not in the main bulk data"
    _, xyz = resolve(deck.cards["CORD"], both)
    order = both["id"].tolist()
    a, b, c = (xyz[order.index(p)] for p in points)
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal)
    if size <= 1e-9 * np.linalg.norm(b - a) * np.linalg.norm(c - a):
        return f"{said}: its three points lie on a line"
    return a, normal / size


def _reflected_points(
    part: Deck, name: str, reflect: Float64, origin: Float64
) -> pd.DataFrame:
    table = part.cards[name]
    if table.empty:
        return table
    _, xyz = resolve(part.cards["CORD"], table)
    xyz = (xyz - origin) @ reflect.T + origin
    return table.assign(cp=0, x1=xyz[:, 0], x2=xyz[:, 1], x3=xyz[:, 2])


def _reflected_masses(table: pd.DataFrame, reflect: Float64) -> pd.DataFrame:
    """Offsets and inertias of CONM2, whose products are those of minus x y."""
    if table.empty:
        return table
    table = table.copy()
    arm = [f"x{k}" for k in (1, 2, 3)]
    table[arm] = table[arm].to_numpy(float) @ reflect.T
    sign = np.sign(np.diag(reflect))
    for i in range(3):
        for j in range(i):
            table[f"i{i + 1}{j + 1}"] *= sign[i] * sign[j]
    return table


def primaries_first(copies: Mapping[int, int], numbers: set[int]) -> list[int]:
    """Superelements in an order in which images follow their primaries."""
    return sorted({*numbers, *copies}, key=lambda n: (n in copies, n))
