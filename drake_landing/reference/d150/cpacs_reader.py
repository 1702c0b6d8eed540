"""What a CPACS 2 or 3 file says of an aircraft, as facts of the generator.

Read are the planform, incidence and spars of wing, tailplane and fin, the ribs of the
wing's box, the sections and frames of the fuselage and the isotropic materials. A
section stands where the chain of positionings ends: length along a direction swept by
`sweepAngle` and raised by `dihedralAngle`; its chord is the product of the scalings.
Surfaces are told apart by what they are: the largest symmetric one is the wing, the
other one the tailplane, an upright one without symmetry the fin.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from lxml import etree

from drake_landing.reference.d150.cpacs_ribs import Plan, read_ribs
from drake_landing.reference.d150.cpacs_xml import (
    child,
    looked_up,
    number,
    place,
    value_of,
)
from fem.errors import InputError

Float64 = npt.NDArray[np.float64]
_STRUCTURE = "componentSegments/componentSegment/structure"
_ABSENT = 0.0
_MOST_BYTES = 500_000_000
_MOST_SECTIONS = 10_000
_LARGEST = 1000.0  # m: of a section's place and size
_UPRIGHT = 45.0  # deg of rotation about x


@dataclass(frozen=True, kw_only=True)
class Surface:
    """A lifting surface before its rotation.

    Attributes:
        uid: of the file.
        origin: (3,) m; rotation: (3,) deg about x, y, z.
        leading: (n, 3) leading edge of the sections relative to the origin, m.
        chord, thickness: (n,) m; largest thickness of the sections.
        spars: (front, rear), each (k, 2) share of the span and chord fraction; or None.
        symmetric: mirrored about y = 0.
    """

    uid: str
    origin: Float64
    rotation: Float64
    leading: Float64
    chord: Float64
    thickness: Float64
    spars: tuple[Float64, Float64] | None
    symmetric: bool

    @property
    def upright(self) -> bool:
        """Whether its span points up."""
        return abs(float(self.rotation[0])) > _UPRIGHT


@dataclass(frozen=True, kw_only=True)
class CpacsAircraft:
    """The parts of a file that were found; None or empty for what it lacks."""

    name: str
    version: str
    wing: Surface | None
    tailplane: Surface | None
    fin: Surface | None
    ribs: Float64 | None  # (n, 2) of the wing: share of the span, angle, see read_ribs
    fuselage: Float64 | None  # (n, 4): x, width, bottom, top
    frames: dict[str, float]
    materials: dict[str, dict[str, float]]


def read_cpacs(path: Path) -> CpacsAircraft:
    """Reads a file.

    Raises:
        InputError: no such file, no XML (with its line), no CPACS, or no aircraft.
    """
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    if path.stat().st_size > _MOST_BYTES:
        raise InputError(
            f"{path}: {path.stat().st_size / 1e6:,.0f} MB, expected at most "
            f"{_MOST_BYTES / 1e6:,.0f} MB"
        )
    try:
        # Entities are not resolved and nothing is fetched: the file may be anybody's.
        parser = etree.XMLParser(
            resolve_entities=False, no_network=True, huge_tree=True
        )
        root = etree.parse(str(path), parser).getroot()
    except etree.XMLSyntaxError as error:
        raise InputError(f"{path}:{error.lineno}: no XML: {error.msg}") from None
    except (OSError, UnicodeError) as error:
        raise InputError(f"{path}: no XML: {error}") from None
    if etree.QName(root).localname != "cpacs":
        raise InputError(f"{path}: root element <{root.tag}>, expected <cpacs>")
    model = root.find("vehicles/aircraft/model")
    if model is None:
        raise InputError(f"{path}: no vehicles/aircraft/model")
    try:
        return _aircraft(root, model)
    except ValueError as error:
        raise InputError(f"{path}: {error}") from None


def _aircraft(root: Any, model: Any) -> CpacsAircraft:
    profiles = {
        str(p.get("uID")): _list(p, ".//z")
        for p in root.iterfind(".//wingAirfoils/wingAirfoil")
    }
    version = str(root.findtext("header/cpacsVersion") or "?")
    wings = {str(w.get("uID")): w for w in model.iterfind("wings/wing")}
    surfaces = [_surface(wing, profiles, version) for wing in wings.values()]
    level = [s for s in surfaces if s.symmetric and not s.upright]
    level.sort(key=lambda s: -float(np.ptp(s.leading[:, 1]) * s.chord.mean()))
    upright = [s for s in surfaces if s.upright and not s.symmetric]
    fuselage = model.find("fuselages/fuselage")
    return CpacsAircraft(
        name=str(model.findtext("name") or "CPACS aircraft"),
        version=version,
        wing=level[0] if level else None,
        tailplane=level[1] if len(level) > 1 else None,
        fin=upright[0] if upright else None,
        ribs=_ribs(wings[level[0].uid], level[0]) if level else None,
        fuselage=None if fuselage is None else _fuselage(fuselage),
        frames={
            str(f.get("uID")): number(f, "positionX")
            for f in model.iterfind(".//frames/frame")
        },
        materials=_materials(root),
    )


def _surface(wing: Any, profiles: dict[str, Float64], version: str) -> Surface:
    at = _positions(wing)
    size = _vector(wing, "transformation/scaling", 1.0)
    leading, chord, thickness = [], [], []
    for section in wing.iterfind("sections/section"):
        element = child(section, "elements/element")
        scale = size * _vector(section, "transformation/scaling", 1.0)
        scale = scale * _vector(element, "transformation/scaling", 1.0)
        shift = _vector(section, "transformation/translation", 0.0)
        shift = shift + _vector(element, "transformation/translation", 0.0)
        leading.append(at[section.get("uID")] * size + shift)
        chord.append(scale[0])
        # Files of CPACS 2 scale the thickness by y where z says nothing.
        by_y = version.startswith("2") and np.isclose(scale[2], scale[0])
        factor = scale[1] if by_y else scale[2]
        uid = element.findtext("airfoilUID")
        ordinate = looked_up(profiles, uid, element, "airfoilUID")
        thickness.append(float(np.ptp(ordinate)) * factor)
        _require_section(section, leading[-1], chord[-1], thickness[-1])
    if not 2 <= len(leading) <= _MOST_SECTIONS:
        raise ValueError(
            f"{place(wing)} {wing.get('uID')!r} has {len(leading)} sections, "
            f"expected 2 to {_MOST_SECTIONS}"
        )
    if leading[-1][1] == leading[0][1]:
        raise ValueError(f"{place(wing)} {wing.get('uID')!r} has no span along y")
    spars = _spars(wing)
    box = _box(spars)
    return Surface(
        uid=str(wing.get("uID")),
        origin=_vector(wing, "transformation/translation", 0.0),
        rotation=_vector(wing, "transformation/rotation", 0.0),
        leading=np.array(leading),
        chord=np.array(chord),
        thickness=np.array(thickness),
        spars=None if box is None else (spars[box[0]], spars[box[1]]),
        symmetric=wing.get("symmetry") == "x-z-plane",
    )


def _require_section(
    section: Any, leading: Float64, chord: float, thickness: float
) -> None:
    """Raises a ValueError for what is no section of a wing."""
    if np.abs(leading).max() > _LARGEST:
        raise ValueError(f"{place(section)} stands {np.abs(leading).max():.3g} m away")
    if not (0.0 < chord <= _LARGEST and 0.0 < thickness <= chord):
        raise ValueError(
            f"{place(section)} has a chord of {chord:.3g} m and a thickness of "
            f"{thickness:.3g} m, expected 0 < thickness <= chord <= {_LARGEST:g}"
        )


def _box(spars: dict[str, Float64]) -> tuple[str, str] | None:
    """Front and rear spar: the first two; None without two."""
    if len(spars) < 2:
        return None
    front, rear = sorted(list(spars)[:2], key=lambda uid: spars[uid][:, 1].mean())
    return front, rear


def _ribs(wing: Any, surface: Surface) -> Float64 | None:
    """See `read_ribs`; None without a box."""
    spars = _spars(wing)
    box = _box(spars)
    if box is None:
        return None
    plan = Plan(
        y=surface.leading[:, 1],
        x=surface.leading[:, 0],
        chord=surface.chord,
        spars=spars,
        front=box[0],
        rear=box[1],
    )
    return read_ribs(wing.find(_STRUCTURE), plan)


def _positions(body: Any) -> dict[str, Float64]:
    """Section -> end of its chain of positionings."""
    steps: dict[str, tuple[str | None, Float64]] = {}
    for step in body.iterfind("positionings/positioning"):
        sweep, up = (
            np.deg2rad(number(step, name)) for name in ("sweepAngle", "dihedralAngle")
        )
        along = np.array(
            [np.sin(sweep), np.cos(sweep) * np.cos(up), np.cos(sweep) * np.sin(up)]
        )
        steps[str(step.findtext("toSectionUID"))] = (
            step.findtext("fromSectionUID"),
            number(step, "length") * along,
        )
    found: dict[str, Float64] = {}
    for section in body.iterfind("sections/section"):
        p, name, seen = np.zeros(3), section.get("uID"), set()
        while name in steps and name not in seen:
            seen.add(name)
            name, step = steps[name]
            p = p + step
        found[section.get("uID")] = p
    return found


def _spars(wing: Any) -> dict[str, Float64]:
    """uID -> (k, 2) share of the span and chord fraction; of the first segment."""
    segment = wing.find(f"{_STRUCTURE}/spars")
    if segment is None:
        return {}
    points: dict[str | None, tuple[float, float]] = {}
    for point in segment.iterfind("sparPositions/sparPosition"):
        inner = point.find("sparPositionEtaXsi")
        inner = point if inner is None else inner
        found = (number(inner, "eta"), number(inner, "xsi"))
        if not all(0.0 <= share <= 1.0 for share in found):
            raise ValueError(f"{place(inner)} has eta, xsi {found}, expected 0 to 1")
        points[point.get("uID")] = found
    return {
        str(spar.get("uID")): _spar(spar, points)
        for spar in segment.iterfind("sparSegments/sparSegment")
    }


def _spar(spar: Any, points: dict[str | None, tuple[float, float]]) -> Float64:
    uids = [str(uid.text) for uid in child(spar, "sparPositionUIDs").iterchildren("*")]
    found = np.array(sorted(looked_up(points, uid, spar, "position") for uid in uids))
    if len(found) < 2 or np.any(np.diff(found[:, 0]) <= 0.0):
        raise ValueError(
            f"{place(spar)}: expected two or more positions along the span"
        )
    return found


def _fuselage(fuselage: Any) -> Float64 | None:
    """(n, 4) x, width, bottom and top of ellipses, from unit circles scaled."""
    origin = _vector(fuselage, "transformation/translation", 0.0)
    at, rows = _positions(fuselage), []
    for section in fuselage.iterfind("sections/section"):
        element = child(section, "elements/element")
        scale = _vector(section, "transformation/scaling", 1.0)
        scale = scale * _vector(element, "transformation/scaling", 1.0)
        center = origin + at[section.get("uID")]
        center = center + _vector(section, "transformation/translation", 0.0)
        center = center + _vector(element, "transformation/translation", 0.0)
        half_width, half_height = abs(scale[1]), abs(scale[2])
        z = center[2]
        if max(*np.abs(center), half_width, half_height) > _LARGEST:
            raise ValueError(f"{place(section)} is over {_LARGEST:g} m away or wide")
        rows.append([center[0], 2 * half_width, z - half_height, z + half_height])
    table = np.array(sorted(rows))
    if len(table) < 2:
        return None
    return table[np.append(np.diff(table[:, 0]) > 0, True)]


def _materials(root: Any) -> dict[str, dict[str, float]]:
    """Isotropic ones: E and nu from k11 and k12 of the elasticity matrix."""
    found = {}
    for material in root.iterfind(".//materials/material"):
        k11, k12 = material.findtext("k11"), material.findtext("k12")
        if not k11 or not k12 or material.findtext("k22"):
            continue
        a, b = number(material, "k11"), number(material, "k12")
        if not 0.0 < b < a:
            raise ValueError(f"{place(material)}: k11, k12 {a:g}, {b:g}: no material")
        nu = b / (a + b)
        found[str(material.get("uID"))] = {
            "e": a * (1 + nu) * (1 - 2 * nu) / (1 - nu),
            "nu": nu,
            "rho": number(material, "rho"),
            "tension": number(material, "sig11", _ABSENT) or np.nan,
            "shear": number(material, "tau12", _ABSENT) or np.nan,
        }
    return found


def _vector(node: Any, path: str, default: float) -> Float64:
    part = None if node is None else node.find(path)
    if part is None:
        return np.full(3, default)
    return np.array([number(part, axis, default) for axis in "xyz"])


def _list(node: Any, path: str) -> Float64:
    texts = [t for t in (node.findtext(path) or "").split(";") if t.strip()]
    found = np.array([value_of(text, node, "z") for text in texts])
    if not len(found):
        raise ValueError(f"{place(node)} {node.get('uID')!r} has no ordinates")
    return found
