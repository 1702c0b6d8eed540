"""Plausibility of the loads of every preset of CS-25, and what each run keeps.

    python -m benchmarks.presets [con] [pre] [--only PRESET ...] [--hz 50] [--text]
                                 [--write]

Prints the tables of `docs/conditions.md`; with `--write` puts them there, with `--only`
the rows of these presets. `one_gear` has no row: its gear lands as in `two_point`.
"""

import argparse
import os
import re

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import pandas as pd

from drake_landing.airframe.body import load_airframe
from drake_landing.cache import Cache
from drake_landing.case.presets import (
    LANDING_SINK_RATE,
    PRESETS,
    RESERVE_SINK_RATE,
    Preset,
)
from drake_landing.case.reading import parse_case
from drake_landing.case.scenario import Scenario
from drake_landing.conditions.cs23 import CS23
from drake_landing.conditions.cs25 import CS25
from drake_landing.conditions.paragraph import Paragraph
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.landing.lift import STANDARD_GRAVITY, aircraft_mass_center
from drake_landing.landing.start import make_scenario_diagram, set_scenario_state
from drake_landing.landing.trial import Trial, try_scenario
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.reference.d150.gears import landing_gears
from drake_landing.transient.practices import rigid
from systems.airframe.modal_body import ModalBody

PAGE = Path(__file__).resolve().parents[1] / "docs" / "conditions.md"

# An independent rigid model of three freedoms and the wheels' spin, of this aircraft:
# preset, sink rate, mass in t, then stroke (m) and tire load (kN) of one main gear and
# of the nose gear.
INDEPENDENT = (
    ("three_point", 1.8288, 72.5, (0.313, 170, 0.342, 74)),
    ("two_point", 1.8288, 72.5, (0.333, 189)),
    ("three_point", LANDING_SINK_RATE, 64.5, (0.393, 328, 0.396, 162)),
    ("two_point", LANDING_SINK_RATE, 64.5, (0.409, 398)),
    ("reserve_energy", RESERVE_SINK_RATE, 64.5, (0.432, 554)),
)


Wing = tuple[int, ...]


def reference_aircraft(
    level: str, below_hz: float
) -> tuple[ModalBody, Sequence[LandingGear], Wing]:
    """Modal body, gears and the nodes that carry the lift of a built-in aircraft."""
    text = (
        f"name: presets\nairframe: {{model: {level}, select: below {below_hz:g} Hz}}\n"
        "scenario: {sink_rate: 1, lift: {}}\n"
    )
    case = parse_case(text)
    with TemporaryDirectory() as folder:
        aircraft = prepare_aircraft(case, Path(folder))
        model = load_airframe(case.airframe, aircraft, cache=Cache.of_user())
        return model.body, aircraft.gears, aircraft.lift_nodes


def run_preset(
    name: str,
    body: ModalBody,
    gears: Sequence[LandingGear],
    wing: Wing = (),
    **given: float,
) -> Trial:
    """The run of a preset, with other values where given; `wing` carries its lift."""
    values: dict[str, object] = {"preset": name, **given}
    if isinstance(lift := PRESETS[name].values.get("lift"), dict):
        values.setdefault("lift", {**lift, "nodes": wing})
    scenario = Scenario.model_validate(values)
    preset = scenario.preset_data
    assert preset is not None
    return try_scenario(body, gears, scenario, duration=preset.duration, accuracy=1e-5)


def at_rest(
    body: ModalBody, gears: Sequence[LandingGear]
) -> tuple[dict[str, float], float]:
    """Vertical load of each gear at rest, N; height of the center of gravity, m."""
    scenario = Scenario.model_validate({"preset": "taxi_bump"})
    landing = make_scenario_diagram(body, gears, scenario)
    context = landing.diagram.CreateDefaultContext()
    set_scenario_state(landing, context, scenario)
    loads = {}
    for gear in gears:
        tires = [landing.tires[wheel] for wheel in gear.wheel_names]
        loads[gear.name] = float(sum(tire.contact(context).F_z for tire in tires))
    airframe = landing.airframe.GetMyContextFromRoot(context)
    return loads, landing.airframe.GetOutputPort("pose").Eval(airframe)[6]


def conditions() -> Iterator[str]:
    """Table of the presets and their values."""
    yield "| preset | CS | condition | values | left to the case |"
    yield "|---|---|---|---|---|"
    for name, preset in PRESETS.items():
        yield (
            f"| `{name}` | {preset.paragraph} | {preset.title} | {_values(preset)} | "
            f"{preset.remarks} |"
        )


def _values(preset: Preset) -> str:
    units = {"sink_rate": "m/s", "forward_speed": "m/s", "pitch_rate": "°/s"}
    parts = []
    for name, value in preset.values.items():
        if isinstance(value, dict):  # the profile of a runway, or lift that falls
            inner = value.get("profile", value)
            value = ", ".join(f"{k} {v}" for k, v in inner.items())
        elif isinstance(value, float):
            unit = units.get(name, "°" if name in ("pitch", "roll", "yaw") else "")
            value = f"{value:g} {unit}".strip().replace(" °", "°")
        parts.append(f"{name} {value}")
    return "; ".join(parts)


def loads(trials: dict[str, Trial], static: dict[str, float]) -> Iterator[str]:
    """Table of peaks; of symmetric conditions one main gear."""
    yield (
        "| preset | gear | vertical, kN | over static | drag, kN | over vertical | "
        "tires forward, kN | side, kN | over vertical | stroke, m | stop, g |"
    )
    yield "|---|---|---|---|---|---|---|---|---|---|---|"
    for name, trial in trials.items():
        preset, peaks = PRESETS[name], trial.peaks
        for gear in peaks.index:
            if preset.symmetric and gear == "main_right":
                continue
            yield _row(name, preset, gear, peaks.loc[gear], static[gear])


def _row(name: str, preset: Preset, gear: str, peaks: pd.Series, static: float) -> str:
    ratios = preset.static_ratios
    drag, side = (
        f"{peaks[f'{q}_ratio']:.2f}" + (f" ({ratios[q]:g})" if q in ratios else "")
        for q in ("drag", "side")
    )
    cells = [
        f"`{name}`",
        "main, each" if preset.symmetric and gear != "nose" else gear,
        f"{peaks['vertical'] / 1e3:.0f}",
        f"{peaks['vertical'] / static:.2f}",
        f"{peaks['drag'] / 1e3:.0f}",
        drag,
        f"{peaks['tyre_forward'] / 1e3:.0f}",
        f"{abs(peaks['side']) / 1e3:.0f}",
        side.removeprefix("-"),
        f"{peaks['stroke']:.3f}",
        f"{peaks['extension'] / STANDARD_GRAVITY:.1f}",
    ]
    return "| " + " | ".join(cells) + " |"


def audits(trials: dict[str, Trial]) -> Iterator[str]:
    """Table of what each run keeps."""
    yield "| preset | energy | momentum | symmetry | duration, s | processor, s |"
    yield "|---|---|---|---|---|---|"
    for name, trial in trials.items():
        preset, found = PRESETS[name], trial.audit
        symmetry = f"{found.symmetry:.1e}" if preset.symmetric else "-"
        yield (
            f"| `{name}` | {found.energy:.1e} | {abs(found.momentum).max():.1e} | "
            f"{symmetry} | {preset.duration:g} | {trial.seconds:.1f} |"
        )


def rigid_models(body: ModalBody, gears: Sequence[LandingGear]) -> Iterator[str]:
    """Table: the rigid aircraft here and in the independent model."""
    yield (
        "| preset | sink, m/s | mass, t | gear | stroke, m | independent | "
        "tires, kN | independent |"
    )
    yield "|---|---|---|---|---|---|---|---|"
    whole, _ = aircraft_mass_center(body, gears)
    for name, sink_rate, tonnes, wanted in INDEPENDENT:
        mass = body.mass + 1e3 * tonnes - whole
        scaled = replace(
            rigid(body), mass=mass, inertia_G=body.inertia_G * mass / body.mass
        )
        peaks = run_preset(name, scaled, gears, sink_rate=sink_rate).peaks
        pairs = zip(("main_left", "nose"), wanted[::2], wanted[1::2])
        for gear, stroke, tires in pairs:
            found = peaks.loc[gear]
            yield (
                f"| `{name}` | {sink_rate:.2f} | {tonnes} | {gear.split('_')[0]} | "
                f"{found['stroke']:.3f} | {stroke:.3f} | "
                f"{found['vertical'] / 1e3:.0f} | {tires} |"
            )


def braked_nose_load(body: ModalBody, gears: Sequence[LandingGear]) -> float:
    """25.493(e): V_N = W/(A + B) [B + f μ A E/(A + B + μ E)], μ 0.8, f 2, in N."""
    mass, center = aircraft_mass_center(body, gears)
    _, height = at_rest(body, gears)
    nose = next(gear for gear in gears if gear.name == "nose")
    main = next(gear for gear in gears if gear.name == "main_left")
    A, B = center[0] - nose.axles[0][0], main.axles[0][0] - center[0]
    E = height + center[2] - body.p_BG[2]
    friction, factor = 0.8, 2.0
    dynamic = factor * friction * A * E / (A + B + friction * E)
    return mass * STANDARD_GRAVITY / (A + B) * (B + dynamic)


def tables(
    level: str, below_hz: float, only: Sequence[str] = ()
) -> dict[str, list[str]]:
    """Name of each table of an aircraft -> its lines; all presets, or `only` some."""
    body, gears, wing = reference_aircraft(level, below_hz)
    static, _ = at_rest(body, gears)
    mass, _ = aircraft_mass_center(body, gears)
    names = [
        name for name in PRESETS if name != "one_gear" and name in (only or PRESETS)
    ]
    trials = {name: run_preset(name, body, gears, wing) for name in names}
    head = [
        f"{mass / 1e3:.1f} t, {body.n} elastic modes below {body.frequency[-1]:.0f} "
        f"Hz; at rest the nose gear carries {static['nose'] / 1e3:.1f} kN, a main gear "
        f"{static['main_left'] / 1e3:.1f} kN, and by the formula of 25.493(e) the "
        f"nose gear {braked_nose_load(body, gears) / 1e3:.0f} kN when braked.",
        "",
    ]
    found = {f"loads_{level}": head + list(loads(trials, static))}
    found[f"audit_{level}"] = list(audits(trials))
    if level == "con" and not only:
        # The independent model has the laws of the paper's gears.
        found["rigid"] = list(rigid_models(body, landing_gears(paper=True)))
    return found


def put(page: str, name: str, lines: Sequence[str]) -> str:
    """The page with a table between its marks replaced."""
    begin, end = f"<!-- {name} -->\n", f"<!-- /{name} -->"
    text = begin + "\n".join(lines) + "\n" + end
    pattern = re.escape(begin) + ".*?" + re.escape(end)
    replaced, count = re.subn(pattern, lambda _: text, page, flags=re.DOTALL)
    if count != 1:
        raise SystemExit(f"{PAGE}: no place for {name}")
    return replaced


def with_rows(page: str, name: str, lines: Sequence[str]) -> list[str]:
    """Lines of a table of the page with the rows of some presets replaced, or added."""
    old = page.partition(f"<!-- {name} -->\n")[2].partition(f"\n<!-- /{name} -->")[0]
    rows: dict[str, list[str]] = {preset: [] for preset in PRESETS}
    for line in old.splitlines():
        if preset := _preset_of(line):
            rows[preset].append(line)
    for preset in {p for p in map(_preset_of, lines) if p}:
        rows[preset] = [line for line in lines if _preset_of(line) == preset]
    head = [line for line in lines if not _preset_of(line)]
    return head + [line for group in rows.values() for line in group]


def _preset_of(line: str) -> str | None:
    found = re.match(r"\| `(\w+)`", line)
    return found[1] if found else None


def rules(paragraphs: Sequence[Paragraph]) -> Iterator[str]:
    """Table of a rule: what it asks for and what the program does."""
    yield "| § | condition | the rule | the program | text |"
    yield "|---|---|---|---|---|"
    for p in paragraphs:
        yield f"| {p.number} | {p.title} | {p.rule} | {p.does} | {p.text} |"


def main() -> None:
    """Prints the tables, and writes them where that is wanted."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("levels", nargs="*", default=["con", "pre"])
    parser.add_argument("--only", nargs="+", choices=list(PRESETS), default=[])
    parser.add_argument("--text", action="store_true", help="tables without runs")
    parser.add_argument("--hz", type=float, default=50.0)
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    found = {"conditions": list(conditions())}
    found |= {"rules_cs25": list(rules(CS25)), "rules_cs23": list(rules(CS23))}
    for level in [] if arguments.text else arguments.levels:
        found |= tables(level, arguments.hz, arguments.only)
    page = PAGE.read_text(encoding="utf-8")
    for name, lines in found.items():
        if arguments.only and name.startswith(("loads_", "audit_")):
            lines = with_rows(page, name, lines)
        print(f"\n{name}\n", *lines, sep="\n")
        page = put(page, name, lines)
    if arguments.write:
        PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
