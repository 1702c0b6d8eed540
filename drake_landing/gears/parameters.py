"""Gear data as the parameters of the systems."""

import math

from drake_landing.gears.parts import Brake, PitchDamper, ShockAbsorber, Tyre
from systems.gear.bogie_pitch import BogiePitchParameters
from systems.gear.brake import AntiSkid, BrakeParameters
from systems.shock_absorber.gas_spring import GasSpring, SecondChamber
from systems.shock_absorber.strut_law import ShockAbsorberParameters
from systems.tire.slip import SineSlip, TabulatedSlip
from systems.tire.tire_law import TireParameters
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
    return ShockAbsorberParameters(
        gas=gas,
        max_stroke=data.stroke,
        compression_damping=data.compression_damping,
        rebound_damping=data.rebound_damping,
        compression_metering=_table(data.compression_metering),
        rebound_metering=_table(data.rebound_metering),
        extension_stop_stiffness=data.extension_stop_stiffness,
        bottoming_stop_stiffness=data.compression_stop_stiffness,
        stop_damping=data.stop_damping,
        seal_friction=data.seal_friction,
        bearing_friction=data.bearing_friction,
        axle_arm=data.axle_arm,
        bearing_distance=data.bearing_distance,
    )


def tire_parameters(data: Tyre) -> TireParameters:
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
    return TireParameters(
        radius=data.radius,
        stiffness=stiffness,
        nominal_force=data.nominal_force,
        damping=_table(data.damping_table) or data.damping,
        bottoming_deflection=data.bottoming_deflection,
        bottoming_stiffness=data.bottoming_stiffness,
        slip=slip,
        lateral_friction_ratio=data.lateral_friction_ratio,
        relaxation_length=data.relaxation_length,
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


def _table(pairs: list[tuple[float, float]] | None) -> Table | None:
    return None if pairs is None else Table(*map(tuple, zip(*pairs)))
