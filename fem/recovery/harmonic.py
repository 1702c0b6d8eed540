"""Element results of harmonic motion: complex where they are linear.

What is linear in the displacements has an amplitude and a phase. The von Mises stress
has neither: its square is a quadratic form q of stresses s(t) = Re(S exp(iωt)), so that
over a cycle it is largest at

    q_max = (a + |b|) / 2,  a = q(Re S) + q(Im S),  b = q(Re S) - q(Im S) + 2 i r,

with the bilinear form r of both parts. Principal values, angles and the extremes over
the points of a section are not written.
"""

import re
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from fem.recovery.elements import ElementTable

Complex128 = npt.NDArray[np.complex128]

# A column is `c<corner>_<name>_<fibre, ply, end or station>`.
_NAME = r"(?:c\d+_)?(?:{})(?:_(?:\d+|p\d+|[ab]|s\d+))?"
_NOT_LINEAR = re.compile(
    _NAME.format("angle|major|mid|minor|max_shear|smax|smin|smax[ab]|smin[ab]")
)
_MISES = re.compile(_NAME.format("von_mises"))
_CONSTANT = re.compile(_NAME.format("fibre"))


def harmonic_table(
    table: ElementTable, linear: Complex128
) -> tuple[ElementTable, Complex128]:
    """The columns of a table that harmonic motion has, and their values (f, e, c).

    Args:
        table: all columns.
        linear: (f, r) complex linear quantities.
    """
    keep = [k for k, c in enumerate(table.columns) if not _NOT_LINEAR.fullmatch(c)]
    names = tuple(table.columns[k] for k in keep)
    real, imaginary = (
        table.evaluate(part)[..., keep] for part in (linear.real, linear.imag)
    )
    values = real + 1j * imaginary
    constant = [k for k, c in enumerate(names) if _CONSTANT.fullmatch(c)]
    values[..., constant] = real[..., constant]
    mises = [k for k, c in enumerate(names) if _MISES.fullmatch(c)]
    if mises:
        both = table.evaluate(linear.real + linear.imag)[..., keep][..., mises] ** 2
        p, q = real[..., mises] ** 2, imaginary[..., mises] ** 2
        swing = np.hypot(p - q, both - p - q)
        values[..., mises] = np.sqrt(0.5 * (p + q + swing))
    return replace(table, columns=names), values
