"""Names of cases in lines of limited width, as Nastran's case control has them."""

from collections.abc import Sequence

_WORDS = (  # as few of them as it takes
    ("starboard", "stbd"),
    ("(i) held at the axle", "(i) axle"),
    ("(ii) by inertia", "(ii) inertia"),
    ("forward", "fwd"),
    ("main gears", "mains"),
    ("towed at", "tow"),
    (" at 30 deg", " 30 deg"),
    ("wheel turned", "turned"),
    ("inclined reactions", "inclined"),
)


def labels(names: Sequence[str], width: int) -> list[str]:
    """Each name within the width; names that differ stay different.

    Long words become short ones first, then the middle goes; where that makes two
    alike, the place in the list stands at the end.
    """
    short = [_shortened(name, width) for name in names]
    first: dict[str, str] = {}
    told = []
    for number, (name, text) in enumerate(zip(names, short, strict=True), 1):
        if first.setdefault(text.upper(), name) != name:
            end = f" #{number}"
            text = text[: width - len(end)] + end
        told.append(text)
    return told


def _shortened(name: str, width: int) -> str:
    name = name.replace("°", " deg")
    for long, brief in _WORDS:
        if len(name) <= width:
            return name
        name = name.replace(long, brief)
    if len(name) <= width:
        return name
    tail = (width - 2) // 2
    return f"{name[: width - 2 - tail]}..{name[-tail:]}"
