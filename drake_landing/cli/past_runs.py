"""`show-run` and `cache`: what is kept of runs."""

from pathlib import Path
from typing import Annotated

import typer

from drake_landing.terminal import show as show_lines


def show_run(
    folder: Annotated[Path, typer.Argument(metavar="OUT", help="results of a run")],
) -> None:
    """How a run was made, and whether its files are still those that it has read."""
    from drake_landing.results.provenance import read_provenance
    from fem.errors import InputError

    made = read_provenance(folder)
    lines = made.lines()
    width = max(len(what) for what, _ in lines)
    for what, value in lines:
        show_lines(f"{what:<{width}}  {value}")
    if changes := made.changes(folder):
        raise InputError(changes)
    print(f"\nverified: {len(made.files)} files and the gear data are those of the run")


def cache(
    clear: Annotated[bool, typer.Option("--clear", help="delete what is kept")] = False,
) -> None:
    """Where modes are kept between runs, and how much; `--clear`: machine code, too."""
    import shutil

    from drake_landing.cache import Cache
    from systems.tools.compiled import compiled_folder

    store = Cache.of_user()
    if clear:
        shutil.rmtree(compiled_folder(), ignore_errors=True)
    if store.folder is None:
        print("nothing is kept: DRAKE_LANDING_CACHE=off")
        return
    entries = store.entries()
    size = f"{len(entries)} entries, {sum(entries.values()) / 1e6:,.1f} MB"
    if clear:
        store.clear()
        print(f"{store.folder}: deleted {size}")
        return
    print(f"{store.folder}: {size} of at most {store.limit_gb:g} GB")
