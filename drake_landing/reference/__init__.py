"""The reference aircraft D150 and the paper's studies of it.

The process reaches the aircraft through `drake_landing.parametric` alone, as it would a
user's own.
"""
