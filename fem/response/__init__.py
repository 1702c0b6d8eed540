"""Transient response, direct and modal. It knows no deck."""
