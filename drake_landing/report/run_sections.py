"""How a report was made: case, gear data, provenance, files and time."""

from pathlib import Path
from typing import TYPE_CHECKING

from drake_landing.case.reading import case_text
from drake_landing.report.gear_echo import gear_echo
from drake_landing.report.page import Block, Section, pairs_block, table_block
from drake_landing.results.readme import file_lines

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult


def case_section(result: "ProcessResult") -> Section:
    """Section of the case: in short, gear data, and the file."""
    return Section(
        id="case",
        title="Case and gears",
        blocks=[
            pairs_block(_case_pairs(result)),
            gear_echo(result.aircraft.gears, result.provenance.facts["gear data"]),
            Block(
                caption="The case file, defaults written out",
                pre=case_text(result.case),
            ),
        ],
    )


def _case_pairs(result: "ProcessResult") -> list[tuple[str, str]]:
    case, body, run = result.case, result.airframe.body, result.history.figures
    sim, tr = case.simulation, case.transient
    x, y, z = result.airframe.R_AB.T @ body.p_BG  # in the frame of the deck
    last = f" up to {body.frequency[-1]:.2f} Hz" if body.n else ""
    topology = result.aircraft.topology
    return [
        (
            "aircraft",
            result.aircraft.name + (f", topology {topology}" * bool(topology)),
        ),
        (
            "airframe",
            f"{result.airframe.grids} grids, {body.mass:,.0f} kg without gears, center "
            f"of gravity at x {x:z.3f}, y {y:z.3f}, z {z:z.3f} m of the deck",
        ),
        ("basis", case.airframe.basis),
        ("elastic modes", f"{body.n} ({case.airframe.select}){last}"),
        (
            "scenario",
            f"{result.aircraft.scenario.story}; {result.aircraft.scenario.lift_story}",
        ),
        (
            "multibody run",
            f"{result.history.time[-1]:.4g} s, {sim.integrator}, accuracy "
            f"{sim.accuracy:g}: "
            f"{run['steps']:.0f} steps, {run['evaluations']:.0f} evaluations",
        ),
        (
            "direct transient",
            f"{result.loads.time[-1]:g} s in steps of {tr.step:g} s, {tr.scheme}",
        ),
    ]


def made_section(result: "ProcessResult") -> Section:
    """Section of program, files and host, see `results.provenance`."""
    seconds = sum(result.seconds.values())
    made = [
        *result.provenance.lines(),
        ("duration", f"{seconds:.1f} s until this page"),
    ]
    return Section(
        id="made",
        title="How it was made",
        text="The same stands in results.h5 (group provenance) and at the head of "
        "landing_sol109.bdf; drake-landing show-run FOLDER prints it and verifies the "
        "checksums. Paths are relative to the folder of the results.",
        blocks=[pairs_block(made)],
    )


def files_section(result: "ProcessResult", folder: Path) -> Section:
    """The files of a folder, and what each stage took."""
    return Section(
        id="files",
        title="Files and time",
        text="Beside this page lie the files below; README.txt there names the "
        "columns, units and frames.",
        blocks=[
            pairs_block(file_lines(result, folder)),
            table_block(
                result.stages.table(),
                {
                    "stage": "stage",
                    "wall": "time s",
                    "share": "share",
                    "processor": "processor time s",
                    "memory_gb": "peak memory so far GB",
                },
                {
                    "wall": ".1f",
                    "share": ".0%",
                    "processor": ".1f",
                    "memory_gb": ".2f",
                },
                "Time and memory taken until this page was written",
            ),
        ],
    )
