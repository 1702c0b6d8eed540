"""Welds and fasteners between surfaces: CWELD, CFAST."""
