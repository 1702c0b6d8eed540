"""The tire of one wheel and the shock absorber of one gear, whichever system holds it.

A tire is a Drake system of its own, or one of several in a system that holds them all,
which takes less time: what speaks of one of them looks the same.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pydrake.systems.framework import Context, DiagramBuilder
from pydrake.systems.primitives import Demultiplexer, Multiplexer

from systems.tire.tire import TireContact


@dataclass(frozen=True)
class _Mounted:
    system: Any
    which: int

    @property
    def parameters(self) -> Any:
        """Parameters of its law."""
        return self.system.parameters[self.which]

    def _own(self, root: Context) -> Context:
        return self.system.GetMyContextFromRoot(root)

    def _mutable(self, root: Context) -> Context:
        return self.system.GetMyMutableContextFromRoot(root)

    def _share(self, values: Any) -> Any:
        """Its part of a vector for one after the other."""
        return values.reshape(len(self.system.parameters), -1)[self.which]

    def _output(self, root: Context, port: str) -> Any:
        return self._share(self.system.GetOutputPort(port).Eval(self._own(root)))

    def _tunables(self, root: Context) -> Any:
        return self._share(self._own(root).get_numeric_parameter(0).CopyToVector())


class MountedTire(_Mounted):
    """A tire; contexts are those of the diagram that holds its system.

    Attributes:
        system: `Tire` of this wheel, or of all.
        which: its place in that system.
        parameters: `TireParameters`.
    """

    def contact(self, root: Context) -> Any:
        """`TireContact`, see the port of `Tire`."""
        return TireContact(self._output(root, "contact"))

    def wrench(self, root: Context) -> Any:
        """(6,) [torque; force] on the wheel at its center, W, N m and N."""
        return self._output(root, "wrench")

    def clearance(self, root: Context) -> Any:
        """Height of its lowest point over the runway below it, m."""
        return self.system.clearance(self._own(root), self.which)

    def rolling_radius(self, deflection: Any) -> Any:
        """Speed over spin of a wheel that rolls freely, m, at a deflection, m."""
        return self.system.rolling_radius(deflection, self.which)

    def set_factors(self, root: Context, **factors: Any) -> None:
        """Sets stiffness, damping and friction, factors on its law, 1 if not given."""
        self.system.set_factors(self._mutable(root), which=self.which, **factors)

    def factors(self, root: Context) -> Any:
        """(3,) `TireTunables`."""
        return self._tunables(root)


class MountedShockAbsorber(_Mounted):
    """A shock absorber; contexts are those of the diagram that holds its system.

    Attributes:
        system: `ShockAbsorber` of this gear, or of all.
        which: its place in that system.
        parameters: `ShockAbsorberParameters`.
    """

    def force(self, root: Context) -> Any:
        """N, positive apart."""
        return self._output(root, "force")[0]

    def motion(self, root: Context) -> Any:
        """(2,) stroke, m, and rate, m/s."""
        port = self.system.GetInputPort("strut_state")
        return self._share(port.Eval(self._own(root)))

    def set_tunables(self, root: Context, **given: Any) -> None:
        """Sets numeric parameters, see `ShockAbsorber.set_tunables`; others stay."""
        self.system.set_tunables(self._mutable(root), which=self.which, **given)

    def tunables(self, root: Context) -> Any:
        """(7,) `ShockAbsorberTunables`."""
        return self._tunables(root)


Mounted = Mapping[str, MountedTire] | Mapping[str, MountedShockAbsorber]


def systems_of(mounted: Mounted) -> dict[str, Any]:
    """The systems that hold them, each once, by their names."""
    return {one.system.get_name(): one.system for one in mounted.values()}


def joined(builder: DiagramBuilder, mounted: Mounted, port: str) -> Any:
    """One output port with that of each, one after the other."""
    systems = systems_of(mounted)
    ports = [system.GetOutputPort(port) for system in systems.values()]
    if len(ports) == 1:
        return ports[0]
    join = Multiplexer([each.size() for each in ports])
    builder.AddNamedSystem(f"{port} of {' '.join(systems)}", join)
    for i, each in enumerate(ports):
        builder.Connect(each, join.get_input_port(i))
    return join.get_output_port(0)


def each_of(builder: DiagramBuilder, mounted: Mounted, port: str) -> dict[str, Any]:
    """An output port by name, cut from a common one where a system holds several."""
    systems = systems_of(mounted)
    if len(systems) == len(mounted):
        return {name: one.system.GetOutputPort(port) for name, one in mounted.items()}
    ((title, system),) = systems.items()
    named = f"each {port} of {title}"
    if builder.HasSubsystemNamed(named):
        cut: Any = builder.GetSubsystemByName(named)
    else:
        whole = system.GetOutputPort(port)
        cut = Demultiplexer([whole.size() // len(mounted)] * len(mounted))
        builder.AddNamedSystem(named, cut)
        builder.Connect(whole, cut.get_input_port())
    return {name: cut.get_output_port(i) for i, name in enumerate(mounted)}


def feed(builder: DiagramBuilder, source: Any, mounted: Mounted, port: str) -> None:
    """Connects one output port, with values for one after the other, to all."""
    systems = systems_of(mounted)
    ports = [system.GetInputPort(port) for system in systems.values()]
    if len(ports) == 1:
        builder.Connect(source, ports[0])
        return
    cut = Demultiplexer([each.size() for each in ports])
    builder.AddNamedSystem(f"{port} for {' '.join(systems)}", cut)
    builder.Connect(source, cut.get_input_port())
    for i, each in enumerate(ports):
        builder.Connect(cut.get_output_port(i), each)
