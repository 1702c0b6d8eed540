"""The hybrid process: from a case to its results."""
