"""Finite elements for people with Nastran decks.

    deck = fem.read_deck("wing.bdf")
    structure = fem.Structure.from_deck(deck)
    modes = fem.normal_modes(structure.stiffness, structure.mass, count=20)

Solutions work on plain sparse matrices: modes, statics, transients and reductions of a
`Structure` or of anybody's own K, M and B. `python -m fem DECK.bdf` runs a deck's own
case control.

Names are imported when they are first used, so that `import fem` is quick.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fem.algebra.damping import Damping as Damping
    from fem.algebra.linear_solver import SingularMatrixError as SingularMatrixError
    from fem.algebra.linear_solver import factorize as factorize
    from fem.algebra.modes import Modes as Modes
    from fem.algebra.modes import ModesError as ModesError
    from fem.algebra.modes import normal_modes as normal_modes
    from fem.algebra.reduction import Reduction as Reduction
    from fem.algebra.reduction import reduce_craig_bampton as reduce_craig_bampton
    from fem.algebra.reduction import reduce_guyan as reduce_guyan
    from fem.algebra.statics import inertia_relief as inertia_relief
    from fem.algebra.statics import solve_static as solve_static
    from fem.deck.deck import Deck as Deck
    from fem.deck.reader import read_deck as read_deck
    from fem.errors import InputError as InputError
    from fem.model.structure import Structure as Structure
    from fem.recovery.elements import element_tables as element_tables
    from fem.recovery.envelope import Envelope as Envelope
    from fem.response.direct import GeneralizedAlpha as GeneralizedAlpha
    from fem.response.direct import NastranScheme as NastranScheme
    from fem.response.direct import TransientLoad as TransientLoad
    from fem.response.direct import direct_transient as direct_transient
    from fem.response.direct import sampled_load as sampled_load
    from fem.response.modal import modal_transient as modal_transient
    from fem.response.modal import residual_vectors as residual_vectors
    from fem.response.observation import Observation as Observation
    from fem.solution import Options as Options
    from fem.solution import run_deck as run_deck

_HOME = {
    "Damping": "algebra.damping",
    "Deck": "deck.deck",
    "Envelope": "recovery.envelope",
    "GeneralizedAlpha": "response.direct",
    "InputError": "errors",
    "Modes": "algebra.modes",
    "ModesError": "algebra.modes",
    "NastranScheme": "response.direct",
    "Observation": "response.observation",
    "Options": "solution",
    "Reduction": "algebra.reduction",
    "SingularMatrixError": "algebra.linear_solver",
    "Structure": "model.structure",
    "TransientLoad": "response.direct",
    "direct_transient": "response.direct",
    "element_tables": "recovery.elements",
    "factorize": "algebra.linear_solver",
    "inertia_relief": "algebra.statics",
    "modal_transient": "response.modal",
    "normal_modes": "algebra.modes",
    "read_deck": "deck.reader",
    "reduce_craig_bampton": "algebra.reduction",
    "reduce_guyan": "algebra.reduction",
    "residual_vectors": "response.modal",
    "run_deck": "solution",
    "sampled_load": "response.direct",
    "solve_static": "algebra.statics",
}

__all__ = sorted(_HOME)  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> object:
    """Import a public name from the module that defines it."""
    home = _HOME.get(name)
    if home is None:
        raise AttributeError(f"module 'fem' has no attribute '{name}'")
    value = getattr(import_module(f"fem.{home}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*globals(), *_HOME]
