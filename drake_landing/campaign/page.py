"""campaign.html: one file to browse a campaign, no server, no network."""

import base64
import json
import math
import shlex
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from jinja2 import Environment, StrictUndefined

from drake_landing.campaign.run import CampaignResult
from drake_landing.campaign.selection import MATTERS
from drake_landing.campaign.tables import COVER_SHARE, COVER_TOLERANCE, Tables
from fem.files.atomic import write_aside

_MOST_CURVE = 400  # points of an exceedance curve
_COMPONENTS = {
    "component": "component",
    "id": "element",
    "card": "card",
    "equivalent": "stress, MPa",
    "margin": "margin",
    "case": "case",
    "time": "time, s",
    "confirmed": "confirmed",
    "elements": "elements",
}
_ERRORS = {
    "component": "component",
    "landings": "landings",
    "elements": "elements",
    "median": "median, %",
    "p99": "99 % below, %",
    "worst": "worst, %",
    "peak": "component's largest stress, %",
}


def write_page(result: CampaignResult, path: Path) -> None:
    """Writes the page.

    Args:
        result: of the campaign, with its tables.
        path: of the file.
    """
    tables = result.tables
    environment = Environment(autoescape=True, undefined=StrictUndefined)
    template = environment.from_string(
        _text("drake_landing.campaign", "campaign.html.j2")
    )
    campaign = result.campaign
    text = template.render(
        title=f"{campaign.name}: campaign",
        heading=campaign.title or campaign.name,
        story=_story(result),
        figures=_figures(result, tables),
        stress_text=_stress_text(tables),
        cover_text=_cover_text(tables),
        statistics_text=_statistics_text(result),
        screening_text=_screening_text(result),
        footer=f"drake-landing {version('drake-landing')}; base case "
        f"{campaign.base.name}; tables as Parquet in tables/",
        style=_text("drake_landing.report", "style.css"),
        data=_json(_data(result, tables)),
    )
    write_aside(path, lambda part: part.write_text(text, encoding="utf-8"))


def _text(package: str, name: str) -> str:
    return files(package).joinpath(name).read_text(encoding="utf-8")


def _json(data: Any) -> str:
    """JSON that cannot end the script element that holds it."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "").replace("\u2029", "")


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float):
        return float(f"{value:.6g}") if math.isfinite(value) else None
    return value


def _frame(table: pd.DataFrame) -> dict[str, Any]:
    rows = table.astype(object).itertuples(index=False, name=None)
    return {
        "columns": [str(c) for c in table.columns],
        "rows": [[_plain(v) for v in row] for row in rows],
    }


def _floats(values: Any) -> str:
    array = np.ascontiguousarray(np.nan_to_num(np.asarray(values, np.float32)), "<f4")
    return base64.b64encode(array.tobytes()).decode("ascii")


def _data(result: CampaignResult, tables: Tables) -> dict[str, Any]:
    cases, campaign = tables["cases"], result.campaign
    name = campaign.places.file or campaign.name
    failures = cases.loc[cases.remark != "", ["case", "status", "remark"]]
    return {
        "cases": _frame(cases),
        "hulls": _hulls(tables["section_hulls"]),
        "elements": _elements(tables["stress"]),
        "components": _frame(_component_rows(tables["components"])),
        "critical": _frame(tables["critical_cases"]),
        "errors": _frame(_error_rows(tables["screening_error"])),
        "failures": _frame(failures),
        "exceedance": _curves(tables["exceedance"]),
        "reports": _reports(result),
        "command": f"drake-landing campaign {shlex.quote(name)}",
    }


def _reports(result: CampaignResult) -> dict[str, str]:
    found = result.folder.glob("reports/*/report.html")
    return {
        str(int(p.parent.name)): f"reports/{p.parent.name}/report.html" for p in found
    }


def _hulls(table: pd.DataFrame) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for row in table.to_dict("records"):
        place = found.setdefault(row["beam"], {}).setdefault(str(row["station"]), {})
        point = [row["x"], row["y"], row["case"], row["time"]]
        place.setdefault(row["pair"], []).append([_plain(v) for v in point])
    return found


def _elements(stress: pd.DataFrame) -> dict[str, Any]:
    """What is drawn: use of the allowable where any is known, else the stress."""
    if stress.empty:
        stress = pd.DataFrame(
            {k: [] for k in ("x", "y", "z", "id", "case", "component", "equivalent")}
        ).assign(allowed=[])
    known = stress.allowed.notna().any()
    use = stress.equivalent / stress.allowed if known else stress.equivalent / 1e6
    names = pd.Index(pd.unique(stress.component.astype(str)))
    return {
        "unit": "stress over allowed" if known else "stress, MPa",
        "components": names.tolist(),
        "component": _floats(names.get_indexer(stress.component.astype(str))),
        "use": _floats(use.astype(float)),
        **{name: _floats(stress[name]) for name in ("x", "y", "z", "id", "case")},
    }


def _component_rows(table: pd.DataFrame) -> pd.DataFrame:
    if table.empty:
        return pd.DataFrame(columns=list(_COMPONENTS.values()))
    rows = table.assign(
        equivalent=table.equivalent / 1e6,
        confirmed=table.confirmed.map({True: "yes", False: "screened"}),
    )
    found = rows[list(_COMPONENTS)].rename(columns=_COMPONENTS)
    # The page looks for the column `case` by name.
    return found


def _error_rows(table: pd.DataFrame) -> pd.DataFrame:
    if table.empty:
        return pd.DataFrame(columns=list(_ERRORS.values()))
    rows = table[list(_ERRORS)].copy()
    for name in ("median", "p99", "worst", "peak"):
        rows[name] = 100.0 * rows[name].astype(float)
    for name in ("landings", "elements"):
        rows[name] = rows[name].astype(int)
    return rows.rename(columns=_ERRORS)


def _curves(table: pd.DataFrame) -> dict[str, Any]:
    found = {}
    for name, rows in table.groupby("quantity", sort=False):
        step = max(1, len(rows) // _MOST_CURVE)
        values = rows[["value", "share", "low", "high"]].iloc[::step]
        found[str(name)] = [[_plain(v) for v in r] for r in values.to_numpy().tolist()]
    return found


def _story(result: CampaignResult) -> str:
    campaign = result.campaign
    varied = [path for path in campaign.axes if result.design[path].nunique() > 1]
    axes = ", ".join([*varied, *(["measured touchdowns"] * bool(campaign.table))])
    return (
        f"{len(result.design)} landings of {_names(result)}, which differ in "
        f"{axes or 'nothing'}. "
        "Each was flown in the multibody model; the stress of every element comes from "
        "its modal amplitudes and static answers (screening), for the landings that "
        "decide from the direct transient of the full model (confirmed)."
    )


def _names(result: CampaignResult) -> str:
    names = dict.fromkeys(p.aircraft.name for p in result.prepared.values())
    return ", ".join(names)


def _figures(result: CampaignResult, tables: Tables) -> list[tuple[str, str, str]]:
    confirmed = len(result.sample) + len(result.critical)
    open_ = len(result.within_band) - sum(
        1 for n in result.within_band.index if n in (*result.sample, *result.critical)
    )
    rows = [
        ("landings", str(len(result.flown)), f"{len(result.failed)} failed or suspect"),
        (
            "confirmed by direct transients",
            str(confirmed),
            f"{len(result.sample)} of them drawn at random; {open_} more lie within "
            "the screening's band",
        ),
    ]
    critical = tables["critical_cases"]
    if len(critical):
        share = 100.0 * float(critical.share.iloc[-1])
        rows.append(
            (
                "critical cases",
                str(len(critical)),
                f"hold {share:.1f} % of the elements' extremes within "
                f"{100 * COVER_TOLERANCE:g} %",
            )
        )
    worst = tables["components"]
    if len(worst):
        known = worst[worst.margin.notna()]
        row = (known if len(known) else worst).iloc[0]
        margin = f"margin {row.margin:+.2f}" if len(known) else "no allowable known"
        rows.append(
            (
                f"worst element, {row.component}",
                f"{row.equivalent / 1e6:.1f} MPa",
                f"{margin}; {row.card} {row['id']}, case {row['case']}"
                f"{_condition(result, int(row['case']))}",
            )
        )
    return rows


def _condition(result: CampaignResult, case: int) -> str:
    """What tells a case from the others, in brackets."""
    values = result.design.loc[case]
    said = [
        f"{path.rpartition('.')[2].replace('_', ' ')} "
        f"{f'{value:.4g}' if isinstance(value, float) else value}"
        for path, value in values.items()
    ]
    return f" ({', '.join(said)})" if said else ""


def _stress_text(tables: Tables) -> str:
    stress = tables["stress"]
    if stress.empty:
        return "No element of the model has stresses."
    share = 100.0 * float(stress.confirmed.mean())
    return (
        "Every element where its middle lies, in the deck's basic axes. Bars without "
        "stress recovery points count with their axial stress alone. "
        f"{share:.0f} % of the values are confirmed by direct transients, the others "
        "are screened."
    )


def _cover_text(tables: Tables) -> str:
    critical = tables["critical_cases"]
    share = 100.0 * float(critical.share.iloc[-1]) if len(critical) else 0.0
    return (
        f"A short list, chosen greedily: these {len(critical)} landings reach, for "
        f"{share:.1f} % of the elements (wanted: {100 * COVER_SHARE:g} %), at least "
        f"{100 * (1 - COVER_TOLERANCE):g} % of the largest stress of the campaign."
    )


def _statistics_text(result: CampaignResult) -> str:
    text = (
        "Share of the landings in which a peak is exceeded, with the bounds of 90 % "
        "confidence (Clopper and Pearson). "
    )
    if not result.campaign.samples:
        text += (
            "No axis of this campaign has a distribution: the shares are those of the "
            "list of cases, not of landings in service."
        )
    return text


def _screening_text(result: CampaignResult) -> str:
    if not result.sample or result.errors.empty:
        return (
            "Not measured: no landing was drawn at random (confirm.sample: 0). "
            "Screened values have no known error."
        )
    m = len(result.sample)
    return (
        f"{m} landings drawn at random were integrated directly. Differences over "
        "the component's largest stress in the same landing, all elements; the next "
        "landing drawn likewise stays below the worst with a probability of "
        f"{m}/{m + 1}. Elements below {MATTERS:.0%} of their component's largest "
        "stress play no part "
        "in the choice of what is confirmed."
    )
