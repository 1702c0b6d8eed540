"""Fixtures for all tests."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

# The suite gives the same verdict twice; `make fuzz` looks where nobody has looked, and
# HYPOTHESIS_PROFILE=random lets these properties do so, too.
settings.register_profile("repeatable", derandomize=True)
settings.register_profile("random", derandomize=False)
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
