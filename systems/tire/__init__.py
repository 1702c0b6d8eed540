"""Tyres and their slip."""
