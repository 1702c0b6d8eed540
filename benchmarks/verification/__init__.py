"""Verification: every reference and benchmark case beside its figures.

    python -m benchmarks.verification          (make verify)

writes docs/verification.md. A case is a function that returns rows; those that need the
reference decks beside the project take their folder and are skipped where it is absent.
"""
