"""Fixtures for all tests."""

from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def references() -> Path:
    """Folder of reference decks and results that lie beside the project.

    Tests that need it are skipped where it is absent.
    """
    folder = Path(__file__).resolve().parents[2] / "shared" / "references"
    if not folder.is_dir():
        pytest.skip(f"reference decks are not there: {folder}")
    return folder
