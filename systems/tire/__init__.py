"""Tires and their slip."""
