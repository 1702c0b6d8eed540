"""Decks of a folder against the result files beside them.

    python -m benchmarks.suite DIR [--json FILE]

Every deck that has an OP2 or F06 file of another program beside it is run as `fem` runs
it; displacements, frequencies, forces of constraint, element forces and stresses are
compared, and the deck is right, wrong, without a common result, refused (why) or
crashed. Public suites are fetched by whoever wants to run this; nothing of them is kept
here.
"""
