"""Where the landing gears hold the airframe: a node per gear, tied to structure."""

from collections.abc import Mapping, Sequence

from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.reference_axis import ATTACHMENTS
from drake_landing.reference.d150.ties import tie

PART = "gear attachment"


def attach_gears(model: ModelBuilder, holds: Mapping[str, Sequence[int]]) -> None:
    """Ties each gear's attachment node to structural nodes.

    One structural node leads the attachment rigidly (RBE2); of several, each gets its
    share of the gear's load and the attachment moves with their mean (RBE3), so that
    the structure is not stiffened.

    Args:
        model: the bench.
        holds: gear name -> structural grid ids.
    """
    for gear, nodes in holds.items():
        model.section(PART).comment(f"gear {gear}")
        attachment = ATTACHMENTS[gear]
        if len(nodes) == 1:
            model.rigid(PART, nodes[0], "123456", [attachment])
        else:
            tie(model, PART, attachment, nodes)
