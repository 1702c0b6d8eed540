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
    from fem.damping import Damping as Damping
    from fem.deck.deck import Deck as Deck
    from fem.deck.reader import read_deck as read_deck
    from fem.envelope import Envelope as Envelope
    from fem.errors import InputError as InputError
    from fem.linear_solver import SingularMatrixError as SingularMatrixError
    from fem.linear_solver import factorize as factorize
    from fem.modal_transient import modal_transient as modal_transient
    from fem.modal_transient import residual_vectors as residual_vectors
    from fem.modes import Modes as Modes
    from fem.modes import ModesError as ModesError
    from fem.modes import normal_modes as normal_modes
    from fem.observation import Observation as Observation
    from fem.recovery import element_tables as element_tables
    from fem.reduction import Reduction as Reduction
    from fem.reduction import reduce_craig_bampton as reduce_craig_bampton
    from fem.reduction import reduce_guyan as reduce_guyan
    from fem.solution import Options as Options
    from fem.solution import run_deck as run_deck
    from fem.statics import inertia_relief as inertia_relief
    from fem.statics import solve_static as solve_static
    from fem.structure import Structure as Structure
    from fem.transient import GeneralizedAlpha as GeneralizedAlpha
    from fem.transient import NastranScheme as NastranScheme
    from fem.transient import TransientLoad as TransientLoad
    from fem.transient import direct_transient as direct_transient
    from fem.transient import sampled_load as sampled_load

_HOME = {
    "Damping": "damping",
    "Deck": "deck.deck",
    "Envelope": "envelope",
    "GeneralizedAlpha": "transient",
    "InputError": "errors",
    "Modes": "modes",
    "ModesError": "modes",
    "NastranScheme": "transient",
    "Observation": "observation",
    "Options": "solution",
    "Reduction": "reduction",
    "SingularMatrixError": "linear_solver",
    "Structure": "structure",
    "TransientLoad": "transient",
    "direct_transient": "transient",
    "element_tables": "recovery",
    "factorize": "linear_solver",
    "inertia_relief": "statics",
    "modal_transient": "modal_transient",
    "normal_modes": "modes",
    "read_deck": "deck.reader",
    "reduce_craig_bampton": "reduction",
    "reduce_guyan": "reduction",
    "residual_vectors": "modal_transient",
    "run_deck": "solution",
    "sampled_load": "transient",
    "solve_static": "statics",
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
