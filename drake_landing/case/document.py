"""YAML 1.2 as people mean it: a tree of plain values, and where each of them stands.

PyYAML parses; what words mean follows the core schema of YAML 1.2: true and false are
the only booleans, yes, on, 1:10 and dates are text, and a number with a leading zero,
which some programs read as octal, is refused. Booleans stay text until a field asks for
one: they are never numbers. Depth, aliases and numbers have limits, cycles and tags are
errors; each in one line.
"""

import re
from typing import Any

import yaml

from fem.errors import InputError

_MOST_NODES = 100_000
_DEEPEST = 40
_LONGEST_NUMBER = 40  # characters
_LARGEST = 1e30  # of any quantity; squares and cubes stay within double precision
_INTEGER = re.compile(r"[-+]?\d+$|0x[\da-fA-F]+$|0o[0-7]+$")
_FLOAT = re.compile(r"[-+]?(?:\.\d+|\d+(?:\.\d*)?)(?:[eE][-+]?\d+)?$")
_UNBOUNDED = re.compile(r"[-+]?\.(?:inf|Inf|INF)$|\.(?:nan|NaN|NAN)$")
_LEADING_ZERO = re.compile(r"[-+]?0\d+$")
_NULL = ("", "~", "null", "Null", "NULL")
_BOOLEAN = {w: w.lower() for w in "true True TRUE false False FALSE".split()}
_SEPARATOR = re.compile("[\x85\u2028\u2029]")
_SURROGATE = re.compile("[\ud800-\udfff]")
_WORDS = {
    "mapping values are not allowed here": "a ':' where none can be; text with a colon "
    "stands between quotes, and keys of one section below each other",
    "found character '\\t' that cannot start any token": "a tab; indent with blanks",
    "found unexpected end of stream": "a quote that is not closed",
    "expected the node content": "a value is missing, or a sign that only quotes allow",
    "but found another document": "a second document, expected one",
    "could not find expected ':'": "a key without its ':'",
}


def read_document(text: str, file: str) -> tuple[Any, yaml.Node | None]:
    """Values and nodes of a YAML text.

    Args:
        text: one document.
        file: how messages name it.

    Raises:
        InputError: it is no YAML, or none that is read.
    """
    try:
        _check_events(text, file)
        tree = yaml.compose(text, Loader=yaml.SafeLoader)
    except (yaml.YAMLError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(_syntax_problem(file, error)) from None
    reader = _Reader(file)
    data = None if tree is None else reader.value(tree, "")
    if reader.problems:
        raise InputError(reader.problems)
    return data, tree


def document_text(data: Any) -> str:
    """Plain values as YAML that `read_document` gives back unchanged.

    PyYAML writes for YAML 1.1: words that mean a number since 1.2 (1e3, 0o17) and the
    line separators of Unicode, which it would fold into blanks, go between quotes.

    Args:
        data: mappings, lists, text, numbers, booleans, None.
    """
    return yaml.dump(data, Dumper=_Writer, sort_keys=False, allow_unicode=True)


class _Writer(yaml.SafeDumper):
    """SafeDumper whose plain words mean themselves in YAML 1.2."""

    def text(self, value: str) -> yaml.Node:
        other = any(p.match(value) for p in (_INTEGER, _FLOAT, _UNBOUNDED))
        quoted = other or _SEPARATOR.search(value)
        return self.represent_scalar(
            "tag:yaml.org,2002:str", value, style='"' if quoted else None
        )


_Writer.add_representer(str, _Writer.text)


def _check_events(text: str, file: str) -> None:
    """No tags, no depth that exhausts whoever follows it."""
    depth = 0
    for event in yaml.parse(text, Loader=yaml.SafeLoader):
        if (tag := getattr(event, "tag", None)) is not None:
            raise InputError(
                f"{file}:{event.start_mark.line + 1}: found the tag {tag}, expected "
                "plain values"
            )
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth > _DEEPEST:
            line = event.start_mark.line + 1
            raise InputError(
                f"{file}:{line}: more than {_DEEPEST} levels within each other"
            )


class _Reader:
    """Values of nodes, and what is wrong with them."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.problems: list[str] = []
        self.count = 0
        self.open: list[yaml.Node] = []

    def problem(self, node: yaml.Node, path: str, text: str) -> None:
        place = f"{self.file}:{node.start_mark.line + 1}"
        self.problems.append(f"{place}: {path}: {text}" if path else f"{place}: {text}")

    def value(self, node: yaml.Node, path: str) -> Any:
        self.count += 1
        if self.count > _MOST_NODES:
            raise InputError(
                f"{self.file}: more than {_MOST_NODES:,} values, aliases written out"
            )
        if any(node is other for other in self.open):
            self.problem(node, path, "an alias that refers to itself")
            return None
        if isinstance(node, yaml.ScalarNode):
            return self.scalar(node, path)
        self.open.append(node)
        if isinstance(node, yaml.MappingNode):
            found: Any = self.mapping(node, path)
        else:
            found = [
                self.value(item, f"{path}.{i}" if path else str(i))
                for i, item in enumerate(node.value)
            ]
        self.open.pop()
        return found

    def mapping(self, node: yaml.MappingNode, path: str) -> dict[Any, Any]:
        found: dict[Any, Any] = {}
        merged: dict[Any, Any] = {}
        for key, item in node.value:
            if not isinstance(key, yaml.ScalarNode):
                self.problem(key, path, "a key that is no word")
                continue
            inner = f"{path}.{key.value}" if path else key.value
            if key.value == "<<" and key.style is None:
                other = self.value(item, inner)
                if not isinstance(other, dict):
                    self.problem(item, inner, "expected an alias of a mapping")
                    continue
                merged |= other
                continue
            name = self.scalar(key, path)
            found["" if name is None else name] = self.value(item, inner)
        return merged | found

    def scalar(self, node: yaml.ScalarNode, path: str) -> Any:
        text = node.value
        if _SURROGATE.search(text):
            self.problem(node, path, "half a character (surrogate), expected text")
            return None
        if node.style is not None:
            return text
        if text in _NULL:
            return None
        if text in _BOOLEAN:
            return _BOOLEAN[text]
        if _LEADING_ZERO.match(text):
            plain = text.lstrip("+-").lstrip("0") or "0"
            self.problem(node, path, f"found {text}, expected {plain}, or '{text}'")
            return None
        if _UNBOUNDED.match(text):
            self.problem(node, path, f"found {text}, expected a finite number")
            return None
        return self.number(node, path)

    def number(self, node: yaml.ScalarNode, path: str) -> Any:
        text = node.value
        if len(text) > _LONGEST_NUMBER:
            return text
        if _INTEGER.match(text):
            number = int(text, 0) if text[:2] in ("0x", "0o") else int(text)
        elif _FLOAT.match(text):
            number = float(text)
        else:
            return text
        if abs(number) > _LARGEST:
            expected = f"a number no larger than {_LARGEST:g}"
            self.problem(node, path, f"found {text}, expected {expected}")
        return number


def _syntax_problem(file: str, error: Exception) -> str:
    mark = getattr(error, "problem_mark", None)
    problem = str(getattr(error, "problem", None) or error).split("\n")[0]
    opened = getattr(error, "context_mark", None)
    if "quoted scalar" in str(getattr(error, "context", "")) and opened:
        mark, problem = opened, "found unexpected end of stream"
    words = _WORDS.get(problem, problem)
    if problem.startswith("expected <block end>"):
        words = "does not fit the indentation of the lines above"
    elif problem.startswith(("expected ',' or", "did not find expected ',' or")):
        words = "a bracket is not closed, or a comma is missing"
    elif problem.startswith("found undefined alias"):
        words = problem.replace("found undefined alias", "no anchor is called")
    line = mark.line + 1 if mark else 1
    return f"{file}:{line}: not valid YAML: {words}"
