"""Coordinate systems and points."""
