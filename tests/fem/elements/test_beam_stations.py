"""Results of CBEAM between its ends are those of a beam that is cut there."""

import h5py
import numpy as np
import pytest

import fem
from fem.solution import run_deck

STATIONS = (0.0, 0.25, 0.6, 1.0)
DECK = """\
SOL 101
CEND
SPC=1
LOAD=1
FORCE=ALL
STRESS=ALL
STRAIN=ALL
BEGIN BULK
MAT1,1,7.+10,,.3
SPC1,1,123456,1
FORCE,1,4,,1.,300.,-200.,500.
MOMENT,1,4,,1.,40.,70.,-90.
"""
VALUES = ("area", "i1", "i2", "i12", "j")


def at(x: float) -> dict[str, float]:
    """A section with offset neutral axis, linear between STATIONS."""
    scale = np.interp(x, STATIONS, [1.0, 0.8, 0.7, 0.4])
    return {
        **{"area": 4e-3 * scale, "i1": 2e-6 * scale, "i2": 3e-6 * scale},
        **{"i12": 5e-7 * scale, "j": 4e-6 * scale, "n1": 0.02 - 0.01 * x},
        **{"n2": 0.01 * x, "size": 0.05 * scale},
    }


def pbeam(pid: int, stations: list[float], output: list[str]) -> str:
    """PBEAM in free fields; stations over the whole beam."""
    first, last = stations[0], stations[-1]

    def points(x: float) -> str:
        b = at(x)["size"]
        values = (b, 0.5 * b, -b, 0.5 * b, -b, -0.5 * b, b, -0.5 * b)
        return "," + ",".join(f"{v:.6f}" for v in values) + "\n"

    def values(x: float) -> str:
        return ",".join(f"{at(x)[name]:.6e}" for name in VALUES)

    text = f"PBEAM,{pid},1,{values(first)}\n" + points(first)
    order = [last, *stations[1:-1]]  # end B may stand before the stations
    for x, so in zip(order, ["YES", *output]):
        text += f",{so},{(x - first) / (last - first):.9f},{values(x)}\n"
        if so == "YES":
            text += points(x)
    a, b = at(first), at(last)
    text += ",,,,\n,,,,," + ",".join(f"{v:.6f}" for v in (a["n1"], a["n2"]))
    return text + "," + ",".join(f"{v:.6f}" for v in (b["n1"], b["n2"])) + "\n"


def run(folder, text: str) -> dict[str, tuple[list[str], np.ndarray]]:
    path = folder / "a.bdf"
    path.write_text(DECK + text + "ENDDATA\n")
    with h5py.File(run_deck(fem.read_deck(path), folder / "a.h5")) as file:
        return {
            f"{kind}/{name}": (list(group.attrs["columns"]), group["value"][:])
            for kind in ("force", "stress", "strain")
            for name, group in file[f"static/1/element_{kind}"].items()
        }


def grids(places) -> str:
    return "".join(f"GRID,{n},,{3.0 * x:.6f}\n" for n, x in places)


@pytest.fixture
def both(tmp_path):
    """Results of one element, and of three."""
    whole = pbeam(1, list(STATIONS), ["YES", "YES"])
    one = whole + grids([(1, 0.0), (4, 1.0)]) + "CBEAM,1,1,1,4,0.,1.,0.\n"
    text = grids(enumerate(STATIONS, start=1))
    for k in range(3):
        text += pbeam(k + 1, [STATIONS[k], STATIONS[k + 1]], [])
        text += f"CBEAM,{k + 1},{k + 1},{k + 1},{k + 2},0.,1.,0.\n"
    return run(tmp_path, one), run(tmp_path, text)


@pytest.mark.parametrize("kind", ["force", "stress", "strain"])
def test_stations_are_ends_of_a_beam_that_is_cut(both, kind):
    one, three = both
    names, values = one[f"{kind}/CBEAM_STATIONS"]
    count = len(names) // 2
    assert names[0] == "x_s1"
    stations = values[0].reshape(2, count)
    np.testing.assert_allclose(stations[:, 0], STATIONS[1:3], rtol=1e-8)
    ends = three[f"{kind}/CBEAM"][1]
    found = ends.reshape(3, 2, count - 1)[:2, 1]
    scale = np.abs(found).max()
    np.testing.assert_allclose(stations[:, 1:], found, rtol=0, atol=2e-6 * scale)


def test_stations_without_output_have_none(tmp_path):
    text = pbeam(1, list(STATIONS), ["NO", "YES"]) + grids([(1, 0.0), (4, 1.0)])
    found = run(tmp_path, text + "CBEAM,1,1,1,4,0.,1.,0.\n")
    names, values = found["force/CBEAM_STATIONS"]
    assert len(names) == 8
    assert values[0, 0] == pytest.approx(0.6)


def test_beams_under_loads_between_their_ends_have_none(tmp_path):
    text = pbeam(1, list(STATIONS), ["YES", "YES"]) + grids([(1, 0.0), (4, 1.0)])
    text += "CBEAM,1,1,1,4,0.,1.,0.\nPLOAD1,1,1,FY,FR,0.,10.,1.,20.\n"
    assert "force/CBEAM_STATIONS" not in run(tmp_path, text)
