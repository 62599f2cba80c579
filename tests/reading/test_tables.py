"""What the readers of TOML files share: exact decimals, near matches, names, and errors with their place."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.tables import (
    RESERVED,
    build_from,
    check_known,
    check_name,
    check_required,
    finite,
    hint,
    read_file,
)


def test_decimals_stay_exact():
    assert build_from("a = 1.8", "here", lambda data: finite(data["a"], "a")) == sp.Rational(9, 5)


@pytest.mark.parametrize(
    ("text", "message"),
    [("a =", "^here: not TOML"), ("a = nan", "^here: a: nan is not a finite"), ("a = -inf", "^here: a: -inf is not")],
)
def test_every_error_opens_with_the_place(text, message):
    with pytest.raises(InputError, match=message):
        build_from(text, "here", lambda data: finite(data["a"], "a"))


@pytest.mark.parametrize(
    ("word", "any_case", "expected"),
    [
        ("perod", False, " (did you mean 'period'?)"),
        ("PERIOD", True, " (did you mean 'period'?)"),
        ("PERIOD", False, ""),
        ("mass", True, ""),
    ],
)
def test_a_near_word_is_offered(word, any_case, expected):
    assert hint(word, ("period", "state"), any_case=any_case) == expected


def test_an_unknown_key_is_refused_with_the_known_ones():
    check_known({"state": 1}, ("period", "state"), "key")
    with pytest.raises(InputError, match=r"unknown key: 'stat' \(did you mean 'state'\?\); known: period, state"):
        check_known({"stat": 1}, ("period", "state"), "key")


def test_a_missing_key_is_named():
    check_required({"state": 1}, ("state",), "system")
    with pytest.raises(InputError, match=r"^system\.period is missing$"):
        check_required({"state": 1}, ("state", "period"), "system")


@pytest.mark.parametrize("name", ["1x", "x y", "ξ", "", 3, None])
def test_what_is_not_a_name_is_refused(name):
    with pytest.raises(InputError, match="is not a name"):
        check_name(name, "here", RESERVED)


@pytest.mark.parametrize("name", ["sin", "pi", "Piecewise", "Derivative"])
def test_a_reserved_name_is_refused_only_where_it_is_reserved(name):
    assert check_name(name, "here", ()) == name
    with pytest.raises(InputError, match="a meaning of its own"):
        check_name(name, "here", RESERVED)


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    (tmp_path / "latin.toml").write_bytes(b"\xff")
    (tmp_path / "large.toml").write_bytes(b"#" * 1_000_001)
    for name, reason in (("absent", "No such file"), ("latin", "not UTF-8"), ("large", "not a thing$")):
        with pytest.raises(InputError, match=rf"{name}\.toml: .*{reason}"):
            read_file(tmp_path / f"{name}.toml", "a thing")
