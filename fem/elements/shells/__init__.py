"""Plates, shells and shear panels."""
