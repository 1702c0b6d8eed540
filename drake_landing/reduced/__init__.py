"""Reduced airframes: made from a deck, checked, written, read from somebody else."""

from drake_landing.reduced.model import ReducedModel as ReducedModel
