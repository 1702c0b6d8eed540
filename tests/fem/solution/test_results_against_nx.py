"""Every table of the NX and MSC result files of `solid_shell_bar` against ours.

Forces, stresses and strains with corners and plies, grid point forces, strain energy:
statics to single precision, the transient to 2e-5 of its peak.
"""

import h5py
import numpy as np
import pytest

import fem
from fem.cli import _status
from fem.solution import run_deck

_BAR = [0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13]
_COLUMNS = {
    "stress/crod": [0, 2],
    "strain/crod": [0, 2],
    "stress/cbar": _BAR,
    "strain/cbar": _BAR,
    "force/cbeam": list(range(1, 8)),
    "stress/cbeam": list(range(6)),
    "strain/cbeam": list(range(6)),
}
_CARDS = (
    *("crod", "cbar", "cbeam", "cquad4", "ctria3", "chexa", "cpenta", "ctetra"),
    *("cquad4_composite", "ctria3_composite"),
)
LATER = ("CELAS", "PELAS", "CSHEAR", "PSHEAR", "CDAMP", "CONROD")


def read_op2(path):
    from pyNastran.op2.op2 import read_op2 as read

    return read(str(path), build_dataframe=False, debug=None, log=None)


def solve(deck, out):
    with h5py.File(run_deck(fem.read_deck(deck), out)) as file:
        found = {}
        file.visititems(
            lambda name, item: found.update(
                {name: item[()] if isinstance(item, h5py.Dataset) else dict(item.attrs)}
            )
        )
    return found


@pytest.fixture(scope="module")
def run(references, tmp_path_factory):
    """Function from a stem to our results and theirs; each deck is run once."""
    folder, done = references / "solid_shell_bar", {}

    def go(stem):
        if stem not in done:
            out = tmp_path_factory.mktemp(stem)
            text = (folder / f"{stem}.bdf").read_text()
            if stem.startswith("transient"):
                lines = [x for x in text.splitlines() if not x.startswith(LATER)]
                text = "\n".join(lines)
            (out / "a.bdf").write_text(text)
            (out / "geom.inc").write_text((folder / "geom.inc").read_text())
            op2 = read_op2(folder / f"{stem}.op2")
            done[stem] = solve(out / "a.bdf", out / "a.h5"), op2
        return done[stem]

    return go


def times(table):
    """Positions of the times, each once."""
    return np.unique(np.asarray(table._times), return_index=True)[1]


def owners(table):
    for name in ("element_node", "element_layer"):
        found = getattr(table, name, None)
        if found is not None:
            return found[:, 0]
    return table.element


def compare(ours, theirs, name, kind, card, tolerance, sign=None):
    """Largest difference of each element over its own peak; angles are not compared."""
    table = getattr(getattr(theirs.op2_results, kind), f"{card}_{kind}")[1]
    group = f"{name}/element_{kind}/{card.upper()}"
    columns = [str(c) for c in ours[group]["columns"]]
    data = table.data[times(table)].astype(float)
    data = data[..., _COLUMNS.get(f"{kind}/{card}", slice(None))]
    values = ours[f"{group}/value"].reshape(len(data), -1, len(columns))
    if sign is not None:
        values = values * sign[:, None, None]
    linear = [
        i
        for i, column in enumerate(columns)
        if not column.startswith(("angle", "fibre", "c1_f", "c2_f", "c3_f", "c4_f"))
        and "_angle" not in column
    ]
    for i, element in enumerate(ours[f"{group}/id"]):
        rows = data[:, owners(table) == element]
        if card == "cbeam":  # the stations between are not printed here
            rows = rows[:, [0, -1]]
        rows = rows.reshape(len(rows), -1)
        at = [k for k in linear if k < rows.shape[1]]
        scale = np.abs(rows[:, at]).max()
        assert np.abs(rows[:, at] - values[:, i][:, at]).max() < tolerance * scale


@pytest.mark.parametrize("kind", ["force", "stress", "strain"])
@pytest.mark.parametrize("suffix", ["", "_xyz", "_pload1"])
def test_statics(run, suffix, kind):
    ours, theirs = run(f"static_solid_shell_bar{suffix}")
    for card in _CARDS:
        if f"static/1/element_{kind}/{card.upper()}" not in ours:
            continue
        if suffix == "_pload1" and card == "cbar":
            continue  # another table, see below
        compare(ours, theirs, "static/1", kind, card, 3e-7)


@pytest.mark.parametrize("word", ["CORNER", "BILIN", "CENTER"])
def test_corner_stresses_through_the_command_line(run, references, tmp_path, word):
    """STRESS(CORNER): the center and four corners, NX's figures; CENTER: the first."""
    _, theirs = run("static_solid_shell_bar")
    folder = references / "solid_shell_bar"
    text = (folder / "static_solid_shell_bar.bdf").read_text()
    (tmp_path / "a.bdf").write_text(text.replace("BILIN", word))
    (tmp_path / "geom.inc").write_text((folder / "geom.inc").read_text())
    assert _status([str(tmp_path / "a.bdf"), "--out", str(tmp_path)]) == 0
    table = theirs.op2_results.stress.cquad4_stress[1]
    data = table.data[0].astype(float)
    with h5py.File(tmp_path / "a.h5") as file:
        group = file["static/1/element_stress/CQUAD4"]
        columns = [str(c) for c in group.attrs["columns"]]
        assert len(columns) == 16 * (1 if word == "CENTER" else 5)
        for element, values in zip(group["id"][:], group["value"][:]):
            own = values.reshape(-1, 8)[:, [1, 2, 3, 5, 6, 7]]
            rows = data[owners(table) == element][: len(own), [1, 2, 3, 5, 6, 7]]
            assert np.abs(own - rows).max() < 3e-7 * np.abs(rows).max()


@pytest.mark.parametrize("kind", ["force", "stress", "strain"])
def test_transient(run, kind):
    ours, theirs = run("transient_solid_shell_bar")
    for card in _CARDS[: 5 if kind == "force" else 8]:
        compare(ours, theirs, "transient/1", kind, card, 2e-5)


def test_end_forces_of_a_bar_under_pload1(run):
    """M2 -76.19559 and V2 7.370338 at A, -33.56594 and -92.62966 at B."""
    ours, theirs = run("static_solid_shell_bar_pload1")
    table = theirs.op2_results.force.cbar_force[1].data[0, :, 1:].astype(float)
    ends = ours["static/1/element_force/CBAR_ENDS/value"][0].reshape(2, 6)
    np.testing.assert_allclose(ends, table, rtol=1e-6)
    bar = ours["static/1/element_force/CBAR/value"][0]
    np.testing.assert_allclose(bar[[0, 1, 4, 5, 6, 7]], table[0], rtol=1e-6)
    np.testing.assert_allclose(bar[[2, 3]], table[1, :2], rtol=1e-6)
    stress = theirs.op2_results.stress.cbar_stress_10nodes[1].data[0]
    mine = ours["static/1/element_stress/CBAR/value"][0]
    np.testing.assert_allclose(mine[[4, 5, 6]], stress[0, 5:8], rtol=1e-6)


@pytest.mark.parametrize(
    ("stem", "name", "tolerance"),
    [
        ("static_solid_shell_bar", "static/1", 3e-7),
        ("static_solid_shell_bar_xyz", "static/1", 3e-7),
        ("static_solid_shell_bar_pload1", "static/1", 3e-7),
        ("mode_solid_shell_bar", "modes", 1e-5),
        ("transient_solid_shell_bar", "transient/1", 3e-5),
    ],
)
def test_grid_point_forces(run, stem, name, tolerance):
    """All rows: elements, applied loads, constraints and what is left over."""
    ours, theirs = run(stem)
    group = f"{name}/grid_point_force"
    table = theirs.grid_point_forces[1]
    force = ours[f"{group}/force"]
    force = force if force.ndim == 3 else force[None]
    rows = {}
    for i, (grid, element, source) in enumerate(
        zip(*(ours[f"{group}/{key}"] for key in ("grid_id", "element_id", "source")))
    ):
        label = source.decode() if element == 0 else ""
        rows[grid, element, label] = i
    sign = np.ones(len(force))
    if name == "modes":
        shapes = theirs.eigenvectors[1].data
        sign = np.sign(np.sum(ours["modes/shape"] * shapes, axis=(1, 2)))
    for k in range(len(force)):
        grids, elements = table.node_element[k].T
        names = [text.strip() for text in table.element_names[k]]
        at = [
            rows[grid, element, label if element == 0 else ""]
            for grid, element, label in zip(grids, elements, names)
            if grid
        ]
        data = table.data[k].astype(float)[grids > 0]
        scale = np.abs(table.data).max()
        assert np.abs(sign[k] * force[k, at] - data).max() < tolerance * scale


def test_strain_energy_of_modes(run):
    ours, theirs = run("mode_solid_shell_bar")
    found = theirs.op2_results.strain_energy
    for card in _CARDS[:8]:
        table = getattr(found, f"{card}_strain_energy")[1]
        energy = ours[f"modes/strain_energy/{card.upper()}/value"]
        theirs_by_element = table.data[:, : energy.shape[1], 0]
        np.testing.assert_allclose(energy, theirs_by_element, rtol=3e-5)


@pytest.mark.parametrize("card", _CARDS)
def test_forces_of_modes(run, card):
    ours, theirs = run("mode_solid_shell_bar")
    shapes = theirs.eigenvectors[1].data
    sign = np.sign(np.sum(ours["modes/shape"] * shapes, axis=(1, 2)))
    if f"modes/element_force/{card.upper()}" in ours:
        compare(ours, theirs, "modes", "force", card, 1e-5, sign)


def test_forces_of_constraint_in_a_transient(run):
    ours, theirs = run("transient_solid_shell_bar")
    table = theirs.spc_forces[1]
    data = table.data[times(table)].astype(float)
    force = ours["transient/1/spc_force"]
    assert np.abs(force - data).max() < 1e-5 * np.abs(data).max()
    load = theirs.load_vectors[1]
    np.testing.assert_allclose(
        ours["transient/1/applied_load"], load.data[times(load)], rtol=1e-6, atol=1e-9
    )


def test_the_loads_of_the_transient_belong_to_a_lighter_deck(run, references, tmp_path):
    """OLOAD adds up to 386.1 times the mass without the elements added later."""
    ours, theirs = run("transient_solid_shell_bar")
    load = theirs.load_vectors[1].data[1, :, 1].astype(float).sum()
    assert load == pytest.approx(386.1 * ours["mass/total"], rel=1e-6)
    folder = references / "solid_shell_bar"
    whole = solve(folder / "transient_solid_shell_bar.bdf", tmp_path / "a.h5")
    assert whole["mass/total"] > 1.02 * ours["mass/total"]
    for card in ("CELAS1", "CSHEAR", "CONROD"):
        assert f"transient/1/element_stress/{card}" in whole
        assert not hasattr(theirs.op2_results.stress, f"{card.lower()}_stress") or not (
            getattr(theirs.op2_results.stress, f"{card.lower()}_stress")
        )
