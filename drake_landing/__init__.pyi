from .airframe.body import load_airframe as load_airframe
from .campaign.cases import load_campaign as load_campaign
from .campaign.engine import Pool as Pool
from .campaign.run import CampaignResult as CampaignResult
from .campaign.run import run_campaign as run_campaign
from .campaign.schema import Campaign as Campaign
from .case.reading import load_case as load_case
from .case.reading import parse_case as parse_case
from .case.schema import Case as Case
from .gears.bodies import AddLandingGear as AddLandingGear
from .gears.systems import AddGearSystems as AddGearSystems
from .landing.diagram import LandingDiagram as LandingDiagram
from .landing.diagram import MakeLandingDiagram as MakeLandingDiagram
from .landing.run import fly as fly
from .parametric import ParametricAircraft as ParametricAircraft
from .parametric import WrittenAircraft as WrittenAircraft
from .parametric import register as register
from .process.aircraft import prepare_aircraft as prepare_aircraft
from .process.run import run_case as run_case
from .results.result import ProcessResult as ProcessResult

__version__: str
