"""DEQATN: equations of a deck, evaluated by a parser of their own.

    F(A, B) = A**2 + C;  C = ...

Arithmetic as in Fortran (** before unary minus, from right to left), functions by the
names of the Quick Reference Guide. Names of later equations of a card may use the
arguments and the equations before; the value of the last is that of the card. Quotients
of whole numbers that are not whole are refused: Fortran would cut them.
"""

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence

from fem.deck.text.values import Malformed

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[EDed][+-]?\d+)?)"
    r"|(?P<name>[A-Za-z]\w*)|(?P<sign>\*\*|[-+*/(),=]))"
)
_HEAD = re.compile(r"\s*([A-Za-z]\w*)\s*(?:\(([^()]*)\))?\s*=(.*)", re.DOTALL)
_DEEPEST = 60  # parentheses within each other


def _dim(x: float, y: float) -> float:
    return max(x - y, 0.0)


def _rss(*x: float) -> float:
    return math.sqrt(math.fsum(v * v for v in x))


FUNCTIONS: dict[str, Callable[..., float]] = {
    "ABS": math.fabs,
    "ACOS": math.acos,
    "ACOSH": math.acosh,
    "ASIN": math.asin,
    "ASINH": math.asinh,
    "ATAN": math.atan,
    "ATAN2": math.atan2,
    "ATANH": math.atanh,
    "AVG": lambda *x: math.fsum(x) / len(x),
    "COS": math.cos,
    "COSH": math.cosh,
    "DIM": _dim,
    "EXP": math.exp,
    "LOG": math.log,
    "LOG10": math.log10,
    "LOGX": lambda base, x: math.log(x) / math.log(base),
    "MAX": lambda *x: max(x),
    "MIN": lambda *x: min(x),
    "MOD": math.fmod,
    "PI": lambda x: math.pi * x,
    "RSS": _rss,
    "SIGN": math.copysign,
    "SIN": math.sin,
    "SINH": math.sinh,
    "SQRT": math.sqrt,
    "SSQ": lambda *x: math.fsum(v * v for v in x),
    "SUM": lambda *x: math.fsum(x),
    "TAN": math.tan,
    "TANH": math.tanh,
}


def evaluate(text: str, values: Sequence[float]) -> float:
    """Value of the equations of a card for the arguments of the first.

    Args:
        text: of the card, without its id.
        values: of the arguments, in their order.

    Raises:
        Malformed: it is no equation, has other arguments, or no real value.
    """
    known: dict[str, float] = {}
    result = math.nan
    for k, equation in enumerate(part for part in text.split(";") if part.strip()):
        match = _HEAD.fullmatch(equation)
        if match is None:
            raise Malformed(f"'{equation.strip()[:40]}', expected NAME(A, B) = ...")
        name, arguments, expression = match.groups()
        if k == 0:
            names = [a.strip().upper() for a in (arguments or "").split(",")]
            names = [a for a in names if a]
            if len(names) != len(values):
                raise Malformed(
                    f"{name} has {len(names)} arguments, {len(values)} are given"
                )
            known.update(zip(names, map(float, values)))
        try:
            result = float(_Parser(expression, known).value())
        except (ArithmeticError, ValueError, TypeError, RecursionError) as error:
            if isinstance(error, Malformed):
                raise
            raise Malformed(f"{name}: no real value ({error})") from None
        if not math.isfinite(result):
            raise Malformed(f"{name}: no finite value")
        known[name.upper()] = result
    if math.isnan(result):
        raise Malformed("no equation")
    return result


class _Parser:
    """Recursive descent over one expression."""

    def __init__(self, text: str, known: Mapping[str, float]) -> None:
        self._known = known
        self._tokens = list(_tokens(text))
        self._at = 0
        self._depth = 0

    def value(self) -> float:
        found = self._sum()
        if self._peek():
            raise Malformed(f"'{self._peek()}' is not expected there")
        return found

    def _peek(self) -> str:
        return self._tokens[self._at] if self._at < len(self._tokens) else ""

    def _take(self, *wanted: str) -> str:
        """The next token, where it is one of these; else ''."""
        token = self._peek()
        if token in wanted:
            self._at += 1
            return token
        return ""

    def _sum(self) -> float:
        self._depth += 1
        if self._depth > _DEEPEST:
            raise Malformed(f"more than {_DEEPEST} parentheses within each other")
        found = self._signed(self._product)
        while sign := self._take("+", "-"):
            other = self._product()
            found = found + other if sign == "+" else found - other
        self._depth -= 1
        return found

    def _signed(self, part: Callable[[], float]) -> float:
        sign = self._take("+", "-")
        return -part() if sign == "-" else part()

    def _product(self) -> float:
        found = self._power()
        while sign := self._take("*", "/"):
            other = self._power()
            if sign == "*":
                found = found * other
            elif isinstance(found, int) and isinstance(other, int):
                if other == 0 or found % other:
                    raise Malformed(
                        f"{found}/{other} of whole numbers; write {found}./{other}."
                    )
                found = found // other
            else:
                found = found / other
        return found

    def _power(self) -> float:
        base = self._atom()
        if not self._take("**"):
            return base
        exponent = self._signed(self._power)
        # As real numbers: whole ones could grow without end.
        result = math.pow(base, exponent)
        whole = isinstance(base, int) and isinstance(exponent, int) and exponent >= 0
        return int(result) if whole and result < 2.0**53 else result

    def _atom(self) -> float:
        token = self._peek()
        self._at += 1
        if token == "(":
            found = self._sum()
            self._expect(")")
            return found
        if token[:1].isdigit() or token[:1] == ".":
            text = token.upper().replace("D", "E")
            return int(text) if text.isdecimal() and len(text) < 16 else float(text)
        name = token.upper()
        if self._take("("):
            return self._call(name)
        if name not in self._known:
            raise Malformed(f"'{token or 'the end'}', expected a number or an argument")
        return self._known[name]

    def _call(self, name: str) -> float:
        if name not in FUNCTIONS:
            raise Malformed(f"the function {name} is not known here")
        arguments = [self._sum()]
        while self._take(","):
            arguments.append(self._sum())
        self._expect(")")
        return FUNCTIONS[name](*map(float, arguments))

    def _expect(self, token: str) -> None:
        if not self._take(token):
            raise Malformed(f"'{self._peek() or 'the end'}', expected '{token}'")


def _tokens(text: str) -> Iterable[str]:
    at = 0
    text = text.rstrip()
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise Malformed(f"'{text[at:].strip()[:20]}' cannot be read")
        yield match[match.lastgroup or 0]
        at = match.end()
