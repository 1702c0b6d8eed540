"""Runways: profiles and friction."""
