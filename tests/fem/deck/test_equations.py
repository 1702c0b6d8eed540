"""DEQATN: values, and text that is none."""

import contextlib
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fem.deck.equations import evaluate
from fem.deck.text.lexer import read_cards
from fem.deck.text.source import Line
from fem.deck.text.values import Malformed


@pytest.mark.parametrize(
    ("text", "values", "expected"),
    [
        ("F(D) = D", [3.0], 3.0),
        ("QUAD(a,b,c,x) = a*x**2 + b*x + c", [2.0, 3.0, 4.0, 5.0], 69.0),
        ("F(A) = -A**2", [3.0], -9.0),
        ("F(A) = 2.**3**2", [0.0], 512.0),
        ("F(A) = A**-2", [2.0], 0.25),
        ("F(A) = 1.5E-3*A + 1.D3", [2.0], 1000.003),
        ("F(A) = 8/4*A", [3.0], 6.0),
        ("F(A,B) = SQRT(A*A + B*B); G = F*2.; H = G - B", [3.0, 4.0], 6.0),
        ("F(A,B) = RSS(A, B) + MAX(A, B, 9.) + PI(1.)", [3.0, 4.0], 14.0 + math.pi),
        ("F(A) = -0.25*(A+1.0)", [3.0], -1.0),
    ],
)
def test_equations_have_the_values_of_their_arithmetic(text, values, expected):
    assert evaluate(text, values) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("F(A) = 1/2*A", "whole numbers; write 1./2."),
        ("F(A) = B", "'B', expected a number or an argument"),
        ("F(A,B) = A", "2 arguments, 1 are given"),
        ("F(A) = SQRT(-A)", "no real value"),
        ("F(A) = EXP(A*1.E6)", "no real value"),
        ("F(A) = 9.**9**9**9", "no real value"),
        ("F(A) = A/0.", "no real value"),
        ("F(A) = OPEN(A)", "function OPEN is not known"),
        ("F(A) = A.__class__", "cannot be read"),
        ("F(A) = (A", r"expected '\)'"),
        ("F(A) = " + "(" * 5000 + "A", "within each other"),
        ("F(A) = " + "A**" * 5000 + "A", "no real value"),
        ("F(A) = SIN(A, A)", "no real value"),
        ("A", "expected NAME"),
    ],
)
def test_what_is_no_equation_is_named(text, message):
    with pytest.raises(Malformed, match=message):
        evaluate(text, [2.0])


@given(st.text(alphabet="AB12.E+-*/(),;= \nSINM", max_size=40))
def test_any_text_is_a_number_or_malformed(text):
    with contextlib.suppress(Malformed):
        assert math.isfinite(evaluate(f"F(A,B) = {text}", [1.5, -2.0]))


@pytest.mark.parametrize(
    "text",
    [
        "DEQATN         1QUAD(A,B,C,X) = A*X**2 + B*X\n         + C",
        "DEQATN  1       QUAD(A,B,C,X) = A*X**2 +\n+       B*X + C",
        "DEQATN,1,QUAD(A,B,C,X) = A*X**2 + B*X\n,+ C",
        "DEQATN,1,QUAD(A,\n+,B,C,X) = A*X**2 + B*X + C",
        "DEQATN  1       QUAD(\n        A,B,C,X) = A*X**2 + B*X + C",
    ],
)
def test_an_equation_goes_on_over_lines(text):
    lines = [Line(t, "deck", k) for k, t in enumerate(text.split("\n"), start=1)]
    bulk = read_cards([*lines, Line("GRID,1", "deck", 9)])
    first, grid = bulk.cards
    assert bulk.problems == []
    assert grid.name == "GRID"
    assert first.field(1) == "1"
    assert evaluate("".join(first.fields[2:]), [1.0, 2.0, 3.0, 4.0]) == 27.0


def test_fields_may_end_with_commas_after_a_name_without_one():
    line = "CBUSH   10211,  10010,  201,    205"
    (card,) = read_cards([Line(line, "deck", 1)]).cards
    assert card.fields == ["CBUSH", "10211", "10010", "201", "205"]
