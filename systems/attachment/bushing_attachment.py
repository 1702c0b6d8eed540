"""Landing gears held by the airframe through elastic fittings.

The flexibility of a fitting that the airframe model does not contain. Not a cheap
substitute for the rigid attachment: stiff bushings need several times its steps.
"""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import RigidBody
from pydrake.systems.framework import Context

from systems.attachment.attachment import Attachment, Gap
from systems.attachment.attachment_points import AttachmentPoint

Float64 = npt.NDArray[np.float64]


class BushingAttachment(Attachment):
    """Linear springs and dampers between fitting and node; ports of `Attachment`.

    The load on the fitting is -(k g + d g') along each row of the hold, with g the gap;
    a direction with a stiffness of its own keeps it. The inputs of the
    forces on the gears and of the nodes' accelerations are there but not used.
    Stiffness is isotropic, so that it needs no axes.

    Args:
        plant, points: see `Attachment`.
        translational_stiffness: N/m.
        rotational_stiffness: N m/rad.
        translational_damping: N s/m.
        rotational_damping: N m s/rad.

    Raises:
        ValueError: a stiffness is not positive, or a damping is negative.
    """

    def __init__(
        self,
        plant: MultibodyPlant,
        points: Sequence[RigidBody | AttachmentPoint],
        *,
        translational_stiffness: float = 2e8,
        rotational_stiffness: float = 1e8,
        translational_damping: float = 0.0,
        rotational_damping: float = 0.0,
    ) -> None:
        stiffness = (rotational_stiffness, translational_stiffness)
        damping = (rotational_damping, translational_damping)
        if min(stiffness) <= 0:
            raise ValueError(
                "bushing: stiffness (rotational N m/rad, translational N/m) is "
                f"{stiffness}, expected > 0"
            )
        if min(damping) < 0:
            raise ValueError(
                "bushing: damping (rotational N m s/rad, translational N s/m) is "
                f"{damping}, expected >= 0"
            )
        super().__init__(plant, points)
        pattern = self._pattern
        own = pattern.stiffness > 0.0
        given = np.where(pattern.rotational, *stiffness)
        self._stiffness = np.where(own, pattern.stiffness, given)
        given = np.where(pattern.rotational, *damping)
        self._damping = np.where(own, pattern.damping, given)

    def _sources(self) -> set:
        return set()

    def _load(self, context: Context, gap: Gap) -> Float64:
        return -(self._stiffness * gap.gap + self._damping * gap.rate)

    def _stored_energy(self, gap: Gap) -> float:
        return 0.5 * float((self._stiffness * gap.gap**2).sum())

    def _power_loss(self, gap: Gap) -> float:
        return float((self._damping * gap.rate**2).sum())
