"""YAML 1.2 as people mean it; what cannot be meant ends in one line."""

import contextlib
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from drake_landing.case.document import document_text, read_document
from drake_landing.case.reading import parse_case
from fem.errors import InputError

TINY = Path(__file__).parents[1].joinpath("tiny_case.yaml").read_text()


def data(text: str):
    return read_document(text, "c.yaml")[0]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("yes", "yes"),
        ("on", "on"),
        ("1:10", "1:10"),
        ("2020-01-01", "2020-01-01"),
        ("1_000", "1_000"),
        ("true", "true"),  # text until a field asks for a boolean
        ("~", None),
        ("12", 12),
        ("-3", -3),
        ("0x1F", 31),
        ("0o17", 15),
        ("1e3", 1000.0),
        ("1.e3", 1000.0),
        (".5", 0.5),
        ("'010'", "010"),
        ("9" * 41, "9" * 41),
        ("nan", "nan"),
    ],
)
def test_words_of_yaml_1_2(text, value):
    found = data(f"a: {text}")["a"]
    assert found == value
    assert type(found) is type(value)


def test_aliases_and_merges_serve():
    found = data("a: &x {b: 1, c: 2}\nd: *x\ne: {<<: *x, c: 3}")
    assert found["d"] == {"b": 1, "c": 2}
    assert found["e"] == {"b": 1, "c": 3}


BOMB = "a0: &a0 [x,x,x,x,x,x,x,x,x]\n" + "".join(
    f"a{k}: &a{k} [{','.join([f'*a{k - 1}'] * 9)}]\n" for k in range(1, 9)
)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("name: " + "[" * 2000, ":1: more than 40 levels"),
        ("name: &a [*a]", ":1: name.0: an alias that refers to itself"),
        ("a: &a {b: *a}", "an alias that refers to itself"),
        (BOMB, "more than 100,000 values"),
        ("name: !!float x", ":1: found the tag"),
        ("a: !!python/object/apply:os.system [ls]", "found the tag"),
        ("a: &x !!int 5", "found the tag"),
        ("x: 1\nnose: 010", ":2: nose: found 010, expected 10"),
        ("a: 1e999", "found 1e999, expected a number no larger than 1e+30"),
        ("a: -1e300", "found -1e300, expected a number no larger than 1e+30"),
        ("a: .nan", "found .nan"),
        ('a: "\\ud800"', "half a character"),
        ("? [a, b]\n: 1", "a key that is no word"),
        ("a: 1\n\tb: 2", ":2: not valid YAML: a tab; indent with blanks"),
        ("a: 'open\nb: 2\nc: 3", ":1: not valid YAML: a quote that is not closed"),
        ("title: Landing: hard", ":1: not valid YAML: a ':' where none can be"),
        ("a:\n   b: 1\n  c: 2", ":3: not valid YAML: does not fit the indentation"),
        ("a: [1, 2\nb: 3", "not valid YAML"),
        ("a: *b", "no anchor is called 'b'"),
        ("a: 1\n---\nb: 2", "a second document"),
        ("a: \x00", "not valid YAML"),
        ("a: {<<: 3}", "expected an alias of a mapping"),
    ],
)
def test_what_cannot_be_meant(text, words):
    with pytest.raises(InputError) as caught:
        data(text)
    assert words in str(caught.value)
    assert len(caught.value.problems) == 1


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "sink_rate: 1.2",
            "sink_rate: yes",
            "sink_rate: found 'yes', expected a number",
        ),
        (
            "sink_rate: 1.2",
            "sink_rate: true",
            "sink_rate: found true, expected a number",
        ),
        ("forward_speed: 40", "forward_speed: 1:10", "found '1:10', expected a number"),
        ("nose: 1,", "nose: 010,", "monitoring.nose: found 010, expected 10"),
        ("nose: 1,", "nose: false,", "found false, expected an integer"),
        ("nose: 1,", "nose: 1.5,", "found 1.5, expected an integer"),
        ("name: tiny", "name: " + "9" * 5000, "name: found"),
        ("axle: [2.0, 0.0, -1.35]", "axle: 3", "expected a list"),
    ],
)
def test_fields_of_another_kind(old, new, words):
    assert old in TINY
    with pytest.raises(InputError) as caught:
        parse_case(TINY.replace(old, new, 1))
    assert words in str(caught.value)
    assert "Input should" not in str(caught.value)


def test_true_is_true_where_a_boolean_is_asked_for():
    text = TINY.replace("select: count 6", "select: count 6\n  residual_vectors: true")
    assert parse_case(text).airframe.residual_vectors is True


PLAIN = st.recursive(
    st.none()
    | st.integers(-(10**12), 10**12)
    | st.floats(-1e30, 1e30)
    | st.text(max_size=8),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.text(max_size=5), inner, max_size=4)
    ),
    max_leaves=12,
)


@given(PLAIN)
@example({"\x85": None})  # a line separator that YAML folds
@example("a\u2028\u2029 b")
@example(["1e3", "0o17", "010", "0x1F", ".5", "true", "~", "<<", "1:10", ".nan"])
@settings(max_examples=100, deadline=None)
def test_what_is_written_is_read(value):
    assert data(document_text({"a": value})) == {"a": value}


@given(st.text(max_size=60))
@settings(max_examples=200, deadline=None)
def test_any_text_is_read_or_refused(text):  # and nothing else is raised
    with contextlib.suppress(InputError):
        data(text)
