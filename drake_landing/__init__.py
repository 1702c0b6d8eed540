"""Landing loads: a Nastran deck lands in Drake, and its full model says what it sees.

    from drake_landing import load_case, run_case

    result = run_case(load_case("case.yaml"), "out/case")
    campaign = run_campaign(load_campaign("campaign.yaml"), "out/campaign")

For diagrams by hand: `MakeLandingDiagram`, `AddLandingGear`, `AddGearSystems`, and the
systems of the package `systems`; finite elements alone: the package `fem`.

Names are imported when they are first used.
"""

import lazy_loader

from drake_landing._own_packages import verify_own_packages

verify_own_packages()
_lazy, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    if name == "__version__":
        from importlib.metadata import version

        return version("drake-landing")
    return _lazy(name)
