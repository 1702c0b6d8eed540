"""The transient of a landing, found again where nothing that it depends on changed."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.cache import Arrays, Cache, content_key, source_key
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.landing.history import POINT
from drake_landing.parts.observers import PartsWatch
from fem.model.structure import Structure
from fem.recovery.envelope import Envelope

Response = dict[str, pd.DataFrame]

_EXTREMES = ("smallest", "largest", "time_of_smallest", "time_of_largest")


def response_key(
    structure: Structure,
    scheme: str,
    loads: Sequence[AttachmentLoads],
    points: Mapping[str, int],
    watch: PartsWatch,
    envelopes: Sequence[Envelope],
) -> str:
    """Hash of everything that a transient depends on, the program's text included."""
    b = structure.damping
    return content_key(
        source_key("fem", "drake_landing.parts", "drake_landing.transient"),
        [structure.stiffness, structure.mass, b.other],
        [b.stiffness_factor, b.mass_factor, scheme],
        [[load.time, load.node_id, load.load] for load in loads],
        structure.operator([*loads[0].node_id, *points.values()], frame="basic"),
        watch.content,
        [[e.name, e.table.table, e.table.id, e.table.operator] for e in envelopes],
    )


def kept_response(
    cache: Cache,
    key: str,
    points: Mapping[str, int],
    watch: PartsWatch,
    envelopes: Sequence[Envelope],
    respond: Callable[[], Response],
) -> Response:
    """Accelerations of the points; watch and envelopes hold what they would have found.

    Args:
        cache: where it may be found.
        key: of `response_key`.
        points: name -> grid id.
        watch, envelopes: observers of the transient.
        respond: integrates.
    """
    found = cache.find("response", key)
    if found is not None:
        _restore(found, watch, envelopes)
        index = pd.Index(found["time"], name="time")
        return {
            point: pd.DataFrame(values, columns=list(POINT), index=index)
            for point, values in zip(points, found["response"])
        }
    response = respond()
    tables = list(response.values())
    arrays: Arrays = {
        "time": tables[0].index.to_numpy(),
        "response": np.stack([table.to_numpy() for table in tables]),
        **watch.arrays(),
    }
    for i, envelope in enumerate(envelopes):
        arrays |= {f"envelope{i}_{name}": getattr(envelope, name) for name in _EXTREMES}
    cache.keep("response", key, arrays)
    return response


def _restore(
    found: Mapping[str, npt.NDArray], watch: PartsWatch, envelopes: Sequence[Envelope]
) -> None:
    watch.restore(found)
    for i, envelope in enumerate(envelopes):
        for name in _EXTREMES:
            setattr(envelope, name, found[f"envelope{i}_{name}"])
