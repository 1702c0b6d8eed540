"""`model`, `show`, `reduce`: a deck is written, drawn, reduced."""

from pathlib import Path
from typing import Annotated

import typer

from drake_landing.cli.options import Reach, Trust, expect_deck, out_option
from drake_landing.terminal import show as show_lines


def model(
    level: Annotated[str, typer.Argument(help="con, pre, full, or from-cpacs")],
    out: Annotated[Path, typer.Option("--out", help="bulk-data file to write")],
    source: Annotated[
        Path | None, typer.Argument(metavar="FILE.xml", help="for from-cpacs")
    ] = None,
    cpacs_level: Annotated[
        str, typer.Option("--level", help="of from-cpacs: con, pre or full")
    ] = "pre",
    topology: Annotated[
        str | None,
        typer.Option("--topology", help="gears' attachment: 1, 2, full: distributed"),
    ] = None,
) -> None:
    """Writes a reference aircraft, or one from a CPACS file, as a Nastran deck."""
    from drake_landing.parametric import parametric_aircraft
    from fem.errors import InputError

    if level == "from-cpacs":
        if source is None:
            raise InputError("model from-cpacs: give a CPACS file")
        from drake_landing.reference.d150.cpacs import write_cpacs_model

        show_lines(write_cpacs_model(source, cpacs_level, out, topology).story(out))
        return
    if source is not None:
        raise InputError(f"model {level}: found {source}; only from-cpacs takes a file")
    print(parametric_aircraft(level).write(out, topology).story)


def show(
    deck: Annotated[Path, typer.Argument(metavar="MODEL.bdf", help="Nastran deck")],
    out: Annotated[Path | None, out_option("out/show/<name of the deck>")] = None,
    modes: Annotated[int, typer.Option("--modes", help="elastic modes to show")] = 10,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Pictures of a deck: mesh by component, modes, a viewer that needs no server."""
    expect_deck(deck)
    from drake_landing.show import show_model
    from fem.deck.text.source import include_reach
    from fem.files.folders import claim

    folder = claim(out or Path("out", "show", deck.stem), f"show {deck.name}")
    with include_reach(include_path or [], trust=trust):
        show_model(deck, folder, modes)


def reduce(
    deck: Annotated[Path, typer.Argument(metavar="MODEL.bdf", help="Nastran deck")],
    basis: Annotated[
        str, typer.Option("--basis", help="guyan, craig-bampton or dynamic")
    ] = "guyan",
    interface: Annotated[
        str | None,
        typer.Option("--interface", help="'SET 2' or '11, 20 THRU 30'; default ASET"),
    ] = None,
    out: Annotated[Path | None, out_option("out/reduce/<name of the deck>")] = None,
    highest: Annotated[
        float, typer.Option("--highest", help="craig-bampton: interior modes to, Hz")
    ] = 150.0,
    count: Annotated[
        int, typer.Option("--count", help="dynamic: generalised coordinates")
    ] = 60,
    compare: Annotated[
        float, typer.Option("--compare", help="modes compared with the full model, Hz")
    ] = 50.0,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Reduces a deck to interface grids; checks; HDF5, DMIG punch and OUTPUT4."""
    expect_deck(deck)
    from drake_landing.reduced.command import reduce_deck
    from fem.deck.text.source import include_reach
    from fem.files.folders import claim

    folder = claim(out or Path("out", "reduce", deck.stem), f"reduce {deck.name}")
    options = {"highest_hz": highest, "count": count, "compare_hz": compare}
    with include_reach(include_path or [], trust=trust):
        done = reduce_deck(deck, folder, basis=basis, interface=interface, **options)
    show_lines(done)
