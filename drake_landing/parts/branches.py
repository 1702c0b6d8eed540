"""Parts of an airframe that nobody has named: what branches off when planes cut it.

Planes march outward from the center of gravity, aft, fore, to both sides, up and down.
What lies beyond a plane falls into connected pieces; going inward these grow and
merge, and the piece that reaches farthest gives its name to both. A piece is a part of
its own as long as it stands out: at least half as long, beyond the plane, as it is
wide, or as long as wide if it lies beside the plane of symmetry (a swept wing is no
part that points aft). The cuts of a part reach from where it begins to stand out to
its tip.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from drake_landing.parts.cuts import Cutter
from drake_landing.parts.inventory import Inventory
from drake_landing.parts.section_point import Crossing, crossing
from drake_landing.places import Beam, outward_axis
from fem.model.structure import Structure
from fem.model.weight import rigid_modes

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_DIRECTIONS = ("starboard", "port", "fore", "aft", "up", "down")
_PLANES = 24  # in each direction, to find parts
_HALVINGS = 6  # to find where a part begins
_TRIED = 24
_CUTS = 12
_TURNED = 3  # intervals between tried cuts
_SHORT = 0.02  # of the size of the airframe: shorter ones are no parts
_INNER, _OUTER = 0.02, 0.92  # first and last cut, of the length of a part
_LEAST = 1e-3  # of the mass: lighter pieces are no parts, unless they are loaded
_CENTERED, _BESIDE = 0.5, 1.0  # length over width
_SAME = 0.9  # of the mass: parts that share so much are one


@dataclass(frozen=True, kw_only=True)
class Branch:
    """A part that stands out.

    Attributes:
        outward: where to.
        tip: row of its farthest grid.
        root, reach: coordinates along the outward direction where it begins and ends.
        grids: (g,) beyond the root.
    """

    outward: str
    tip: int
    root: float
    reach: float
    grids: npt.NDArray[np.bool_]


def branches(cutter: Cutter, R_AB: Float64, loaded: Sequence[int]) -> list[Branch]:
    """All parts, each once.

    Args:
        cutter: of the structure.
        R_AB: (3, 3).
        loaded: nodes that loads act on.
    """
    structure = cutter.structure
    mass = grid_masses(structure)
    heavy = mass.copy()
    heavy[structure.points.rows(np.array(loaded, np.int64))] += mass.sum()
    finder = _Finder(cutter=cutter, R_AB=R_AB, heavy=heavy, least=_LEAST * mass.sum())
    found: list[Branch] = []
    for outward in _DIRECTIONS:
        for branch in finder.toward(outward):
            own = mass[branch.grids].sum()
            shared = [
                (mass[branch.grids & other.grids].sum(), mass[other.grids].sum())
                for other in found
            ]
            if not any(both > _SAME * max(own, its) for both, its in shared):
                found.append(branch)
    return found


def beams_of_branches(
    cutter: Cutter, R_AB: Float64, loaded: Sequence[int], elements: Inventory
) -> tuple[Beam, ...]:
    """Cuts across every part that stands out, named by component, side and place.

    Args:
        cutter: of the structure.
        R_AB: (3, 3).
        loaded: nodes that loads act on.
        elements: with their components.
    """
    found = branches(cutter, R_AB, loaded)
    tried = [_beam(cutter, branch, R_AB) for branch in found]
    beams = [beam for beam in tried if beam is not None]
    names = [part_name(cutter, beam, elements) for beam in beams]
    return named_apart(cutter, beams, names)


def named_apart(
    cutter: Cutter, beams: Sequence[Beam], names: Sequence[str]
) -> tuple[Beam, ...]:
    """Beams under names; those that share one get their place added.

    The place is where the part begins, along the axis of B in which these lie farthest
    apart.
    """
    roots = np.array([_cut(cutter, b, 0).point for b in beams]).reshape(-1, 3)
    names = list(names)
    for name in {n for n in names if names.count(n) > 1}:
        same = [i for i, n in enumerate(names) if n == name]
        axis = int(np.ptp(roots[same], axis=0).argmax())
        for i in same:
            names[i] = f"{name} at {'xyz'[axis]} = {roots[i, axis]:z.2f} m"
        for k, i in enumerate(same):
            if names.count(names[i]) > 1:
                names[i] += f" ({k + 1})"
    return tuple(replace(b, name=n) for b, n in zip(beams, names))


def part_name(cutter: Cutter, beam: Beam, elements: Inventory) -> str:
    """Component that the cuts of a beam go through, and its side."""
    cut = _cut(cutter, beam, len(beam.stations) // 3)
    component = main_component(cut, elements)
    beside = float(cut.point @ beam.R_AB[1])
    span = float(np.ptp(cutter.structure.points.xyz @ beam.R_AB[1]))
    side = "" if abs(beside) < 0.02 * span else _side(beside)
    if beam.outward in ("starboard", "port"):
        side = beam.outward
    if not component or component in elements.kinds:
        where = "" if side == beam.outward else _WHERE[beam.outward]
        return " ".join(filter(None, [where, "part", side and f"to {side}"]))
    part = "" if side == beam.outward else beam.outward
    return ", ".join(filter(None, [component, side, part]))


def main_component(cut: Crossing, elements: Inventory) -> str:
    """The one with most of the stiffness of what crosses; empty where none does."""
    known = np.isin(cut.id, elements.elements.id)
    if not known.any():
        return ""
    share = np.maximum(cut.stiffness[known], 0.0)
    names = elements.of(cut.id[known]).component.to_numpy()
    return max(
        sorted(set(names)), key=lambda name: (share[names == name].sum(), len(name))
    )


_WHERE = {"aft": "rear", "fore": "forward", "up": "upper", "down": "lower"}


def _side(y: float) -> str:
    return "starboard" if y > 0.0 else "port"


def grid_masses(structure: Structure) -> Float64:
    """(g,) mass at each grid as the model moves without turning, kg."""
    points = structure.points
    moved = rigid_modes(points, np.zeros(3))[:, :3]
    share = np.asarray(structure.matrices.mass @ moved) * moved
    grids = 6 * len(points.grid_id)
    return share[:grids].sum(axis=1).reshape(-1, 6).sum(axis=1) / 3.0


def _cut(cutter: Cutter, beam: Beam, k: int) -> Crossing:
    """What crosses cut k of a beam that has tips or takes all."""
    d, along = beam.direction, float(beam.along[k])
    beyond = cutter.beyond(d, along)
    if beam.tips:
        tips = cutter.structure.points.rows(np.array(beam.tips, np.int64))
        beyond = cutter.held_by(tips, d, along)
    return crossing(cutter.links, cutter.elements, beyond, d, along)


def _beam(cutter: Cutter, branch: Branch, R_AB: Float64) -> Beam | None:
    """Cuts of a part; None where no element that deforms holds it."""
    length = branch.reach - branch.root
    beam = Beam(
        name="",
        outward=branch.outward,
        stations=np.zeros(0),
        tips=(int(cutter.structure.points.grid_id[branch.tip]),),
        R_AB=R_AB,
    )
    sign = beam.direction.sum()
    tried = branch.root + length * np.linspace(_INNER, _OUTER, _TRIED)
    sign = beam.direction.sum()
    found = [
        _cut(cutter, replace(beam, stations=sign * tried[[k]]), 0)
        for k in range(_TRIED)
    ]
    # Rigid arms and masses on them are no places to cut a part.
    elastic = np.flatnonzero([len(cut.id) > 0 for cut in found])
    if not len(elastic):
        return None
    first, last = int(elastic[0]), int(elastic[-1])
    points = np.array([cut.point for cut in found[first : last + 1]])
    low, high = _straight(points, beam.direction)
    along = np.linspace(tried[first + low], tried[first + high], _CUTS)
    return replace(beam, stations=sign * along)


def _straight(point: Float64, d: Float64) -> tuple[int, int]:
    """First and last of the points (n, 3) between which these run along d.

    Where they go aside more than ahead for some cuts, the part has turned into another:
    a fuselage into the fin, a wing into its winglet.
    """
    step = np.diff(point, axis=0)
    ahead = step @ d
    turned = np.linalg.norm(step - np.outer(ahead, d), axis=1) > ahead
    many = np.convolve(turned, np.ones(_TURNED), "valid") == _TURNED
    start = len(point) // 3
    after = np.flatnonzero(many[start:])
    before = np.flatnonzero(many[:start])
    high = start + int(after[0]) if len(after) else len(point) - 1
    low = int(before[-1]) + _TURNED if len(before) else 0
    return min(low, start), high


@dataclass(frozen=True, kw_only=True)
class _Finder:
    cutter: Cutter
    R_AB: Float64
    heavy: Float64
    least: float

    def toward(self, outward: str) -> list[Branch]:
        """Parts that stand out in one direction, the heaviest first."""
        d = outward_axis(outward, self.R_AB)
        structure = self.cutter.structure
        s = structure.points.xyz @ d
        start, end = float(structure.rigid_mass.center @ d), float(s.max())
        if end - start <= self.cutter.tolerance:
            return []
        planes = start + (end - start) * (np.arange(_PLANES) + 0.5) / _PLANES
        inner: dict[int, int] = {}
        for k in range(_PLANES)[::-1]:
            for tip in self._parts(outward, float(planes[k])):
                inner[tip] = k
        found = []
        short = _SHORT * float(np.ptp(structure.points.xyz, axis=0).max())
        for tip, k in inner.items():
            low = float(planes[k - 1]) if k else start + 2.0 * self.cutter.tolerance
            root = self._root(outward, tip, low, float(planes[k]))
            grids = self.cutter.held_by(np.array([tip]), d, root)
            branch = Branch(
                outward=outward, tip=tip, root=root, reach=float(s[tip]), grids=grids
            )
            if branch.reach - root >= short:
                found.append(branch)
        return sorted(found, key=lambda b: -float(self.heavy[b.grids].sum()))

    def _root(self, outward: str, tip: int, low: float, high: float) -> float:
        """Innermost plane between two beyond which the part of a tip stands out."""
        if tip in self._parts(outward, low):
            return low
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            if tip in self._parts(outward, middle):
                high = middle
            else:
                low = middle
        return high

    def _parts(self, outward: str, along: float) -> list[int]:
        """Farthest grids of the pieces beyond a plane that stand out."""
        d = outward_axis(outward, self.R_AB)
        p = self.cutter.structure.points.xyz
        piece = self.cutter.links.pieces(self.cutter.beyond(d, along))
        own = np.flatnonzero(piece >= 0)
        number = piece[own]
        count = int(number.max(initial=-1)) + 1
        mass = np.bincount(number, self.heavy[own], minlength=count)
        # One piece after the other, each with its grids together.
        order = np.argsort(number, kind="stable")
        starts = np.searchsorted(number[order], np.arange(count))
        ends = np.append(starts[1:], len(order))
        found = []
        for k in np.flatnonzero(mass > self.least):
            grids = own[order[starts[k] : ends[k]]]
            tip = int(grids[np.argmax(p[grids] @ d)])
            length = float(p[tip] @ d) - along
            if self._stands_out(p[grids], p[grids], d, length):
                # A corner of a large sheet is no part: what is cut counts as its width.
                own_only = np.zeros(len(p), bool)
                own_only[grids] = True
                link, _, _ = self.cutter.links.crossing(own_only)
                cut = self.cutter.links.grid[np.isin(self.cutter.links.link, link)]
                if self._stands_out(p[grids], p[cut], d, length):
                    found.append(tip)
        return found

    def _stands_out(self, p: Float64, wide: Float64, d: Float64, length: float) -> bool:
        """Whether a part (g, 3) is long as compared with what is wide of it (k, 3)."""
        size = np.ptp(wide, axis=0) if len(wide) else np.zeros(3)
        width = float(size[np.abs(d) < 0.5].max())
        y = p @ self.R_AB[1]
        middle = float(self.cutter.structure.rigid_mass.center @ self.R_AB[1])
        beside = y.min() > middle or y.max() < middle
        lateral = abs(float(d @ self.R_AB[1])) > 0.5
        return length >= (_BESIDE if beside and not lateral else _CENTERED) * width
