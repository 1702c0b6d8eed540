from .airframe.distributed_load import DistributedLoad as DistributedLoad
from .airframe.flexible_airframe import FlexibleAirframe as FlexibleAirframe
from .airframe.modal_body import ModalBody as ModalBody
from .airframe.modal_recovery import AddModalRecovery as AddModalRecovery
from .airframe.modal_recovery import ModalRecovery as ModalRecovery
from .airframe.quasi_steady_lift import QuasiSteadyLift as QuasiSteadyLift
from .airframe.quasi_steady_lift import Surface as Surface
from .attachment.attachment import RigidAttachment as RigidAttachment
from .attachment.attachment_points import AttachmentPoint as AttachmentPoint
from .attachment.bushing_attachment import BushingAttachment as BushingAttachment
from .gear.bogie_pitch import BogiePitch as BogiePitch
from .gear.bogie_pitch import BogiePitch_ as BogiePitch_
from .gear.bogie_pitch import BogiePitchParameters as BogiePitchParameters
from .gear.brake import AntiSkid as AntiSkid
from .gear.brake import Brake as Brake
from .gear.brake import Brake_ as Brake_
from .gear.brake import BrakeParameters as BrakeParameters
from .gear.elastic_legs import ElasticLeg as ElasticLeg
from .gear.elastic_legs import ElasticLegs as ElasticLegs
from .gear.energy_budget import AddEnergyBudget as AddEnergyBudget
from .gear.energy_budget import EnergyBudget as EnergyBudget
from .gear.gear_forces import GearForces as GearForces
from .gear.lever_strut import LeverGeometry as LeverGeometry
from .gear.lever_strut import LeverStrut as LeverStrut
from .gear.wheel_kinematics import WheelKinematics as WheelKinematics
from .runway.runway import Runway as Runway
from .runway.runway_profile import CosineBump as CosineBump
from .runway.runway_profile import MeasuredProfile as MeasuredProfile
from .runway.runway_profile import Step as Step
from .runway.runway_profile import Waves as Waves
from .shock_absorber.gas_spring import GasSpring as GasSpring
from .shock_absorber.gas_spring import SecondChamber as SecondChamber
from .shock_absorber.shock_absorber import ShockAbsorber as ShockAbsorber
from .shock_absorber.shock_absorber import ShockAbsorber_ as ShockAbsorber_
from .shock_absorber.shock_absorber import StrutState as StrutState
from .shock_absorber.side_load import SideLoad as SideLoad
from .shock_absorber.strut_parameters import (
    ShockAbsorberParameters as ShockAbsorberParameters,
)
from .shock_absorber.strut_parameters import (
    ShockAbsorberTunables as ShockAbsorberTunables,
)
from .tire.magic_formula import MagicFormula as MagicFormula
from .tire.slip import SineSlip as SineSlip
from .tire.slip import TabulatedSlip as TabulatedSlip
from .tire.tire import Tire as Tire
from .tire.tire import Tire_ as Tire_
from .tire.tire import TireContact as TireContact
from .tire.tire import TireTunables as TireTunables
from .tire.tire_parameters import TireParameters as TireParameters
from .tools.grid import Grid as Grid
from .tools.table import Table as Table
