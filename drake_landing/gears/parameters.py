"""Gear data as the parameters of the systems."""

import math
from dataclasses import replace
from functools import partial
from typing import Any, overload

from drake_landing.gears.gear_parts import Brake, PitchDamper
from drake_landing.gears.shock_absorber_data import ShockAbsorber
from drake_landing.gears.tire_data import Tire
from systems.gear.bogie_pitch import BogiePitchParameters
from systems.gear.brake import AntiSkid, BrakeParameters
from systems.runway.runway import Runway
from systems.shock_absorber.gas_spring import GasSpring, SecondChamber
from systems.shock_absorber.orifice_damper import Metering
from systems.shock_absorber.orifice_network import OrificeNetwork
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tire.aircraft_tire import (
    SMALL_SLIP_TRAIL,
    TireSize,
    inflation_factor,
)
from systems.tire.magic_formula import MagicFormula
from systems.tire.slip import SineSlip, TabulatedSlip
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters
from systems.tools.grid import Grid
from systems.tools.table import Table


def shock_absorber_parameters(data: ShockAbsorber) -> ShockAbsorberParameters:
    """Parameters of the system `ShockAbsorber`; ValueError where they do not fit."""
    second = data.second_chamber
    gas = GasSpring(
        precharge=data.precharge_force,
        gas_length=data.gas_length,
        exponent=data.gas_exponent,
        area=data.piston_area,
        second=second
        and SecondChamber(
            precharge=second.precharge_force,
            gas_length=second.gas_length,
            exponent=second.gas_exponent,
        ),
    )
    oil = None
    if data.oil_bulk_modulus and data.oil_volume and data.piston_area:
        oil = data.oil_bulk_modulus * data.piston_area**2 / data.oil_volume
    closing, opening = _metering(data)
    single = data.compression_damping is None
    return ShockAbsorberParameters(
        gas=gas,
        max_stroke=data.stroke,
        compression_damping=1.0 if single else data.compression_damping or 0.0,
        rebound_damping=1.0 if single else data.rebound_damping or 0.0,
        compression_metering=closing,
        rebound_metering=opening,
        thermal_time=data.thermal_time,
        oil_stiffness=oil,
        extension_stop_stiffness=data.extension_stop_stiffness,
        bottoming_stop_stiffness=data.compression_stop_stiffness,
        stop_damping=data.stop_damping,
        seal_friction=data.seal_friction,
        bearing_friction=data.bearing_friction,
        axle_arm=data.axle_arm,
        bearing_distance=data.bearing_distance,
    )


def _metering(data: ShockAbsorber) -> tuple[Metering, Metering]:
    """Factors on the damping coefficients; the coefficients themselves where there are
    orifices or a map.
    """
    if data.orifices is not None:
        areas = data.orifices
        network = OrificeNetwork(
            piston_area=areas.piston_area,
            main=_area(areas.main),
            density=areas.density,
            discharge=areas.discharge,
            relief_pressure=areas.relief_pressure,
            relief_area=areas.relief_area,
            relief_band=areas.relief_band,
            recoil_area=areas.recoil_area,
            recoil_compression=areas.recoil_compression,
            recoil_rebound=_area(areas.recoil_rebound),
        )
        return network.damping(data.stroke)
    if data.damping_map is not None:
        found = data.damping_map
        closing, opening = (
            Grid(
                found.strokes,
                found.rates,
                [[f / (v * v) for f, v in zip(row, found.rates)] for row in rows],
            )
            for rows in (found.compression, found.rebound)
        )
        return closing, opening
    return _table(data.compression_metering), _table(data.rebound_metering)


def _area(value: float | list[tuple[float, float]] | None) -> Any:
    return _table(value) if isinstance(value, list) else value


def tire_parameters(data: Tire) -> TireParameters:
    """Parameters of `systems.tire.tire`; ValueError where they do not fit."""
    table = _table(data.friction_table)
    slip = (
        TabulatedSlip(table=table)
        if table
        else SineSlip(
            peak=data.friction_peak,
            shape=data.friction_shape,
            stiffness=data.friction_stiffness,
        )
    )
    stiffness = data.stiffness or _table(data.load_table)
    assert stiffness is not None  # the data's own validation
    factor = inflation_factor(data.inflation)
    if isinstance(stiffness, Table):
        stiffness = Table(stiffness.x, [factor * force for force in stiffness.y])
    else:
        stiffness = factor * stiffness
    plain = TireParameters(
        radius=data.radius,
        stiffness=stiffness,
        nominal_force=factor * data.nominal_force,
        damping=_table(data.damping_table) or data.damping,
        bottoming_deflection=data.bottoming_deflection,
        bottoming_stiffness=data.bottoming_stiffness,
        slip=slip,
        lateral_friction_ratio=data.lateral_friction_ratio,
        relaxation_length=data.relaxation_length,
        rolling_radius=_rolling_radius(data),
        hysteresis=data.hysteresis,
        rolling_resistance=data.rolling_resistance,
        magic_formula=data.magic_formula and MagicFormula.from_file(data.magic_formula),
    )
    size = _size(data)
    along = across = None
    if data.carcass == "elastic":
        along, across = data.fore_aft_stiffness, data.lateral_stiffness
        if size is not None:
            along = along or size.over_deflection(size.fore_aft_stiffness)
            across = across or size.over_deflection(size.lateral_stiffness)
    return replace(
        plain,
        cornering=_cornering(data, size, TireLaw(plain, Runway())),
        trail=_trail(data, size),
        fore_aft_stiffness=along,
        lateral_stiffness=across,
    )


def _size(data: Tire) -> TireSize | None:
    if data.width is None or data.pressure is None:
        return None
    return TireSize(
        diameter=2.0 * data.radius,
        width=data.width,
        rated_pressure=data.pressure,
        inflation=data.inflation,
    )


def _rolling_radius(data: Tire) -> float | Table:
    if isinstance(data.rolling_radius, str):
        return {"effective": 1.0 / 3.0, "loaded": 1.0}[data.rolling_radius]
    return _table(data.rolling_radius)


def _cornering(data: Tire, size: TireSize | None, law: TireLaw) -> Table | None:
    """Side force per angle (N/rad) over deflection (m)."""
    over_load: Any
    if data.cornering_slope is not None:
        over_load = partial(float.__mul__, data.cornering_slope)
    elif data.cornering_table is not None:
        over_load = _table(data.cornering_table).value
    elif size is not None:
        over_load = size.cornering_power
    else:
        return None
    x = [data.radius * i / 160 for i in range(81)]
    return Table(x, [over_load(law.elastic_force(d)) for d in x])


def _trail(data: Tire, size: TireSize | None) -> Table | None:
    """Pneumatic trail at small angles (m) over deflection (m)."""
    if data.pneumatic_trail is not None:
        trail = data.pneumatic_trail
        return Table((0.0, 1.0), (trail, trail)) if trail else None
    if size is None:
        return None
    return size.over_deflection(
        lambda d: SMALL_SLIP_TRAIL * size.half_contact_length(d)
    )


def brake_parameters(data: Brake) -> BrakeParameters:
    """Parameters of `systems.gear.brake`; ValueError where they do not fit."""
    torque = _table(data.torque_table) if data.torque is None else data.torque
    assert torque is not None  # the data's own validation
    skid = data.anti_skid
    return BrakeParameters(
        torque=torque,
        anti_skid=skid
        and AntiSkid(
            onset=skid.onset,
            release=skid.release,
            protection_load=skid.protection_load,
        ),
    )


def bogie_pitch_parameters(data: PitchDamper) -> BogiePitchParameters:
    """Parameters of `systems.gear.bogie_pitch`; ValueError where they do not fit."""
    return BogiePitchParameters(
        trim=math.radians(data.trim_deg),
        stiffness=data.stiffness,
        max_moment=data.max_moment,
        damping=data.damping,
        quadratic_damping=data.quadratic_damping,
        stop=None if data.stop_deg is None else math.radians(data.stop_deg),
        stop_stiffness=data.stop_stiffness,
    )


@overload
def _table(pairs: list[tuple[float, float]]) -> Table: ...
@overload
def _table(pairs: None) -> None: ...
def _table(pairs: list[tuple[float, float]] | None) -> Table | None:
    return None if pairs is None else Table(*map(tuple, zip(*pairs)))
