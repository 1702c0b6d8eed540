"""What every element type offers: dense element matrices, all elements at once.

The assembler, the constraint elimination and the recovery know elements only through
this protocol. A block holds all elements of one card whose matrices have one shape.

Frames: `frame == "basic"` means that the matrices belong to the six freedoms of each
grid along the axes of the basic frame; the assembler turns them into the displacement
frames (CD). Scalar elements act on freedoms of the displacement frames directly
(`frame == "displacement"`). Units are those of the deck.
"""

from dataclasses import dataclass
from typing import Literal, Protocol

from fem.arrays import Float64, Int64


@dataclass(frozen=True, kw_only=True)
class Recovery:
    """Element results as a linear map of the element's freedoms.

    Attributes:
        table: name of the result, the key of the result files ("CQUAD4").
        columns: names of the c printed columns, Nastran's, in Nastran's order.
        matrix: (e, c_linear, n) linear map from element freedoms (the block's `frame`)
            to linear quantities.
        id: (e,) element ids.
        rate: (e, c_linear, n) what velocities of the freedoms add (dampers), or None.
        loss: (e, c_linear, n) the imaginary part of `matrix` in harmonic motion
            (structural damping), or None.
    """

    table: str
    columns: tuple[str, ...]
    matrix: Float64
    id: Int64
    rate: Float64 | None = None
    loss: Float64 | None = None

    def derive(self, linear: Float64) -> Float64:
        """Printed columns from linear quantities; overridden for von Mises etc.

        Args:
            linear: (..., e, c_linear).

        Returns:
            (..., e, c) in the order of `columns`.
        """
        return linear

    def heated(self, relief: Float64, heat: Float64) -> tuple["Recovery", Float64]:
        """The recovery under temperatures, and what these add to its quantities.

        Args:
            relief: (e, c_linear) what free expansion takes from them.
            heat: (e, 2) degrees, and degrees per length over the thickness; results
                that these leave where nothing hinders override it (plies).
        """
        return self, relief


Kind = Literal["force", "stress", "strain", "failure"]


@dataclass(frozen=True, kw_only=True)
class Detail:
    """How results are asked for.

    Attributes:
        corner: results of quadrilaterals at the corners, too (CORNER, BILIN, ...).
        fibre: strains of shells at both fibres instead of curvatures (FIBER).
        ends: forces of CBAR at both ends, which differ under PLOAD1.
        stations: of CBEAM at the stations between the ends, and nothing else.
    """

    corner: bool = False
    fibre: bool = False
    ends: bool = False
    stations: bool = False


CENTER = Detail()


class ElementBlock(Protocol):
    """All elements of one card with matrices of one shape.

    Attributes:
        card: Nastran's name, "CQUAD4".
        id: (e,) element ids, ascending.
        dof: (e, n) rows of the g-set; -1 marks a grounded freedom.
        grid_dof: (e, m) those of the grids between which the element lies.
        frame: axes of the element matrices, see the module's text.
    """

    @property
    def card(self) -> str: ...
    @property
    def id(self) -> Int64: ...
    @property
    def dof(self) -> Int64: ...
    @property
    def grid_dof(self) -> Int64: ...
    @property
    def frame(self) -> Literal["basic", "displacement"]: ...

    def stiffness(self) -> Float64 | None:
        """(e, n, n) stiffness, None where the element has none."""
        ...

    def structural_damping(self) -> Float64 | None:
        """(e,) GE of the element's material or property, None where all are zero.

        Elements whose parts differ (CBUSH) give Σ GE K themselves, (e, n, n).
        """
        ...

    def mass(self, *, coupled: bool) -> Float64 | None:
        """(e, n, n) mass incl. non-structural mass (PARAM COUPMASS), before WTMASS."""
        ...

    def damping(self) -> Float64 | None:
        """(e, n, n) viscous damping, None where the element has none."""
        ...

    def forces(self) -> Recovery | None:
        """Element forces, None where Nastran prints none."""
        ...

    def stresses(self) -> Recovery | None:
        """Element stresses, None where Nastran prints none."""
        ...

    def strains(self) -> Recovery | None:
        """Element strains, None where Nastran prints none."""
        ...

    def recovery(self, kind: Kind, detail: Detail = CENTER) -> Recovery | None:
        """Forces, stresses, strains or failure indices in the detail asked for."""
        ...

    def of_nodal_forces(self, kind: Kind, detail: Detail = CENTER) -> Float64 | None:
        """(e, c_linear, n) linear quantities from forces upon the element's freedoms.

        None where no load can act on the element between its grids (PLOAD1).
        """
        ...
