"""The wiring of a diagram as a small picture: systems and the ports that join them.

Drake's own picture shows every port of every system; this one only what is connected.
"""

import subprocess
from collections import defaultdict
from collections.abc import Sequence
from typing import Any

from pydrake.systems.framework import Diagram
from pydrake.systems.primitives import VectorLogSink

_HEAD = """digraph wiring {
rankdir=LR; ranksep=0.9; nodesep=0.15;
node [shape=box, style="rounded,filled", fillcolor="#eef3fa", color="#5c6773",
fontname="Helvetica", fontsize=12];
edge [color="#1f5fbf", fontcolor="#5c6773", fontname="Helvetica", fontsize=9];
"""


def wiring_dot(diagram: Diagram, without: Sequence[str] = ("energy_budget",)) -> str:
    """The systems of a diagram and their connections in the dot language.

    Connections between the same two systems are one arrow, labelled with the names of
    the output ports.

    Args:
        diagram: the diagram; loggers are left out.
        without: names of systems to be left out.
    """

    def shown(system: Any) -> bool:
        return (
            not isinstance(system, VectorLogSink) and system.get_name() not in without
        )

    systems = [system for system in diagram.GetSystems() if shown(system)]
    rank = {system.get_name(): i for i, system in enumerate(systems)}
    arrows = defaultdict(set)
    for (target, _), (source, port) in diagram.connection_map().items():
        if shown(source) and shown(target):
            name = source.get_output_port(port).get_name()
            arrows[rank[source.get_name()], rank[target.get_name()]].add(name)
    names = list(rank)
    lines = [f'"{name}";' for name in names]
    for (source, target), ports in sorted(arrows.items()):
        label = "\\n".join(sorted(ports))
        lines.append(f'"{names[source]}" -> "{names[target]}" [label="{label}"];')
    return _HEAD + "\n".join(lines) + "\n}\n"


def wiring_svg(diagram: Diagram, without: Sequence[str] = ("energy_budget",)) -> str:
    """The picture as SVG, drawn by the program `dot` of Graphviz.

    Raises:
        FileNotFoundError: `dot` is not installed.
    """
    drawn = subprocess.run(
        ["dot", "-Tsvg"],
        input=wiring_dot(diagram, without),
        capture_output=True,
        text=True,
        check=True,
    )
    return drawn.stdout
