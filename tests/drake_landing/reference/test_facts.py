"""Every fact of the reference aircraft says where it comes from."""

from importlib import resources

import numpy as np
import pytest

from drake_landing.reference.d150.facts import SOURCES, leaves, raw, table

DATA = resources.files("drake_landing.reference.d150") / "data"
YAML = sorted(p.name[:-5] for p in DATA.iterdir() if p.name.endswith(".yaml"))
CSV = sorted(p.name[:-4] for p in DATA.iterdir() if p.name.endswith(".csv"))


@pytest.mark.parametrize("name", YAML)
def test_every_value_has_a_known_source(name):
    found = list(leaves(raw(name)))
    assert found
    for path, fact in found:
        assert fact.get("source") in SOURCES, path
        assert set(fact) <= {
            *("value", "source", "estimate", "unit", "note", "columns")
        }, path


@pytest.mark.parametrize("name", YAML)
def test_values_of_this_project_are_flagged_as_estimates(name):
    for path, fact in leaves(raw(name)):
        if fact["source"] == "EST":
            assert fact.get("estimate") is True, path


@pytest.mark.parametrize("name", CSV)
def test_every_row_has_a_known_source(name):
    rows = table(name)
    assert set(rows.source) <= set(SOURCES)
    assert rows.estimate.dtype == bool
    assert rows.estimate[rows.source == "EST"].all()


@pytest.mark.parametrize("name", CSV)
def test_numbers_are_finite(name):
    assert np.isfinite(table(name).select_dtypes("number").to_numpy()).all()


def test_there_are_86_frames_and_30_ribs_a_side():
    assert len(table("fuselage_frames")) == 86
    assert len(table("wing_ribs")) == 30
