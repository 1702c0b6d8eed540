"""Algebra of structures: solvers, eigenvalues, reduction, damping. It knows no deck."""
