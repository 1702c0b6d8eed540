"""`landing_sol109.bdf`: runs as it stands, and is read back to prove it."""

from collections.abc import Iterator, Sequence
from datetime import date
from pathlib import Path
from textwrap import wrap

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import AirframeModel
from drake_landing.airframe.damping import PARAMETERS
from drake_landing.airframe.deck_units import in_deck_units
from drake_landing.case.schema import Case
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.transient.deck import (
    model_selections,
    transient_deck,
    write_transient_deck,
)
from drake_landing.versions import versions
from fem.deck.reader import read_deck
from fem.deck.units import in_si, units_of
from fem.errors import InputError
from fem.loads.dynamic import dynamic_excitation, time_steps
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

_UNITS = {
    "SI": "m, kg, s, N, Pa",
    "mm-t-N": "mm, t, s, N, MPa",
    "in-lbf": "in, lbf s2/in, s, lbf, psi",
}
_REMARK = 70  # columns of a remark at the head
_SAME = 1e-7  # of the largest entry: ten digits are written


def write_landing_deck(
    path: Path,
    case: Case,
    aircraft: Aircraft,
    airframe: AirframeModel,
    loads: AttachmentLoads,
    elements: Sequence[int] = (),
    made: Sequence[tuple[str, str]] = (),
) -> None:
    """The complete SOL 109 deck of this landing, in the units of the user's deck.

    Args:
        path: of the file.
        case, aircraft, airframe: of the run.
        loads: on the grid of the transient.
        elements: whose forces and stresses are asked for.
        made: how the run was made, for the head.

    Raises:
        InputError: the user's deck cannot be read any more.
    """
    deck = airframe.structure.deck
    given = case.airframe.damping is not None
    lines = transient_deck(
        aircraft.deck,
        in_deck_units(loads, units_of(aircraft.units)),
        airframe.displacement_axes(loads.node_id),
        output=list(aircraft.monitoring.values()),
        selections=model_selections(airframe.structure.subcase),
        title=f"{case.name}: landing, attachment loads of the multibody run",
        head=list(_head(case, aircraft, deck.ignored, made)),
        elements=elements,
        left_out=deck.ignored,
        params={n: deck.number(n) for n in PARAMETERS if given and deck.number(n)},
        dropped=PARAMETERS if given else (),
    )
    write_transient_deck(path, lines)


def check_landing_deck(
    path: Path, case: Case, airframe: AirframeModel, loads: AttachmentLoads
) -> str:
    """Reads the deck as anybody would and compares it with what the run computed.

    Returns:
        What was found, for the report.

    Raises:
        InputError: it cannot be read, or is another model, or has other loads.
    """
    if case.airframe.matrices is not None:
        return (
            "landing_sol109.bdf has the interface grids and the loads; the matrices of "
            "airframe.matrices are to be added as DMIG"
        )
    deck = read_deck(path)
    units = units_of(case.airframe.units)
    structure = airframe.structure
    again = Structure.from_deck(in_si(deck, units))
    subcase = deck.case_control[0]
    found = [
        ("stiffness", again.stiffness, structure.stiffness),
        ("mass", again.mass, structure.mass),
        ("damping", *(_damping(s) for s in (again, structure))),
    ]
    problems = [
        f"{path}: its {name} is not that of the run"
        for name, one, other in found
        if one.shape != other.shape
        or abs(one - other).max() > _SAME * max(abs(other).max(), 1e-300)
    ]
    steps = [row[:2] for row in time_steps(deck, subcase)]
    wanted = len(loads.time) - 1, loads.step
    # The deck has ten digits of a step.
    if len(steps) != 1 or not np.allclose(steps[0], wanted, rtol=1e-9, atol=0.0):
        problems.append(f"{path}: its time steps are not those of the run")
    excitation = dynamic_excitation(deck, again.points, subcase)
    points = structure.points
    rows = points.dof(loads.node_id[:, None], np.arange(1, 7)[None, :]).ravel()
    written = (excitation.pattern.tocsr()[rows] @ excitation.evaluate(loads.time)).T
    wanted = _in_displacement_axes(in_deck_units(loads, units), airframe)
    error = np.abs(written - wanted).max() / np.abs(wanted).max()
    if error > _SAME:
        problems.append(f"{path}: its loads are {error:.1e} off those of the run")
    if problems:
        raise InputError(problems)
    return (
        "landing_sol109.bdf was read back: same stiffness, mass and damping, loads to "
        f"{error:.0e} of the largest"
    )


def _damping(structure: Structure):
    return structure.damping.matrix(structure.stiffness, structure.mass)


def _in_displacement_axes(loads: AttachmentLoads, airframe: AirframeModel) -> Float64:
    """(t, 6 k)"""
    axes = airframe.displacement_axes(loads.node_id)
    vectors = loads.load.reshape(len(loads.time), len(loads.node_id), 2, 3)
    return np.einsum("kba,tksb->tksa", axes, vectors).reshape(len(loads.time), -1)


def _head(
    case: Case,
    aircraft: Aircraft,
    ignored: Sequence[str],
    made: Sequence[tuple[str, str]],
) -> Iterator[str]:
    """What somebody must know who finds this deck without its run."""
    axes = case.airframe.axes
    yield f"Landing '{case.name}': {aircraft.scenario.story}"
    yield f"Written by drake-landing {versions()['drake-landing']}, {date.today()}"
    yield f"Case: {case.places.file or case.name}"
    yield f"Model: {aircraft.deck.name}"
    yield f"Units: {_UNITS[aircraft.units]}"
    yield f"Frame: basic, flight toward {axes.forward}, up is {axes.up}"
    yield "Loads: gear on airframe at the attachment nodes, increments to the start"
    if ignored:
        yield f"Left out, as the case asked: {', '.join(ignored)}"
    if case.airframe.damping is not None:
        yield "Damping: PARAM of the case in place of the model's"
    for what, value in made:
        yield from wrap(f"{what}: {value}", _REMARK, subsequent_indent="  ")
