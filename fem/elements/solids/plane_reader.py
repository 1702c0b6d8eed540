"""Readers of the cards of `plane.py`, by name."""

from functools import partial

from fem.elements.solids.plane import read_slices

read_cplstn3 = partial(read_slices, card="CPLSTN3")
read_cplstn4 = partial(read_slices, card="CPLSTN4")
read_cplstn6 = partial(read_slices, card="CPLSTN6")
read_cplstn8 = partial(read_slices, card="CPLSTN8")
read_cplsts3 = partial(read_slices, card="CPLSTS3")
read_cplsts4 = partial(read_slices, card="CPLSTS4")
read_cplsts6 = partial(read_slices, card="CPLSTS6")
read_cplsts8 = partial(read_slices, card="CPLSTS8")
