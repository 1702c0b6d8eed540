"""Fields IN and ISOP of PSOLID: how a solid is integrated.

Blank fields are the default of each element: CHEXA and CPENTA with reduced shear, with
bubble functions where there are no mid-sides; CTETRA and CPYRAM have one integration
only (tables of PSOLID in MSC's guide of 2022). A combination that an element does not
have becomes the default, with a notice, as there.
"""

from fem.elements.solids.solid import Matrices, Shape

_IN = {"": "", "0": "", "BUBBLE": "", "2": "TWO", "TWO": "TWO"}
_IN |= {"3": "THREE", "THREE": "THREE"}
_ISOP = {
    "": "REDUCED",
    "0": "REDUCED",
    "REDUCED": "REDUCED",
    "1": "FULL",
    "FULL": "FULL",
}
_ONE_WAY = ("CTETRA", "CPYRAM")


def integration_of(shape: Shape, integ: str, isop: str) -> Matrices | None:
    """Stiffness and stresses as the fields ask for; None where there is no such way."""
    network, scheme = _IN.get(integ.upper()), _ISOP.get(isop.upper())
    quadratic = shape.nodes > shape.corners
    if quadratic and network == "":
        network = "THREE"
    if shape.card in _ONE_WAY or (network == "" and scheme == "REDUCED"):
        return shape.matrices
    if quadratic and (network, scheme) == ("THREE", "REDUCED"):
        return shape.matrices
    if network is None or scheme is None:
        return None
    return shape.integration.get((network, scheme))
