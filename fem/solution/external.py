"""EXTSEOUT: a component whose modes another run takes up.

Its modes are those with its boundary (BSET, ASET) held, its generalised coordinates
(QSET) at rest, as Nastran finds them in SOL 103; CSET stays free. All interior
freedoms take part. Files for the assembly are not written here.
"""

from dataclasses import replace

import numpy as np
import pandas as pd

from fem.deck.control.subcase import Subcase
from fem.deck.deck import Deck

NOTICE = (
    "EXTSEOUT: the modes are those with the boundary (BSET, ASET) held; files for an "
    "assembly are not written, `drake-landing reduce` writes K and M"
)


def with_boundary_held(deck: Deck) -> Deck:
    """The deck whose subcases with EXTSEOUT hold its boundary, in SOL 103."""
    boundary = deck.cards["ASET"]
    boundary = _held(boundary, deck.cards["CSET"])
    boundary = boundary[~boundary["id"].isin(deck.cards["QSET"]["id"])]
    if deck.sol != 103 or boundary.empty:
        return deck
    spc, union = deck.cards["SPC"], deck.cards["SPCADD"]
    used = {*spc["sid"].tolist(), *union["sid"].tolist()}
    sid = max((*used, *(c.spc for c in deck.case_control)), default=0) + 1
    rows = {"sid": sid, "g": boundary["id"], "c": boundary["c"], "d": 0.0}
    rows |= {"file": boundary["file"], "line": boundary["line"]}
    held = pd.DataFrame(rows).reindex(columns=spc.columns)
    cases, unions = [], []
    for k, case in enumerate(deck.case_control):
        if not case.extseout:
            cases.append(case)
            continue
        cases.append(replace(case, spc=sid if not case.spc else sid + 1 + k))
        if case.spc:
            unions.append({"sid": sid + 1 + k, "sets": _sets(union, case, sid)})
    more = pd.DataFrame(unions).reindex(columns=union.columns)
    cards = dict(deck.cards)
    cards["ASET"] = deck.cards["ASET"].iloc[:0]
    cards["SPC"] = pd.concat([spc, held], ignore_index=True)
    if unions:
        cards["SPCADD"] = pd.concat([union, more], ignore_index=True)
    return replace(deck, cards=cards, case_control=tuple(cases))


def _held(boundary: pd.DataFrame, free: pd.DataFrame) -> pd.DataFrame:
    """Rows of ASET without the components that CSET leaves free."""
    digits: dict[int, str] = {}
    for point, c in zip(free["id"].tolist(), free["c"].astype(str)):
        digits[point] = digits.get(point, "") + c
    kept = [
        "".join(d for d in str(c) if d not in digits.get(point, ""))
        for point, c in zip(boundary["id"].tolist(), boundary["c"])
    ]
    boundary = boundary.assign(c=kept)
    return boundary.loc[boundary["c"] != ""]


def _sets(union: pd.DataFrame, case: Subcase, sid: int) -> np.ndarray:
    own = union["sets"][union["sid"] == case.spc]
    found = [case.spc] if own.empty else [int(i) for i in own.iloc[0]]
    return np.array([*found, sid], np.int64)
