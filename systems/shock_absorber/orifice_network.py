"""Orifices of a shock absorber with their valves, as damping over stroke and rate.

The piston of area A drives its oil through the main orifice, whose free area a metering
pin makes a function of stroke; a relief valve beside it opens with pressure. On the way
back a recoil chamber of area A_r empties through orifices of its own, which may grow
small near full extension: the snubber. Of an orifice of free area a

    Δp = ρ/2 (q/(C_d a))²,

so a chamber that displaces q = A s' gives the force ρ A³ s'²/(2 (C_d a)²).
"""

import math
from dataclasses import dataclass

from systems.tools.checks import require
from systems.tools.grid import Grid
from systems.tools.table import Table

_STROKES, _RATES, _FASTEST = 41, 41, 8.0  # m/s


@dataclass(frozen=True, kw_only=True)
class OrificeNetwork:
    """Areas and valves; SI.

    Attributes:
        piston_area: m², that displaces oil through the main orifice.
        main: m², free area, or a table of it over stroke (m).
        density: of the oil, kg/m³.
        discharge: C_d.
        relief_pressure: Pa, at which the relief valve begins to open; None: none.
        relief_area: m², of the open valve, beside the main orifice; in compression.
        relief_band: Pa, beyond relief_pressure, over which it opens.
        recoil_area: m², of the recoil chamber; 0: none.
        recoil_compression: m², through which it fills; None: freely.
        recoil_rebound: m², through which it empties, or a table over stroke (m).

    Raises:
        ValueError: a value is out of range; the message names it.
    """

    piston_area: float
    main: float | Table
    density: float = 860.0
    discharge: float = 0.75
    relief_pressure: float | None = None
    relief_area: float = 0.0
    relief_band: float = 1e6
    recoil_area: float = 0.0
    recoil_compression: float | None = None
    recoil_rebound: float | Table | None = None

    def __post_init__(self) -> None:
        for name, unit in (
            ("piston_area", "m²"),
            ("density", "kg/m³"),
            ("discharge", ""),
            ("relief_band", "Pa"),
        ):
            require("orifices", name, getattr(self, name), unit, above=0.0)
        for name in ("relief_area", "recoil_area"):
            require("orifices", name, getattr(self, name), "m²", at_least=0.0)
        if self.relief_pressure is not None:
            require(
                "orifices", "relief_pressure", self.relief_pressure, "Pa", above=0.0
            )
        for name in ("main", "recoil_compression", "recoil_rebound"):
            value = getattr(self, name)
            if value is not None:
                least = min(value.y) if isinstance(value, Table) else value
                require("orifices", name, least, "m²", above=0.0)
        if self.recoil_area > 0.0 and self.recoil_rebound is None:
            raise ValueError(
                "orifices: recoil_area without recoil_rebound, expected the area "
                "through which the recoil chamber empties"
            )

    def damping(self, max_stroke: float) -> tuple[Grid, Grid]:
        """Force over squared rate (N s²/m²) over stroke (m) and rate (m/s): in
        compression, in rebound.
        """
        strokes = [max_stroke * i / (_STROKES - 1) for i in range(_STROKES)]
        rates = [_FASTEST * i / (_RATES - 1) for i in range(_RATES)]
        rates[0] = 1e-3
        return (
            Grid(strokes, rates, [[self._in(s, v) for v in rates] for s in strokes]),
            Grid(strokes, rates, [[self._out(s)] * _RATES for s in strokes]),
        )

    def _in(self, stroke: float, rate: float) -> float:
        flow = self.piston_area * rate / self.discharge
        force = self.piston_area * self._pressure(flow, _area(self.main, stroke))
        through = self.recoil_compression
        if self.recoil_area > 0.0 and through is not None:
            force += self._coefficient(self.recoil_area, through) * rate * rate
        return force / (rate * rate)

    def _out(self, stroke: float) -> float:
        d = self._coefficient(self.piston_area, _area(self.main, stroke))
        if self.recoil_rebound is not None and self.recoil_area > 0.0:
            opening = _area(self.recoil_rebound, stroke)
            d += self._coefficient(self.recoil_area, opening)
        return d

    def _coefficient(self, area: float, opening: float) -> float:
        return 0.5 * self.density * area**3 / (self.discharge * opening) ** 2

    def _pressure(self, flow: float, opening: float) -> float:
        """Pressure that drives flow/C_d through orifice and relief valve, Pa."""
        closed = 0.5 * self.density * (flow / opening) ** 2
        at = self.relief_pressure
        if at is None or closed <= at or self.relief_area == 0.0:
            return closed
        low, high = 0.0, closed
        for _ in range(80):
            p = 0.5 * (low + high)
            share = min(max((p - at) / self.relief_band, 0.0), 1.0)
            area = opening + share * self.relief_area
            through = area * math.sqrt(2.0 * p / self.density)
            low, high = (p, high) if through < flow else (low, p)
        return high


def _area(value: float | Table, stroke: float) -> float:
    return value.value(stroke) if isinstance(value, Table) else value
