"""Names of components from the names of the files that they come from.

`A99_wing_LH_v3.bdf` and `A99_wing_RH_v3.bdf` are the wing: what all files begin with,
sides, issues and what says only that it is a mesh go; short forms are written out.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

_SIDES = frozenset("l r lh rh left right port starboard stbd lhs rhs".split())
_MESH = frozenset(
    "fem fe mesh model bulk elem elems element elements grid grids props prop "
    "property properties nastran final new old copy".split()
)
_ISSUE = re.compile(r"(v|r|rev|ver|version|issue|iss)?\.?\d+[a-z]?", re.I)
_WRITTEN_OUT = {
    **{"fus": "fuselage", "fuse": "fuselage", "fuselage": "fuselage"},
    **{"htp": "tailplane", "htail": "tailplane", "stab": "stabilizer"},
    **{"vtp": "fin", "vtail": "fin", "emp": "empennage"},
    **{"nac": "nacelle", "pyl": "pylon", "eng": "engine", "wng": "wing"},
    **{"ctr": "center", "fwd": "forward", "mlg": "main gear", "nlg": "nose gear"},
    **{"ail": "aileron", "rud": "rudder", "elev": "elevator", "wingbox": "wing box"},
}


def names_of_files(files: Iterable[str]) -> Mapping[str, str]:
    """File -> component; files of two sides share one, other files never do."""
    every = sorted(set(files))
    words = {file: _words(Path(file).stem) for file in every}
    shared = _shared(list(words.values()))
    short = {file: _meant(found[shared:]) for file, found in words.items()}
    without_side = {
        file: tuple(w for w in found if w.lower() not in _SIDES)
        for file, found in words.items()
    }
    names = {}
    for file in every:
        alike = [f for f in every if short[f] == short[file]]
        apart = {without_side[f] for f in alike}
        stem = re.sub(r"[_\s]+", " ", Path(file).stem)
        names[file] = short[file] if short[file] and len(apart) == 1 else stem
    return names


def _shared(names: Sequence[Sequence[str]]) -> int:
    """How many words all names begin with; each has one more."""
    least = min(map(len, names), default=1) - 1
    for k in range(least):
        if len({name[k].lower() for name in names}) > 1:
            return k
    return max(least, 0)


def _words(stem: str) -> list[str]:
    return [w for w in re.split(r"[\s_.\-]+", stem) if w]


def _meant(words: list[str]) -> str:
    kept = [
        _WRITTEN_OUT.get(w.lower(), w.lower())
        for w in words
        if w.lower() not in _SIDES | _MESH and not _ISSUE.fullmatch(w)
    ]
    return " ".join(kept)
