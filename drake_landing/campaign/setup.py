"""What all landings of one airframe share, prepared once and read by every worker.

A campaign may have several airframes: mass cases, other decks, other selections of
modes. Each has a setup for its landings and the screening, and a second one, larger,
for direct transients. Both are files; workers read them when they first need them and
verify the digest that the campaign gave them.

They are kept in the campaign's folder under a key of everything that they follow from.
A run that goes on reads them again: modes that are computed anew may differ in the last
digit, or in sign, and amplitudes of landings belong to the very modes they flew with.
The files are pickles, which can run any code: they are signed with a secret of the
user, in the folder of the cache, and what somebody else left in a folder is not read.
"""

import hashlib
import hmac
import json
import os
import pickle
import secrets
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np
import pandas as pd
import scipy.sparse as sp

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import load_airframe
from drake_landing.cache import Cache, content_key, source_key
from drake_landing.campaign.basis import ScreeningBasis, screening_basis
from drake_landing.case.schema import Case
from drake_landing.gears.bodies import mass_points
from drake_landing.parts.cuts import BeamCuts
from drake_landing.parts.monitors import Station, without_maps
from drake_landing.parts.slices import balanced
from drake_landing.parts.stress_maps import StressPart
from drake_landing.parts.stress_rows import Map, StressRows, stress_maps
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.full_response import parts_watch
from drake_landing.progress import Reporter
from drake_landing.versions import versions
from fem.algebra.damping import Damping
from fem.algebra.extension import CondensedProduct, Extension
from fem.arrays import Float64, Int64
from fem.files.atomic import written_aside
from fem.model.structure import Structure
from systems.airframe.modal_body import ModalBody


@dataclass(frozen=True, kw_only=True)
class LandingSetup:
    """The part of a setup that landings and their screening need.

    Attributes:
        body: the modal body, axes A.
        node_id: (k,) nodes that loads act on.
        basis: of the screening.
        rows: elements with stresses, without their maps.
        steady: per part, stresses of steady flight; None: not known.
        cuts: beam -> its cuts, without their maps.
        stations: monitor points of the deck, without their maps.
        elements: id, card, component, material, x, y, z, allowed of each, in the order
            of the rows.
        highest_hz: of the modes.
    """

    body: ModalBody = field(repr=False)
    node_id: Int64
    basis: ScreeningBasis = field(repr=False)
    rows: tuple[StressRows, ...] = field(repr=False)
    steady: list[np.ndarray] | None = field(repr=False)
    cuts: Mapping[str, BeamCuts] = field(repr=False)
    stations: tuple[Station, ...] = field(repr=False)
    elements: pd.DataFrame = field(repr=False)
    highest_hz: float


@dataclass(frozen=True, kw_only=True)
class TransientSetup:
    """The part of a setup that direct transients of the full model need.

    Attributes:
        stiffness, mass, damping: of the free set.
        mass_product: products with the mass by its factors.
        pattern: (f, 6 k) loads on the nodes.
        maps: of the rows, part by part, on extended vectors.
        extension: of vectors of the free set.
    """

    stiffness: sp.csr_matrix = field(repr=False)
    mass: sp.csr_matrix = field(repr=False)
    mass_product: CondensedProduct = field(repr=False)
    damping: Damping = field(repr=False)
    pattern: sp.csr_matrix = field(repr=False)
    maps: tuple[Map, ...] = field(repr=False)
    extension: Extension = field(repr=False)


@dataclass(frozen=True, kw_only=True)
class SetupFile:
    """A setup on disk.

    Attributes:
        path: of the file.
        digest: of its content.
    """

    path: Path
    digest: str


@dataclass(frozen=True, kw_only=True)
class Prepared:
    """An airframe of the campaign, ready.

    Attributes:
        key: of everything that landings and screening depend on beside the case.
        landing, transient: its files.
        shapes: file with the displacements by the amplitudes of the screening.
        aircraft: as the process made it.
        setup: what the first file holds.
        ultimate_factor: of the case's margins.
    """

    key: str
    landing: SetupFile
    transient: SetupFile
    shapes: SetupFile
    aircraft: Aircraft = field(repr=False)
    setup: LandingSetup = field(repr=False)
    ultimate_factor: float

    @cached_property
    def structure(self) -> Structure:
        """The full model, read again."""
        return self.aircraft.structure()

    @cached_property
    def shape(self) -> Float64:
        """(f, n + 6 k) displacements by the amplitudes of the screening."""
        found = _read(str(self.shapes.path), self.shapes.digest)
        assert isinstance(found, np.ndarray)
        return found


def airframe_key(case: Case) -> str:
    """Hash of what decides about the airframe: cases with one key share a setup."""
    gears = () if isinstance(case.gears, str) else case.gears
    held = [sorted(g.attachments.values()) for g in gears]
    return content_key(
        case.airframe.model_dump_json(), case.parts.model_dump_json(), held
    )


def prepare(case: Case, folder: Path, progress: Reporter) -> Prepared:
    """Deck, modes, static answers, stress modes: read from the folder, or put there.

    Args:
        case: the first of those that share the airframe.
        folder: for the files of the setup.
        progress: told the stages.

    Raises:
        InputError: deck, gears or places are at fault.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with case.reading():
        aircraft = prepare_aircraft(case, folder)
    key = _input_key(case, aircraft)
    files = _kept(folder, key)
    if files is None:
        with case.reading():
            files = _compute(case, aircraft, folder, key, progress)
    setup = read_landing_setup(files["landing"])
    return Prepared(
        key=_key(key, setup),
        landing=files["landing"],
        transient=files["transient"],
        shapes=files["shapes"],
        aircraft=aircraft,
        setup=setup,
        ultimate_factor=case.parts.ultimate_factor,
    )


def _key(inputs: str, setup: LandingSetup) -> str:
    """Hash of the inputs and of the modes, which may differ when made anew."""
    basis = setup.basis
    return content_key(
        inputs,
        dict(vars(setup.body)),
        [*basis.stress, *basis.sections.values(), *basis.monitors.values()],
        setup.steady,
    )


def _input_key(case: Case, aircraft: Aircraft) -> str:
    """Hash of all that modes, static answers and stress modes depend on."""
    matrices = case.airframe.matrices
    files = [*aircraft.files]
    files += [] if matrices is None else [*matrices.files, matrices.grids]
    masses = [
        mass_points(gear) for gear in aircraft.gears
    ]  # they hang in steady flight
    chosen = None
    if case.airframe.select.by_relevance:  # by the pulses of these gears
        gears = [gear.model_dump_json() for gear in aircraft.gears]
        chosen = [case.scenario.model_dump_json(), *gears]
    return content_key(
        source_key("fem", "systems", "drake_landing"),
        versions(),
        [_digest(path.read_bytes()) for path in files],
        case.airframe.model_dump_json(),
        case.parts.model_dump_json(),
        [int(node) for node in aircraft.multibody_nodes],
        [sorted(gear.attachments.items()) for gear in aircraft.gears],
        masses,
        chosen,
    )


def _compute(
    case: Case, aircraft: Aircraft, folder: Path, key: str, progress: Reporter
) -> dict[str, SetupFile]:
    """Makes the files of an airframe that has no sound ones; files of other keys go."""
    progress.stage(f"{aircraft.name}: deck, matrices, modes")
    structure = aircraft.structure()
    airframe = load_airframe(
        case.airframe, aircraft, progress, case.scenario, Cache.of_user(), structure
    )
    lifting = (*aircraft.lift_nodes, *aircraft.further_lift_nodes)
    nodes = np.unique([*aircraft.attachment_nodes, *lifting])
    progress.stage(f"{aircraft.name}: static answers, stress modes, section loads")
    steady = None
    if aircraft.steady_load is not None:
        flight = balanced(structure, aircraft.steady_load(structure))
        steady = flight.displacement[:, 0]
    watch = parts_watch(case, aircraft, structure, nodes, steady)
    maps, cuts = stress_maps(watch.stresses), watch.cuts
    answers = screening_basis(
        structure, airframe.basis, nodes, maps, cuts, watch.stations
    )
    setup = LandingSetup(
        body=airframe.body,
        node_id=nodes,
        basis=_slim(answers),
        rows=tuple(map(_without_map, maps.rows)),
        steady=None if steady is None else maps.of(steady),
        cuts={name: _without_maps(c) for name, c in cuts.items()},
        stations=tuple(map(without_maps, watch.stations)),
        elements=watch.rows,
        highest_hz=airframe.highest_hz,
    )
    transient = TransientSetup(
        stiffness=structure.stiffness,
        mass=structure.mass,
        mass_product=structure.mass_product,
        damping=structure.damping,
        pattern=sp.csr_matrix(structure.operator(nodes, frame="basic").T),
        maps=maps.maps(),
        extension=maps.extension,
    )
    for old in (*folder.glob("*.setup"), *folder.glob("*.kept.json")):
        old.unlink()
    parts = {"landing": setup, "transient": transient, "shapes": answers.shape}
    files = {n: _write(folder / f"{n}-{key}.setup", part) for n, part in parts.items()}
    with written_aside(folder / f"{key}.kept.json") as part:  # last: all are there
        digests = {name: file.digest for name, file in files.items()}
        kept = {"digests": digests, "signature": _signature(key, digests)}
        part.write_text(json.dumps(kept, indent=1), encoding="utf-8")
    return files


def _kept(folder: Path, key: str) -> dict[str, SetupFile] | None:
    """The files of a key, where all are there as they were written."""
    with suppress(OSError, ValueError, KeyError, TypeError):
        kept = json.loads((folder / f"{key}.kept.json").read_text(encoding="utf-8"))
        digests, found = kept["digests"], {}
        signature = _signature(key, digests)
        if not (signature and hmac.compare_digest(signature, kept["signature"])):
            return None
        for name in ("landing", "transient", "shapes"):
            path = (folder / f"{name}-{key}.setup").resolve()
            if _digest(path.read_bytes()) != digests[name]:
                return None
            found[name] = SetupFile(path=path, digest=digests[name])
        return found
    return None


def _signature(key: str, digests: Mapping[str, str]) -> str:
    """Signature of files that this user wrote; empty where no secret can be kept."""
    secret = _secret()
    if secret is None:
        return ""
    text = json.dumps([key, sorted(digests.items())]).encode()
    return hashlib.blake2b(text, key=secret, digest_size=32).hexdigest()


def _secret() -> bytes | None:
    """32 bytes that only this user can read, made when they are first needed."""
    folder = Cache.of_user().folder
    if folder is None:
        return None
    path = folder / "secret"
    with suppress(OSError):  # it is there already, or none can be made
        folder.mkdir(parents=True, exist_ok=True)
        number = os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
        with os.fdopen(number, "wb") as file:
            file.write(secrets.token_bytes(32))
    with suppress(OSError):
        found = path.read_bytes()
        return found if len(found) == 32 else None
    return None


def read_landing_setup(file: SetupFile) -> LandingSetup:
    """The setup that a worker flies with; it keeps the last two that it read.

    Raises:
        ValueError: the file is not the one that the campaign wrote.
    """
    found = _read(str(file.path), file.digest)
    assert isinstance(found, LandingSetup)
    return found


def read_transient_setup(file: SetupFile) -> TransientSetup:
    """See `read_landing_setup`."""
    found = _read(str(file.path), file.digest)
    assert isinstance(found, TransientSetup)
    return found


def _slim(basis: ScreeningBasis) -> ScreeningBasis:
    """Without the displacements, which workers need not."""
    return ScreeningBasis(
        node_id=basis.node_id,
        modes=basis.modes,
        shape=np.zeros((0, basis.shape.shape[1])),
        stress=basis.stress,
        sections=basis.sections,
        monitors=basis.monitors,
    )


def _without_map(rows: StressRows) -> StressRows:
    nothing = sp.csr_matrix((0, 0))
    part = StressPart(id=rows.part.id, operator=nothing, pieces=rows.part.pieces)
    return replace(rows, part=part)


def _without_maps(cuts: BeamCuts) -> BeamCuts:
    nothing = np.zeros(0, np.int64)
    return replace(cuts, of_acceleration=sp.csr_matrix((0, 0)), strip=nothing)


def _write(path: Path, value: object) -> SetupFile:
    data = pickle.dumps(value, protocol=5)
    with written_aside(path) as part:
        part.write_bytes(data)
    return SetupFile(path=path.resolve(), digest=_digest(data))


def _digest(data: bytes) -> str:
    return hashlib.blake2b(data, digest_size=16).hexdigest()


@lru_cache(maxsize=2)
def _read(path: str, digest: str) -> object:
    data = Path(path).read_bytes()
    if _digest(data) != digest:
        raise ValueError(f"{path}: is not the setup that the campaign wrote")
    return pickle.loads(data)  # ours: the digest came with the task
