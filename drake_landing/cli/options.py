"""What several commands take: folder of the results, reach of INCLUDE, decks, cases."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from drake_landing.case.schema import Case


Reach = Annotated[
    list[Path] | None,
    typer.Option(
        "--include-path", help="folder that INCLUDE may read beside the deck's"
    ),
]
Trust = Annotated[bool, typer.Option("--trust", help="INCLUDE may read any file")]


def out_option(default: str) -> Any:
    """Option of the folder for results."""
    return typer.Option("--out", help=f"folder of the results; default {default}")


def expect_deck(path: Path) -> None:
    """Checks that a deck is there, and no case file.

    Raises:
        InputError: it is not.
    """
    from fem.errors import InputError
    from fem.input_files import expect_file

    if path.suffix.lower() in (".yaml", ".yml"):
        raise InputError(f"{path}: is a YAML file, expected a Nastran deck")
    expect_file(path)


def read_case(path: Path) -> "Case":
    """A case whose deck is there."""
    from drake_landing.case.deck_file import deck_file
    from drake_landing.case.reading import load_case

    case = load_case(path)
    with case.reading():
        deck_file(case.airframe)
    return case


def default_folder(case: "Case") -> Path:
    """Folder for the results of a case, where none is given."""
    return Path("out", case.name)
