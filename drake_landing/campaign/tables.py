"""The tables of a campaign, as Parquet files: what was flown, extremes, what decides.

    cases              one row per case: what varied, status, peaks of gears and points
    stress             per element: largest stress, its landing, margin
    components         per component: the worst element
    screening_error    per component: the screening against direct transients
    sections           per cut: extremes of shear, bending, torsion
    section_hulls      per cut and pair of loads: landings on the hull
    monitor_points     per monitor point of the deck (MONPNT1, MONPNT3): extremes
    monitor_hulls      per monitor point and pair of its loads: landings on the hull
    critical_cases     a short list of landings that holds the extremes of all elements
    exceedance         per quantity: how often a value is exceeded
    fatigue            per component: cycles and damage (where an S-N curve is given)

SI units; every table's units stand in its schema's metadata and in `tables/README.md`.
"""

from collections.abc import Mapping
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
from pandas.api.types import is_object_dtype

from drake_landing.campaign.fatigue import cycles, damage
from drake_landing.campaign.run import CampaignResult, failure_message
from drake_landing.campaign.screening import history_of
from drake_landing.campaign.section_envelopes import (
    CORNERS,
    EXTREMES,
    SectionEnvelope,
    SectionLoads,
)
from drake_landing.campaign.selection import Largest, known_stress, largest
from drake_landing.campaign.set_cover import Cover, candidates, greedy_cover
from drake_landing.campaign.setup import Prepared
from drake_landing.campaign.statistics import exceedance_tables
from drake_landing.campaign.task import case_file
from drake_landing.parts.stress_rows import starts
from drake_landing.parts.tables import with_margin
from fem.arrays import Float64
from fem.files.atomic import write_aside

Tables = Mapping[str, pd.DataFrame]

COVER_TOLERANCE = 0.02
COVER_SHARE = 0.99

_UNITS = {
    "cases": "fields of the case in its own units; peaks in SI (N, N m, m, m/s²)",
    "stress": "Pa, s, m (deck's basic axes); margin = allowed / (factor × stress) - 1",
    "components": "as stress",
    "screening_error": "shares of the component's largest stress (1 = 100 %)",
    "sections": "m; N, N m, N m; s",
    "section_hulls": "m; N or N m; s",
    "monitor_points": "m; N, N m; s",
    "monitor_hulls": "N or N m; s",
    "critical_cases": "elements; share of the elements",
    "exceedance": "SI; share of landings, with the bounds of 90 % confidence",
    "fatigue": "Pa; cycles and damage of all landings of the campaign, once each",
}


def write_tables(result: CampaignResult) -> Tables:
    """Makes all tables and writes them to `tables/`.

    Returns:
        Name -> table.
    """
    worst = _largest(result)
    tables = {"cases": _cases(result)}
    tables["stress"] = _stress(result, worst)
    tables["components"] = _components(tables["stress"])
    tables["screening_error"] = result.errors.reset_index()
    tables["sections"], tables["section_hulls"] = _sections(result)
    if any(own.setup.stations for own in result.prepared.values()):
        tables["monitor_points"], tables["monitor_hulls"] = _monitors(result)
    tables["critical_cases"] = _critical(result, worst)
    peaks = tables["cases"].set_index("case").filter(like=":")
    tables["exceedance"] = exceedance_tables(peaks.dropna(how="all"))
    if result.campaign.fatigue is not None:
        tables["fatigue"] = _fatigue(result, tables["stress"])
    folder = result.folder / "tables"
    for name, table in tables.items():
        _write(folder / f"{name}.parquet", table, _UNITS[name])
    write_aside(folder / "README.md", lambda p: p.write_text(_readme(tables)))
    return tables


def _write(path: Path, table: pd.DataFrame, units: str) -> None:
    plain = table.copy()
    for name in filter(lambda c: is_object_dtype(plain[c]), list(plain.columns)):
        kinds = {type(v) for v in plain[name].dropna()}
        if len(kinds) > 1:  # a column of Parquet has one type
            numbers = kinds <= {int, float, np.int64, np.float64}
            plain[name] = plain[name].map(float if numbers else str)
    found = pa.Table.from_pandas(plain, preserve_index=False)
    found = found.replace_schema_metadata(
        {**(found.schema.metadata or {}), b"units": units.encode()}
    )
    write_aside(path, lambda part: pq.write_table(found, part, compression="zstd"))


def _readme(tables: Tables) -> str:
    lines = [f"- `{n}.parquet`: {len(t)} rows; {_UNITS[n]}" for n, t in tables.items()]
    query = "duckdb.sql(\"select * from 'tables/stress.parquet' order by margin\")"
    return "\n".join(
        ["# Tables of the campaign", "", *lines, "", f"For example `{query}`.", ""]
    )


def _largest(result: CampaignResult) -> dict[str, Largest]:
    """Per airframe, over its landings."""
    return {
        key: largest(
            result.cases,
            [n for n in result.flown if result.of_case[n] == key],
            len(own.setup.elements),
        )
        for key, own in result.prepared.items()
    }


def _cases(result: CampaignResult) -> pd.DataFrame:
    rows = []
    confirmed = {*result.sample, *result.critical}
    for number, varied in zip(result.design.index, result.design.to_dict("records")):
        row: dict[str, object] = {"case": number, **varied}
        own = result.prepared[result.of_case[number]]
        row["airframe"] = own.aircraft.name
        row["status"] = result.status[number]
        row["remark"] = ""
        if row["status"] == "done":
            row |= _peaks(case_file(result.cases, number))
        else:
            row["remark"] = failure_message(result, number)
        row["remark"] = result.unconfirmed.get(int(number), row["remark"])
        row["confirmed"] = number in confirmed
        rows.append(row)
    return pd.DataFrame(rows)


def _peaks(path: Path) -> dict[str, float]:
    with h5py.File(path) as file:
        gears = zip(file["gears/name"], file["gears/peak"])
        points = zip(file["points/name"], file["points/peak"])
        return {
            **{f"gear:{name.decode()}": float(value) for name, value in gears},
            **{f"point:{name.decode()}": float(value) for name, value in points},
        }


def _stress(result: CampaignResult, worst: Mapping[str, Largest]) -> pd.DataFrame:
    """Airframes with the same elements are one: the larger stress counts."""
    tables = []
    for key, found in worst.items():
        elements = result.prepared[key].setup.elements
        table = elements.assign(
            equivalent=found.value,
            time=found.time,
            largest=found.high,
            smallest=found.low,
            case=found.case,
            confirmed=found.confirmed,
        )
        tables.append(table[table.case >= 0])
    every = pd.concat(tables, ignore_index=True) if tables else pd.DataFrame()
    if every.empty:
        return every
    every = every.sort_values(["equivalent", "case"], ascending=[False, True])
    every = every.drop_duplicates("id").sort_values("id").reset_index(drop=True)
    factor = next(iter(result.prepared.values())).ultimate_factor
    return with_margin(every, factor)


def _components(stress: pd.DataFrame) -> pd.DataFrame:
    if stress.empty:
        return stress
    use = (stress.equivalent / stress.allowed).fillna(-1.0)
    use = use.where(~stress.axial_only.astype(bool), -2.0)  # known without bending
    ranked = stress.assign(use=use).sort_values(
        ["use", "equivalent"], ascending=False, kind="stable"
    )
    found = ranked.drop_duplicates("component").drop(columns="use")
    counts = stress.component.value_counts()
    return found.assign(elements=counts.loc[found.component].to_numpy()).reset_index(
        drop=True
    )


def _sections(result: CampaignResult) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Extremes at all cuts, and the landings on their hulls."""
    extremes, hulls = _stations(result, "sections")
    return extremes.rename(columns={"name": "beam"}), hulls.rename(
        columns={"name": "beam"}
    )


def _monitors(result: CampaignResult) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The same at the deck's monitor points, with their labels."""
    extremes, hulls = _stations(result, "monitor_points")
    labels = {
        s.name: (s.point.label, s.point.frame, *s.point.point.tolist())
        for own in result.prepared.values()
        for s in own.setup.stations
    }
    extremes, hulls = (t.drop(columns="station") for t in (extremes, hulls))
    heads = ("label", "frame", "point_x", "point_y", "point_z")
    for k, head in enumerate(heads):
        extremes.insert(1 + k, head, [labels[name][k] for name in extremes.name])
    return extremes, hulls


def _stations(result: CampaignResult, kind: str) -> tuple[pd.DataFrame, pd.DataFrame]:
    found: dict[tuple[str, tuple[float, ...]], SectionEnvelope] = {}
    for number in result.flown:
        with h5py.File(case_file(result.cases, number)) as file:
            for name, group in file[kind].items():
                landing = SectionLoads.from_hdf5(group)
                name = str(group.attrs.get("name", name))
                key = name, tuple(landing.station.tolist())
                if key not in found:
                    found[key] = SectionEnvelope.from_loads(landing)
                found[key].add(landing, number)
    tables = [own.tables(name) for (name, _), own in found.items()]
    if not tables:
        return pd.DataFrame(columns=EXTREMES), pd.DataFrame(columns=CORNERS)
    extremes, corners = zip(*tables)
    return pd.concat(extremes, ignore_index=True), pd.concat(corners, ignore_index=True)


def critical_cases(
    result: CampaignResult, worst: Mapping[str, Largest], tolerance: float, share: float
) -> Cover:
    """Greedy cover of all elements by landings; see `set_cover`."""
    found = {}
    for key, best in worst.items():
        mine = [n for n in result.flown if result.of_case[n] == key]
        stresses = ((n, known_stress(result.cases, n).equivalent) for n in mine)
        found |= candidates(stresses, best.value, tolerance)
    return greedy_cover(found, share)


def _critical(result: CampaignResult, worst: Mapping[str, Largest]) -> pd.DataFrame:
    cover = critical_cases(result, worst, COVER_TOLERANCE, COVER_SHARE)
    rows = result.design.loc[list(cover.case)].reset_index()
    rows.insert(1, "added", cover.added)
    rows.insert(2, "share", cover.share)
    return rows


def _fatigue(result: CampaignResult, stress: pd.DataFrame) -> pd.DataFrame:
    """Cycles of the worst elements of every component, by screened histories."""
    curve = result.campaign.fatigue
    assert curve is not None
    count = result.campaign.elements_per_group
    ranked = stress.sort_values("equivalent", ascending=False, kind="stable")
    chosen = ranked.groupby("component", sort=False).head(count)
    rows = []
    for key, own in result.prepared.items():
        mine = [n for n in result.flown if result.of_case[n] == key]
        place = _places(own)
        for row in chosen.to_dict("records"):
            if row["id"] not in place:
                continue
            part, element = place[row["id"]]
            done, counted, largest_range = 0.0, 0.0, 0.0
            for number in mine:
                with h5py.File(case_file(result.cases, number)) as file:
                    z = _amplitudes(file)
                lines = history_of(own.setup.basis, own.setup.rows, part, element, z)
                line = lines[np.abs(lines).max(axis=1).argmax()]
                found = cycles(line)
                done += damage(found, curve)
                counted += float(found["count"].sum())
                largest_range = max(
                    largest_range, float(found["range"].max() if len(found) else 0.0)
                )
            rows.append(
                [
                    *(own.aircraft.name, row["component"], row["id"]),
                    *(len(mine), counted, largest_range, done),
                ]
            )
    heads = ["airframe", "component", "id", "landings", "cycles", "range", "damage"]
    return pd.DataFrame(rows, columns=heads)


def _amplitudes(file: h5py.File) -> Float64:
    load = np.asarray(file["loads/load"])
    q = np.asarray(file["loads/amplitudes"], float)
    return np.vstack([q, load.reshape(len(load), -1).T])


def _places(own: Prepared) -> dict[int, tuple[int, int]]:
    """Element -> its part and its position there."""
    rows = own.setup.rows
    ids = own.setup.elements["id"].to_numpy()
    found = {}
    for part, (r, at) in enumerate(zip(rows, starts(rows))):
        for i, element in enumerate(ids[at : at + r.size].tolist()):
            found[element] = (part, i)
    return found
