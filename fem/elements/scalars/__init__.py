"""Scalar elements, bushes, dampers and concentrated masses."""
