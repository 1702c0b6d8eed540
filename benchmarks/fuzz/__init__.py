"""Inputs that are damaged at random: `python -m benchmarks.fuzz`."""
