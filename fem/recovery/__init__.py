"""Element results, forces of constraint and extremes from displacements."""
