"""Finite elements for people with Nastran decks.

    deck = fem.read_deck("wing.bdf")
    structure = fem.Structure.from_deck(deck)
    modes = fem.normal_modes(structure.stiffness, structure.mass, count=20)

Solutions work on plain sparse matrices: modes, statics, transients and reductions of a
`Structure` or of anybody's own K, M and B. `python -m fem DECK.bdf` runs a deck's own
case control.

Names are imported when they are first used, so that `import fem` is quick.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
