"""Section loads over all landings: extremes and hulls, landing by landing.

Hulls of landings are put together and thinned out to their common hull now and then, so
that memory does not grow with the landings.
"""

from dataclasses import dataclass, field

import h5py
import numpy as np
import pandas as pd

from drake_landing.campaign.hulls import hull_rows
from fem.arrays import Float64

EXTREMES = ["name", "station", "quantity", "min", "case_of_min", "time_of_min", "max"]
EXTREMES += ["case_of_max", "time_of_max"]
CORNERS = ["name", "station", "pair", "x", "y", "case", "time"]
_MOST = 200_000  # corners that are kept before they are thinned out


@dataclass(frozen=True, kw_only=True)
class SectionLoads:
    """Section loads of one landing, at the cuts of a part or at a monitor point.

    Attributes:
        station: (n,) m; zero where there is no such thing.
        quantities: names of q loads.
        pairs: two quantities, "shear-bending".
        extreme: (2, n, q, 2) smallest and largest value with its time, s.
        hull_of: (k, 2) cut and pair of each corner of a hull.
        hull: (k, 3) time, s, and both loads.
    """

    station: Float64
    quantities: tuple[str, ...]
    pairs: tuple[str, ...]
    extreme: Float64 = field(repr=False)
    hull_of: Float64 = field(repr=False)
    hull: Float64 = field(repr=False)

    @classmethod
    def from_hdf5(cls, group: h5py.Group) -> "SectionLoads":
        """Reads the section loads of a case file."""
        sides = [
            np.stack([np.asarray(group[k], float) for k in (side, f"time_of_{side}")])
            for side in ("min", "max")
        ]
        extreme = np.moveaxis(np.stack(sides), 1, -1)
        known = "station" in group
        return cls(
            station=np.asarray(
                group["station"] if known else np.zeros(extreme.shape[1])
            ),
            quantities=tuple(str(group["min"].attrs["columns"]).split()),
            pairs=tuple(str(group["hull"].attrs["pairs"]).split("; ")),
            extreme=extreme,
            hull_of=np.asarray(group["hull_of"], float),
            hull=np.asarray(group["hull"], float),
        )


@dataclass
class SectionEnvelope:
    """Section loads of many landings; see `SectionLoads`.

    Attributes:
        station, quantities, pairs: as there.
        extreme: (2, n, q, 3) value, time (s), landing.
        corners: (k, 6) cut, pair, landing, time (s), and both loads.
    """

    station: Float64
    quantities: tuple[str, ...]
    pairs: tuple[str, ...]
    extreme: Float64 = field(repr=False)
    corners: list[Float64] = field(default_factory=list, repr=False)

    @classmethod
    def from_loads(cls, first: SectionLoads) -> "SectionEnvelope":
        """Without any landing, for the cuts of one."""
        extreme = np.zeros((*first.extreme.shape[:3], 3))
        extreme[0, ..., 0], extreme[1, ..., 0] = np.inf, -np.inf
        extreme[..., 2] = -1.0
        return cls(first.station, first.quantities, first.pairs, extreme)

    def add(self, landing: SectionLoads, number: int) -> None:
        """Takes in a landing."""
        for known, found, sign in zip(self.extreme, landing.extreme, (1.0, -1.0)):
            better = sign * found[..., 0] < sign * known[..., 0]
            known[better, :2], known[better, 2] = found[better], number
        case = np.full((len(landing.hull), 1), float(number))
        self.corners.append(np.hstack([landing.hull_of, case, landing.hull]))
        if sum(map(len, self.corners)) > _MOST:
            self.corners = [self.hulls()]

    def hulls(self) -> Float64:
        """(k, 6) corners of the common hulls, cut by cut and pair by pair."""
        every = np.concatenate(self.corners) if self.corners else np.zeros((0, 6))
        order = np.lexsort((every[:, 1], every[:, 0]))  # stable: landings stay in order
        every = every[order]
        ends = np.flatnonzero(np.any(np.diff(every[:, :2], axis=0) != 0.0, axis=1)) + 1
        kept = [own[hull_rows(own[:, 4:])] for own in np.split(every, ends) if len(own)]
        return np.concatenate(kept) if kept else every

    def tables(self, name: str) -> tuple[pd.DataFrame, pd.DataFrame]:
        """Rows of the tables of extremes and of hulls."""
        n, q = self.extreme.shape[1:3]
        extremes = pd.DataFrame(
            {
                "name": name,
                "station": np.repeat(self.station, q),
                "quantity": list(self.quantities) * n,
            }
        )
        for side, found in zip(("min", "max"), self.extreme.reshape(2, n * q, 3)):
            extremes[side] = found[:, 0]
            extremes[f"case_of_{side}"] = found[:, 2].astype(np.int64)
            extremes[f"time_of_{side}"] = found[:, 1]
        cut, pair, case, time, x, y = self.hulls().T
        corners = pd.DataFrame(
            {
                "name": name,
                "station": self.station[cut.astype(int)],
                "pair": np.array(self.pairs, dtype=object)[pair.astype(int)],
                "x": x,
                "y": y,
                "case": case.astype(np.int64),
                "time": time,
            },
            columns=CORNERS,
        )
        return extremes, corners
