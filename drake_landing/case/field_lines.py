"""Where the fields of a case were written: problems that come up later say it too.

A problem begins with the path of its field, `gears.main_left.attachment_node: found
...`; `located` puts file and line before it. Items of lists go by number and by name.
"""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field

import yaml

from fem.errors import InputError

_PATH = re.compile(r"([a-z][\w-]*(?:\.[\w$*?-]+)*): ")


@dataclass(frozen=True)
class Places:
    """Lines of the fields of a case; equal whatever they are: no part of its content.

    Attributes:
        file: that holds the case; empty: none does.
        lines: path of a field, `airframe.deck`, -> line.
        sections: first keys of the paths that are known at all.
    """

    file: str = field(default="", compare=False)
    lines: Mapping[str, int] = field(default_factory=dict, compare=False)
    sections: frozenset[str] = field(default=frozenset(), compare=False)

    @classmethod
    def from_yaml(
        cls, file: str, tree: yaml.Node, sections: frozenset[str]
    ) -> "Places":
        """Places of the fields of a composed YAML document."""
        return cls(file, dict(_lines(tree, "")), sections)

    def line(self, path: str) -> int:
        """Line of the deepest part of a path that the file holds, else 1."""
        while path and path not in self.lines:
            path = path.rpartition(".")[0]
        return self.lines.get(path, 1)

    def named(self, problem: str) -> str:
        """A problem, with file and line where it begins with the path of a field."""
        match = _PATH.match(problem)
        if not self.file or not match or match[1].split(".")[0] not in self.sections:
            return problem
        return f"{self.file}:{self.line(match[1])}: {problem}"

    @contextmanager
    def located(self) -> Iterator[None]:
        """Errors that are raised within say file and line."""
        try:
            yield
        except InputError as error:
            raise InputError(self.named(p) for p in error.problems) from None


def _lines(node: yaml.Node, path: str) -> Iterator[tuple[str, int]]:
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            name = f"{path}{key.value}"
            yield name, key.start_mark.line + 1
            yield from _lines(value, name + ".")
    elif isinstance(node, yaml.SequenceNode):
        for i, item in enumerate(node.value):
            for name in (str(i), _name(item)):
                if name:
                    yield path + name, item.start_mark.line + 1
                    yield from _lines(item, f"{path}{name}.")


def _name(item: yaml.Node) -> str:
    """Value of the key `name` of a mapping, else nothing."""
    if not isinstance(item, yaml.MappingNode):
        return ""
    names = [v.value for k, v in item.value if k.value == "name"]
    return str(names[0]) if names else ""
