"""An instrument takes its expressions from claims, and says what is wrong with one that does not fit."""

import sys
from dataclasses import replace
from types import SimpleNamespace

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof import claim, eq, ge, gt, le, limits
from ptproof.report.compose import compose
from ptproof.report.instruments import Instrument, Quantity, Region, Slider, instruments_of, taken

k, E = sp.Symbol("k", positive=True), sp.Symbol("E", nonnegative=True)
t, c = sp.Symbol("t", real=True), sp.Symbol("c", positive=True)
n, kappa = sp.symbols("n kappa", integer=True, positive=True)
X = sp.Function("X", real=True)
SLIDERS = (Slider(k, "0.1", 10, 2), Slider(E, 0, 4, 1), Slider(kappa, 2, 5, 2))


def claimed(statement, *given):
    return claim("some", "Some", statement, given=given)(limits)


def test_the_expression_is_the_claims_own():
    said = claimed(le(c, 2 * k + E), gt(k, E))
    found = taken(said, SLIDERS)
    assert found.right is said.statement.right
    assert found.given == (gt(k, E),)


def test_an_abbreviation_is_what_the_claim_says_that_it_is():
    found = taken(claimed(le(t, c * k), eq(c, sp.sqrt(E))), SLIDERS)
    assert found.right == sp.sqrt(E) * k
    assert (c, sp.sqrt(E)) in found.at


def test_a_letter_may_be_short_for_what_stands_there():
    found = taken(claimed(le(X(t), X(0) * sp.exp(-k)), ge(X(0), 1)), SLIDERS, short={c: X(0)})
    assert found.right == c * sp.exp(-k)
    assert found.given == (ge(c, 1),)


def test_a_letter_is_not_short_for_what_does_not_stand_there():
    with pytest.raises(InputError, match=r"c would be short for X\(1\)"):
        taken(claimed(le(X(t), X(0))), SLIDERS, short={c: X(1)})


def test_a_value_may_be_of_its_kind_over_the_range_of_a_slider():
    assert taken(claimed(le(t, k**n)), SLIDERS, {n: kappa - 1}).right == k ** (kappa - 1)


@pytest.mark.parametrize(
    ("at", "sliders"),
    [({n: kappa - 2}, SLIDERS), ({n: kappa - 1}, (Slider(kappa, 1, 5, 2),)), ({k: -E - 1}, SLIDERS), ({k: t}, SLIDERS),
     ({n: kappa / 2}, SLIDERS)],
)  # fmt: skip
def test_a_value_of_another_kind_is_refused(at, sliders):
    with pytest.raises(InputError, match="not known to be what"):
        taken(claimed(le(t, k**n)), sliders, at)


@pytest.mark.parametrize("part", [1, -1])
def test_a_part_that_is_not_there_is_refused(part):
    with pytest.raises(InputError, match="there is no part"):
        taken(claimed(le(t, k)), SLIDERS, part=part)


def test_what_is_typed_is_refused():
    with pytest.raises(InputError, match="from claims and definitions"):
        taken(SimpleNamespace(statement=le(t, k)), SLIDERS)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((k, 0, 1, "0.5"), "not of the kind"), ((kappa, 2, "4.5", 3), "not of the kind"), ((k, 1, 2, 3), "lowest"),
        ((k, 1, 1, 1), "lowest"), ((E, 0, 1, "0.5", True), "logarithmic"), ((k, 0.1, 1, 1), "exact number"),
    ],
)  # fmt: skip
def test_a_slider_that_does_not_fit_is_refused(arguments, words):
    with pytest.raises(InputError, match=words):
        Slider(*arguments)


def quantity(statement, *given, **how):
    return Quantity("It", taken(claimed(statement, *given), SLIDERS, **how))


@pytest.mark.parametrize(
    ("parts", "command", "words"),
    [
        ((quantity(le(t, c)),), "", "no slider moves c"),
        ((quantity(le(t, sp.LambertW(k))),), "", "no exact counterpart"),
        ((quantity(le(t, X(k))),), "", "no exact counterpart"), ((quantity(le(t, k)),), "echo {q}", "asks for q"),
        ((Region("R", k, c, (taken(claimed(le(t, k), gt(k, E)), SLIDERS),)),), "", "both axes"),
        ((Region("R", k, E, (taken(claimed(le(t, k), gt(k, c)), SLIDERS),)),), "", "no slider moves c"),
    ],
)  # fmt: skip
def test_an_instrument_that_does_not_fit_is_refused(parts, command, words):
    with pytest.raises(InputError, match=words):
        Instrument("some", "Some", "", SLIDERS, parts, command)


def test_a_claim_of_another_derivation_is_refused(tooled):
    from ptproof.proof.result import Verification

    stranger = Instrument("some", "Some", "", SLIDERS, (quantity(le(t, k)),))
    with pytest.raises(InputError, match="some: no claim of this derivation"):
        compose(Verification((), 0.0), tooled, instruments=[stranger])


def test_what_is_no_instrument_is_refused(tooled, monkeypatch, tools):
    module = sys.modules[f"{tooled.packages[0].__name__}.instruments"]
    for given in ([1], [tools[0], tools[0]]):
        monkeypatch.setattr(module, "instruments", lambda given=given: given)
        with pytest.raises(InputError, match="gives instruments"):
            list(instruments_of(tooled))


def test_a_derivation_without_the_module_has_none(tooled, monkeypatch):
    monkeypatch.delitem(sys.modules, f"{tooled.packages[0].__name__}.instruments")
    assert list(instruments_of(tooled)) == []


def test_another_name_is_refused(tools):
    with pytest.raises(InputError, match="named by"):
        replace(tools[0], name="No name")
