"""Text of other people where it could be taken for something else.

Names of a deck or a case reach file names, groups of HDF5, comments of decks, cells
that a spreadsheet computes, attributes of pages. Each of these has one function here.
Templates escape on their own; pictures take no text for mathematics (`plots.panels`);
terminals get what is `fem.errors.visible`.
"""

import hashlib
import html
import re

_LONGEST = 80  # characters of a file name
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def file_name(text: str) -> str:
    """A name without folders, alike for equal texts and different for others.

    Letters, digits, `_`, `.`, `-` stay, blanks become `_`; what else changes adds
    a few digits of a hash.
    """
    plain = re.sub(r"[^\w.-]", "_", text.replace(" ", "_"), flags=re.ASCII)
    plain = plain.lstrip(".")[:_LONGEST]
    if plain and plain == text.replace(" ", "_"):
        return plain
    mark = hashlib.blake2b(text.encode("utf-8", "replace"), digest_size=4).hexdigest()
    return f"{plain}_{mark}".lstrip("_")


def group_name(text: str) -> str:
    """One step of a path in HDF5: no `/`, not `.` or `..`; % as in URLs."""
    plain = text.replace("%", "%25").replace("/", "%2F").replace("\0", "%00")
    return plain.replace(".", "%2E") if not plain.strip(".") else plain


def comment(text: str) -> str:
    """Text that may follow the `$` of a deck: one line, nothing that ends it."""
    return "".join(c if c.isprintable() else " " for c in text)


def cell(text: str) -> str:
    """A cell that spreadsheets do not compute: `'` before `=`, `+`, `-`, `@`.

    Numbers stay as they are.
    """
    if not text.startswith(_FORMULA):
        return text
    try:
        float(text)
    except ValueError:
        return f"'{text}"
    return text


def attribute(text: str) -> str:
    """Text between the quotes of an attribute of HTML or SVG."""
    return html.escape(text, quote=True)
