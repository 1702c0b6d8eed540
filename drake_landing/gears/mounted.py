"""The tyre of one wheel and the shock absorber of one gear, in the systems that hold
those of all.
"""

from dataclasses import dataclass
from typing import Any

from pydrake.systems.framework import Context

from systems.shock_absorber.strut_law import ShockAbsorberParameters
from systems.tire.tire import TireContact
from systems.tire.tire_law import TireParameters


@dataclass(frozen=True)
class MountedTire:
    """A tyre; contexts are those of the diagram that holds its system.

    Attributes:
        system: `Tire` of all wheels.
        which: its place among them.
    """

    system: Any
    which: int

    @property
    def parameters(self) -> TireParameters:
        """Of its law."""
        return self.system.parameters[self.which]

    def contact(self, root: Context) -> Any:
        """`TireContact`, see the port of `Tire`."""
        return TireContact(self._rows(root, "contact"))

    def wrench(self, root: Context) -> Any:
        """(6,) [torque; force] on the wheel at its centre, W, N m and N."""
        return self._rows(root, "wrench")

    def clearance(self, root: Context) -> Any:
        """Height of its lowest point over the runway below it, m."""
        return self.system.clearance(self._own(root), self.which)

    def rolling_radius(self, deflection: Any) -> Any:
        """Speed over spin of a wheel that rolls freely, m, at a deflection, m."""
        return self.system.rolling_radius(deflection, self.which)

    def set_factors(self, root: Context, **factors: Any) -> None:
        """Sets stiffness, damping and friction, factors on its law, 1 if not given."""
        own = self.system.GetMyMutableContextFromRoot(root)
        self.system.set_factors(own, which=self.which, **factors)

    def factors(self, root: Context) -> Any:
        """(3,) `TireTunables`."""
        values = self._own(root).get_numeric_parameter(0).CopyToVector()
        return values[3 * self.which : 3 * self.which + 3]

    def _own(self, root: Context) -> Context:
        return self.system.GetMyContextFromRoot(root)

    def _rows(self, root: Context, port: str) -> Any:
        found = self.system.GetOutputPort(port).Eval(self._own(root))
        return found.reshape(-1, 6)[self.which]


@dataclass(frozen=True)
class MountedShockAbsorber:
    """A shock absorber; contexts are those of the diagram that holds its system.

    Attributes:
        system: `ShockAbsorber` of all gears.
        which: its place among them.
    """

    system: Any
    which: int

    @property
    def parameters(self) -> ShockAbsorberParameters:
        """Of its law."""
        return self.system.parameters[self.which]

    def force(self, root: Context) -> Any:
        """N, positive apart."""
        return self.system.GetOutputPort("force").Eval(self._own(root))[self.which]

    def motion(self, root: Context) -> Any:
        """(2,) stroke, m, and rate, m/s."""
        found = self.system.GetInputPort("strut_state").Eval(self._own(root))
        return found.reshape(-1, 2)[self.which]

    def set_tunables(self, root: Context, **given: Any) -> None:
        """Sets numeric parameters, see `ShockAbsorber.set_tunables`; others stay."""
        own = self.system.GetMyMutableContextFromRoot(root)
        self.system.set_tunables(own, which=self.which, **given)

    def tunables(self, root: Context) -> Any:
        """(7,) `ShockAbsorberTunables`."""
        values = self._own(root).get_numeric_parameter(0).CopyToVector()
        return values.reshape(len(self.system.parameters), -1)[self.which]

    def _own(self, root: Context) -> Context:
        return self.system.GetMyContextFromRoot(root)
