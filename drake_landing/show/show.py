"""`drake-landing show`: reads a deck, draws it, and says what was drawn."""

from pathlib import Path

from drake_landing.csv_tables import write_csv
from drake_landing.show.mesh import drawn_mesh
from drake_landing.show.mesh_pictures import draw_mesh, draw_modes
from drake_landing.show.modes import ShownModes, shown_modes
from drake_landing.show.viewer import write_viewer
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure


def show_model(deck: Path, out: Path, modes: int) -> list[Path]:
    """Writes `mesh.png`, `modes.png`, `modes.csv` and `viewer.html`, and says so.

    Args:
        deck: bulk-data file.
        out: folder.
        modes: number of elastic modes, 0 for the mesh alone.

    Returns:
        The files.

    Raises:
        InputError: whatever is wrong with the deck.
    """
    if modes < 0:
        raise InputError(f"--modes: found {modes}, expected 0 or more")
    structure = Structure.from_deck(read_deck(deck))
    mesh = drawn_mesh(structure)
    if not mesh.components:
        raise InputError(f"{deck}: no element to draw")
    out.mkdir(parents=True, exist_ok=True)
    files = [out / "mesh.png", out / "viewer.html"]
    draw_mesh(files[0], mesh)
    print(f"{deck}: {len(mesh.p)} grids, {len(mesh.components)} components")
    shown: ShownModes | None = None
    if modes:
        shown = shown_modes(structure, mesh, modes)
        for k, (hertz, name) in enumerate(zip(shown.frequency_hz, shown.names)):
            print(f"mode {k + 1:3}  {hertz:9.3f} Hz  {name}")
        if len(shown.names):
            files += [out / "modes.png", out / "modes.csv"]
            draw_modes(files[2], mesh, shown)
            table = shown.table(mesh)
            write_csv(files[3], table)
    write_viewer(files[1], deck.stem, mesh, shown)
    print("written: " + ", ".join(map(str, files)))
    return files
