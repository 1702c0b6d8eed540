"""The notebooks: tidy files that run, and whose text is true.

Quick runs end soon after touchdown and check what must hold at any time. Full runs
(marked slow) also check the figures that the text mentions.
"""

import ast
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"
NOTEBOOKS = sorted(path.stem for path in FOLDER.glob("*.ipynb"))
LONG = {"04_scenarios", "05_studies"}  # half a minute and more even when quick

# Appended to a notebook as its last cell.
ALWAYS = {
    "01_first_landing": """
assert (total - total.iloc[0]).abs().max() < 1e-5 * sink
assert impulse > 0 and abs(impulse / gained - 1) < 1e-4
side = history[[f"{gear} fy" for gear in ("main_left", "main_right")]]
assert side.sum(axis=1).abs().max() < 1e-6 * vertical.max()
""",
    "02_drop_test": """
assert balance < 1e-6
assert history["force"].iloc[0] == 0
assert table["tire load / kN"].is_monotonic_increasing
""",
    "03_gear_physics": """
assert gained > 0 and abs(impulse / gained - 1) < 1e-2
assert 0.999 < landing["slip"].max() < 1.03
""",
    "04_scenarios": """
assert energy < 1e-4 and momentum < 1e-4
assert len(table) == 3 * len(PRESETS)
straight = [n for n, p in PRESETS.items() if p.symmetric]
assert max(trials[n].audit.symmetry for n in straight) < 1e-6
assert table["drag ratio"].max() < 0.8 + 1e-6
""",
    "05_studies": """
assert combined[2] < by_relevance[3] < by_frequency[3]
assert budget["formulation"].max() < 5e-3
assert rms.loc["pulses 73"].max() < rms.loc["count 73"].max() / 2
for practice in ("modal damping 2% of critical", "transient at 5 ms"):
    assert gaps.loc[practice, 210] > 0.7 * gaps.loc[practice, 73]
assert gaps.loc["as in this study", 210] < 0.3 * gaps.loc["as in this study", 73]
""",
    "06_gear_design": """
assert balance < 1e-5
assert (slopes["slope"] / slopes["by differences"] - 1).abs().max() < 1e-4
assert samples["sink rate"].between(0.25, 2.45).all()
assert loads.max(axis=1).nunique() == len(loads)
assert np.isfinite(valves.to_numpy()).all()
""",
    "07_campaign": """
assert campaign.failed == [] and len(cases) == len(campaign.design)
assert peak[sink > sink.median()].min() > peak[sink < sink.median()].max()
assert set(critical["case"]) <= set(cases["case"])
assert critical["share"].iloc[-1] >= 0.99
""",
}
IN_FULL = {
    "01_first_landing": """
left_runway = history.index[vertical > 0].max()
assert 0.63 < left_runway < 0.67
assert 0.8 < vertical.max() / mass / 5.0 < 1.2
assert history["wing_tip_right z"].max() > 3 * vertical.max() / mass
drag = history["main_right_left F_x"]
assert drag[:0.1].max() > 10 * drag[0.1:].max()
""",
    "02_drop_test": """
assert 0.6 < history["stroke"].max() / 0.47 < 0.72
assert 0.5 < history["force"].max() / 316.3e3 < 0.6
assert 0.7 < heat < 0.8
in_air = history.index[history["F_z"] > 0].max()
assert 0.6 < in_air < 0.7
assert history["stops"].idxmin() == pytest.approx(1.0, abs=0.02)
assert table["stroke / mm"].max() < 470
""",
    "03_gear_physics": """
spun_up = landing.index[landing["slip"] > 0.05].max()
assert 0.08 < spun_up < 0.1
aft = stiffness * landing["aft_x"]
assert -0.75 < aft.min() / aft.max() < -0.6
assert run["slip"].iloc[-1] > 0.2  # the last run is the icy one
""",
    "04_scenarios": """
main = table.xs("main_left", level="gear")
touching = ["three_point", "two_point", "tail_down", "reserve_energy"]
assert main["drag ratio"][touching].min() > 0.79
vertical = main["vertical / kN"]
assert vertical["three_point"] < vertical["two_point"] < vertical["tail_down"]
assert 1.25 < vertical["reserve_energy"] / vertical["two_point"] < 1.4
assert table["vertical / kN"]["tail_down"]["nose"] == 0
one = table["vertical / kN"]["rolled"]
assert 1 / 3 < one["main_left"] / one["main_right"] < 0.42
assert main["side / kN"]["drift"] > 0
assert vertical["drift"] > 2 * table["vertical / kN"]["drift"]["main_right"]
left_runway = trials["rebound"].history("main_left")["vertical"]
assert 0.48 < left_runway.index[left_runway > 0].max() < 0.56
assert 8 < gravities["main_left"] < 10 and 17 < gravities["nose"] < 20
bump = trials["taxi_bump"].history("nose")["vertical"]
assert 0.9 < bump.idxmax() - bump[:0.6].idxmax() < 1.1
assert 3.5 < table["over static"]["braked_roll"]["nose"] < 4.3
assert 1.0 < overshoot < 1.15
""",
    "05_studies": """
assert rms.loc["count 19"].max() > 0.3
assert (rms.loc["pulses 36"] <= rms.loc["count 73"]).all()
assert rms.loc["pulses 73"].max() < 0.01
assert gaps.loc["as in this study", 210] < 0.02
assert ((ratio > 0.5) & (ratio < 2)).mean() >= 0.9
assert chosen.max() > 60
assert feedback.loc["count 73"].max() > 0.05
""",
    "06_gear_design": """
change = slopes["% of the peak for 1 %"]
assert 0.3 < change["compression_damping"] < 0.36
assert 0.1 < change["precharge"] < 0.125
assert (np.diff(first) > 0).all()
assert 1.0 < share[first > later][0] < 1.15
assert samples["sink rate"].corr(loads.max(axis=1)) > 0.8
ratio = valves["peak / kN"].unstack()
ratio = ratio["controlled"] / ratio["plain"]
assert 0.75 < ratio[1.0] < 0.85
assert 0.95 < ratio[3.05] < 1.1
stroke = valves["stroke / mm"].unstack()
assert stroke["controlled"][3.66] < stroke["plain"][3.66]
""",
    "07_campaign": """
assert len(cases) == 40
assert errors["peak"].abs().max() < 0.1
""",
}


def _load(name):
    return nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)


def _code(notebook):
    return [cell.source for cell in notebook.cells if cell.cell_type == "code"]


def _execute(name, checks, full):
    notebook = _load(name)
    flag = "" if full else "import os; os.environ['DRAKE_LANDING_QUICK'] = '1'"
    notebook.cells.insert(0, nbformat.v4.new_code_cell(flag))
    checks = "import pytest\n" + "\n".join(checks)
    notebook.cells.append(nbformat.v4.new_code_cell(checks))
    NotebookClient(
        notebook, timeout=280, resources={"metadata": {"path": str(FOLDER)}}
    ).execute()


def test_every_notebook_has_its_checks():
    assert NOTEBOOKS == sorted(ALWAYS) == sorted(IN_FULL)


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_file_is_tidy(name):
    notebook = _load(name)
    nbformat.validate(notebook)
    assert len(notebook.cells) <= 15
    assert notebook.metadata.kernelspec.name == "python3"
    for cell in notebook.cells:
        assert not cell.get("outputs")
        assert cell.get("execution_count") is None


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_imports_stand_in_the_first_code_cell(name):
    first, *rest = _code(_load(name))
    kinds = (ast.Import, ast.ImportFrom)
    assert any(isinstance(node, kinds) for node in ast.parse(first).body)
    for source in rest:
        assert not any(isinstance(node, kinds) for node in ast.walk(ast.parse(source)))


@pytest.mark.notebook
@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=pytest.mark.slow if n in LONG else ()) for n in NOTEBOOKS],
)
def test_notebook_runs(name):
    _execute(name, [ALWAYS[name]], full=False)


@pytest.mark.slow
@pytest.mark.notebook
@pytest.mark.parametrize("name", NOTEBOOKS)
def test_text_of_notebook_is_true(name):
    _execute(name, [ALWAYS[name], IN_FULL[name]], full=True)
