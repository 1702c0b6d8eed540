"""A diagram that is used once goes when its work is done.

Drake keeps a system and its ports alive through each other, and a system in Python
through the methods that compute its ports, in ways that Python's collector cannot see:
a landing that was flown would stay in memory, some megabytes of it, until the process
ends.
"""

from collections.abc import Iterator
from contextlib import contextmanager

from drake_landing.landing.diagram import LandingDiagram

_PEERS = "_pydrake_internal_ref_cycle_peers"  # of Drake 1.5x; without it nothing goes


@contextmanager
def used_once(landing: LandingDiagram) -> Iterator[LandingDiagram]:
    """A landing whose diagram is taken apart at the end.

    Args:
        landing: no simulator, context or system of it may be used any more afterwards.
    """
    try:
        yield landing
    finally:
        for system in (*landing.diagram.GetSystems(), landing.diagram):
            own = getattr(system, "__dict__", {})
            for peer in tuple(own.get(_PEERS, ())):
                getattr(peer, "__dict__", {}).get(_PEERS, set()).clear()
            own.get(_PEERS, set()).clear()
            own.clear()
