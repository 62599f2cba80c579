"""What the readers of TOML files share: exact decimals, near matches, names, and errors with their place."""

from dataclasses import dataclass
from dataclasses import field as member
from typing import Any

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.tables import (
    RESERVED,
    build_from,
    check_choice,
    check_shape,
    declared,
    finite,
    hint,
    listed,
    read_file,
)


@dataclass(frozen=True)
class Row:
    field: Any
    signal: Any = "0"


@dataclass(frozen=True)
class Body:
    state: list[Any]
    row: list[Row]
    period: Any = None


@dataclass(frozen=True)
class Tables:
    body: Body
    free: dict[str, Any] = member(default_factory=dict)
    other: Row | None = None


@dataclass(frozen=True)
class Number:
    a: Any


def test_decimals_stay_exact():
    assert build_from("a = 1.8", "here", Number, lambda data: finite(data["a"], "a")) == sp.Rational(9, 5)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a =", "^here: not TOML"),
        ("a = " + "9" * 5000, "^here: not TOML"),
        ("a = nan", "^here: a: nan is not a finite"),
        ("a = -inf", "^here: a: -inf is not"),
    ],
)
def test_every_error_opens_with_the_place(text, message):
    with pytest.raises(InputError, match=message):
        build_from(text, "here", Number, lambda data: finite(data["a"], "a"))


@pytest.mark.parametrize(
    ("word", "expected"),
    [("perod", " (did you mean 'period'?)"), ("PERIOD", " (did you mean 'period'?)"), ("mass", "")],
)
def test_a_near_word_is_offered(word, expected):
    assert hint(word, ("period", "state")) == expected


GOOD = {"body": {"state": ["x"], "row": [{"field": 1}, {"field": 2, "signal": 3}]}, "free": {"any": 1}}


def test_tables_have_the_declared_shape():
    check_shape(GOOD, Tables)
    check_shape({**GOOD, "other": {"field": 1}}, Tables)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ({"bdy": {}}, "unknown table: 'bdy' (did you mean 'body'?); known: body, free, other"),
        ({}, "the table [body] is missing"),
        ({"body": 1}, "body: expected a table [body]"),
        ({"body": {"row": []}}, "body.state is missing"),
        ({"body": {"state": [], "row": {}}}, "body.row: expected a list, got {}"),
        ({"body": {"state": [], "row": [1]}}, "body.row[1]: expected a table [[body.row]]"),
        ({"body": {"state": [], "row": [{"field": 1}, {}]}}, "body.row[2].field is missing"),
        ({"body": {"state": [], "row": [], "Period": 1}}, "unknown key in [body]: 'Period' (did you mean 'period'?)"),
        ({**GOOD, "free": 1}, "free: expected a table [free]"),
        ({**GOOD, "other": 1}, "other: expected a table [other]"),
    ],
)
def test_another_shape_is_refused_with_its_place_and_what_would_be_right(data, message):
    with pytest.raises(InputError) as caught:
        check_shape(data, Tables)
    assert str(caught.value).startswith(message)


def test_a_list_has_the_length_that_is_wanted():
    assert listed([1, 2], "x", 2, "states") == [1, 2]
    for value, message in (
        ("x", "x: expected a list, got 'x'"),
        ([1], "x: 1 entries for 2 states; give one for each"),
        ([0] * 513, "more than 512"),
    ):
        with pytest.raises(InputError, match=message):
            listed(value, "x", 2, "states")


def test_a_choice_is_one_of_the_known_words():
    assert check_choice("power", ("paper", "power"), "clock") == "power"
    for value, message in (("pwer", "did you mean 'power'"), (3, "clock: 3 is not one of paper, power")):
        with pytest.raises(InputError, match=message):
            check_choice(value, ("paper", "power"), "clock")


@pytest.mark.parametrize("name", ["1x", "x y", "ξ", "", 3, None, [1]])
def test_what_is_not_a_name_is_refused(name):
    with pytest.raises(InputError, match="is not a name"):
        declared([name], "here", RESERVED)


def test_a_name_stands_once():
    assert declared(["a", "b"], "here", RESERVED, ["c"]) == ["a", "b"]
    for names in (["a", "a"], ["c"]):
        with pytest.raises(InputError, match="is declared twice"):
            declared(names, "here", RESERVED, ["c"])


@pytest.mark.parametrize("name", ["sin", "pi", "Piecewise", "Derivative"])
def test_a_reserved_name_is_refused_only_where_it_is_reserved(name):
    assert declared([name], "here", ()) == [name]
    with pytest.raises(InputError, match="a meaning of its own"):
        declared([name], "here", RESERVED)


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    (tmp_path / "latin.toml").write_bytes(b"\xff")
    (tmp_path / "large.toml").write_bytes(b"#" * 1_000_001)
    for name, reason in (("absent", "No such file"), ("latin", "not UTF-8"), ("large", "not a thing$")):
        with pytest.raises(InputError, match=rf"{name}\.toml: .*{reason}"):
            read_file(tmp_path / f"{name}.toml", "a thing")
