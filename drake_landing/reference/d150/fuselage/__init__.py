"""The shell fuselage of the FULL aircraft, one component per module."""

from drake_landing.reference.d150.fuselage.shell import (
    FuselageShell,
    add_fuselage_shell,
)

__all__ = ["FuselageShell", "add_fuselage_shell"]
