"""Mass cases: the deck of a loading, and whether it weighs what it should.

The deck of a mass case is written out, with the point masses that the case adds, scales
and leaves out. What INCLUDE files hold stays in files of the same names, since elements
have components by the names of their files. Everything that starts from the aircraft's
deck, the decks of landing and static cases among it, has that mass.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import numpy as np

from drake_landing.case.mass_cases import MassCase, Span, holds_id
from drake_landing.gears.bodies import mass_points
from drake_landing.gears.landing_gear import LandingGear
from fem.arrays import Float64
from fem.deck.control.case_command_names import canonical
from fem.deck.text.lexer import RawCard, read_cards, without_cards
from fem.deck.text.sections import Sections, split_sections
from fem.deck.text.source import Line, read_source
from fem.deck.text.values import real
from fem.errors import InputError
from fem.files.atomic import written_aside
from fem.model.structure import Structure

_MASS, _INERTIA = 4, range(9, 15)  # fields of CONM2
TOLERANCE = 0.01


def write_mass_case(source: Path, given: MassCase, path: Path, field: str) -> None:
    """The deck of a mass case.

    Args:
        source: the deck.
        given: what changes.
        path: of the file to write; its INCLUDEs are written below `<stem>_includes`.
        field: of the case, `airframe.mass_cases.<name>`, for messages.

    Raises:
        InputError: ids that no CONM2 has, cards that are none, a MASSSET that is not
            there, a deck that cannot be read.
    """
    text = read_source(source)
    sections = split_sections(text.lines, str(source))
    cards = read_cards(sections.bulk).cards
    masses = {int(c.field(1)): c for c in cards if c.name == "CONM2"}
    problems = _unknown(masses, given.remove, f"{field}.remove")
    for i, scaled in enumerate(given.scale):
        problems += _unknown(masses, scaled.elements, f"{field}.scale.{i}.elements")
    sets = [c.field(1) for c in cards if c.name == "MASSSET"]
    if given.massset is not None and str(given.massset) not in sets:
        problems.append(
            f"{field}.massset: found {given.massset}, expected a MASSSET of "
            f"{source.name}: {', '.join(sets) or 'it has none'}"
        )
    added: list[Line] = []
    if given.add is not None:
        added = list(read_source(given.add).lines)
        other = {c.name for c in read_cards(added).cards} - {"CONM2", "ENDDATA"}
        problems += [
            f"{field}.add: found {name} in {given.add.name}, expected CONM2 alone"
            for name in sorted(other)
        ]
    if problems:
        raise InputError(problems)
    factors = {number: _factor(given, number) for number in masses}

    def changed(card: RawCard) -> bool:
        return card.name == "CONM2" and factors[int(card.field(1))] != 1.0

    scaled = [
        _scaled(masses[number], factor)
        for number, factor in factors.items()
        if factor not in (0.0, 1.0)
    ]
    with written_aside(path) as part, part.open("w", encoding="utf-8") as file:
        lines = [
            *_head(sections, given.massset),
            *_with_includes(without_cards(sections.bulk, changed), source, path),
            *scaled,
            *(x.text for x in added if not x.text.upper().startswith("ENDDATA")),
        ]
        for begin, others in sections.parts():
            own = without_cards(others, lambda _: False)
            lines += [begin, *(x.text for x in own)]
        file.writelines(f"{line}\n" for line in (*lines, "ENDDATA"))


def _head(sections: Sections, massset: int | None) -> Iterator[str]:
    """Lines up to BEGIN BULK; a MASSSET takes the place of those of the deck."""
    if not sections.has_control and massset is None and not sections.in_parts:
        return
    yield from (line.text for line in sections.executive)
    yield "CEND"
    if massset is not None:
        yield f"MASSSET = {massset}"
    for line in sections.case_control:
        word = re.split(r"[\s(=]", line.text.strip().upper())[0]
        if massset is None or canonical(word) != "MASSSET":
            yield line.text
    yield "BEGIN BULK"


def _with_includes(lines: list[Line], source: Path, path: Path) -> Iterator[str]:
    """The lines of the deck itself; those of other files are written, and included."""
    folder = path.with_name(f"{path.stem}_includes")
    pieces = groupby(lines, key=lambda line: line.file)
    for number, (file, piece) in enumerate(pieces):
        if Path(file).resolve() == source.resolve():
            yield from (line.text for line in piece)
            continue
        copy = folder / str(number) / Path(file).name
        with written_aside(copy) as part:
            part.write_text("".join(f"{x.text}\n" for x in piece), encoding="utf-8")
        name = copy.relative_to(path.parent).as_posix()
        quote = '"' if "'" in name else "'"
        yield f"INCLUDE {quote}{name}{quote}"


def _factor(given: MassCase, number: int) -> float:
    """On the mass of a CONM2; 0 where it is left out."""
    if holds_id(given.remove, number):
        return 0.0
    factor = 1.0
    for scaled in given.scale:
        if holds_id(scaled.elements, number):
            factor *= scaled.factor
    return factor


def _unknown(
    masses: dict[int, RawCard], spans: tuple[int | Span, ...], field: str
) -> list[str]:
    """Ids and spans that no CONM2 has."""
    return [
        f"{field}: found {span}, but no CONM2 has such an id"
        for span in spans
        if not any(holds_id((span,), number) for number in masses)
    ]


def _scaled(card: RawCard, factor: float) -> str:
    """A CONM2 in free fields, times a factor."""
    fields = [card.field(k) for k in range(15)]
    for k in (_MASS, *_INERTIA):
        if fields[k]:
            fields[k] = repr(factor * real(fields[k]))
    return ",".join(fields[:9]) + "\n," + ",".join(fields[9:])


@dataclass(frozen=True, kw_only=True, eq=False)
class Loaded:
    """Mass and center of gravity of an aircraft, in the deck's axes, gears extended.

    Attributes:
        mass: with gears, kg.
        center: (3,) m.
        inertia: (3, 3) about it, of the airframe and the gears as points, kg m².
        airframe: mass without gears, kg.
    """

    mass: float
    center: Float64
    inertia: Float64
    airframe: float


def loaded(structure: Structure, gears: tuple[LandingGear, ...]) -> Loaded:
    """Mass, center of mass and inertia of an airframe with its gears, in B."""
    own = structure.rigid_mass
    items = [(own.total, own.center), *(p for g in gears for p in mass_points(g))]
    mass = sum(m for m, _ in items)
    center = np.sum([m * np.asarray(p) for m, p in items], axis=0) / mass
    inertia = own.inertia.copy()
    for m, p in items:
        r = np.asarray(p) - center
        inertia += m * (r @ r * np.eye(3) - np.outer(r, r))
    return Loaded(mass=mass, center=center, inertia=inertia, airframe=own.total)


def check_target(
    structure: Structure, gears: tuple[LandingGear, ...], given: MassCase, field: str
) -> None:
    """The mass case weighs what it says.

    Raises:
        InputError: mass off by more than 1 %, or the center of gravity by more than
            the tolerance.
    """
    problems = list(_off_target(loaded(structure, gears), given, field))
    if problems:
        raise InputError(problems)


def _off_target(found: Loaded, given: MassCase, field: str) -> Iterator[str]:
    if given.mass is not None and abs(found.mass / given.mass - 1.0) > TOLERANCE:
        yield (
            f"{field}.mass: found {found.mass:,.1f} kg with gears "
            f"({found.airframe:,.1f} kg without), expected {given.mass:,.1f} kg to 1 %"
        )
    if given.cg is not None:
        away = float(np.linalg.norm(found.center - given.cg))
        if away > given.cg_tolerance:
            x, y, z = found.center
            yield (
                f"{field}.cg: found {x:.3f}, {y:.3f}, {z:.3f} m, {away:.3f} m away, "
                f"expected within {given.cg_tolerance:g} m"
            )
