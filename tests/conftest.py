"""Fixtures for all tests."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

# The suite gives the same verdict twice, however busy the machine; `make fuzz` looks
# where nobody has looked, and so do these with HYPOTHESIS_PROFILE=random.
for name, derandomize in (("repeatable", True), ("random", False)):
    settings.register_profile(
        name,
        derandomize=derandomize,
        deadline=None,
        suppress_health_check=[HealthCheck.too_slow],
    )
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "repeatable"))


@pytest.fixture(scope="session", autouse=True)
def no_cache_of_the_user() -> Iterator[None]:
    """What an earlier run computed proves nothing."""
    before = os.environ.get("DRAKE_LANDING_CACHE")
    os.environ["DRAKE_LANDING_CACHE"] = "off"
    yield
    if before is None:
        del os.environ["DRAKE_LANDING_CACHE"]
    else:
        os.environ["DRAKE_LANDING_CACHE"] = before


@pytest.fixture(scope="session")
def references() -> Path:
    """Folder of reference decks and results that lie beside the project.

    Tests that need it are skipped where it is absent.
    """
    folder = Path(__file__).resolve().parents[2] / "shared" / "references"
    if not folder.is_dir():
        pytest.skip(f"reference decks are not there: {folder}")
    return folder
