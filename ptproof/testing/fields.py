"""Bounds of a field, as an assertion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.testing.failure import SECONDS, assertion, in_time
from ptproof.testing.reading import expression as read
from ptproof.testing.wording import lines

__unittest = True
# A constant that has to be at least the supremum, or at most the infimum.
ABOVE = {"a1": True, "a2": False, "b1": False, "b2": True}


@assertion
def assert_field_bounds(
    expression: Any, *, variables: Sequence[sp.Symbol], source: Sequence[Any], kappa: int = 1, a1: Any = None,
    a2: Any = None, b1: Any = None, b2: Any = None, radius: Any = None, annulus: tuple[Any, Any] | None = None,
    rtol: float = 1e-3, seconds: float = SECONDS,
) -> str | None:  # fmt: skip
    """Assert that a field falls off from its source as eq:assumption2 and eq:assumption3 say.

    Parameters
    ----------
    expression
        F, SymPy or text over the names of the variables.
    variables, source
        n symbols and the n exact coordinates of x*.
    kappa
        κ, a positive integer.
    a1, a2, b1, b2
        Constants that are claimed to hold. Those that are left out only have to exist and be positive.
    radius, annulus
        The domain: a ball around the source, or the pair (r, R); the whole space if both are left out.
    rtol
        The relative width to which the best constants are enclosed.
    seconds
        The time limit. [s]

    Raises
    ------
    AssertionError
        If there are no such constants or a claimed one does not hold, with the witness or the enclosure; or if it
        is undecided, as where a claimed constant lies inside the enclosure of the best one.
    InputError, TypeError
        For data that make no sense.

    Examples
    --------
    >>> from ptproof.testing import assert_field_bounds
    >>> x, y = sp.symbols("x y", real=True)
    >>> assert_field_bounds(3 - x**2 - 2 * y**2, variables=[x, y], source=[0, 0], a1="2.1", a2="0.9")
    """
    from ptproof.certify import certify_field

    if not (isinstance(variables, Sequence) and all(isinstance(item, sp.Symbol) for item in variables)):
        raise TypeError("variables: expected a sequence of symbols")
    F = read(expression, "expression", {symbol.name: symbol for symbol in variables})
    claimed = {"a1": a1, "a2": a2, "b1": b1, "b2": b2}
    constants = {name: _constant(value, name) for name, value in claimed.items() if value is not None}
    at = [read(value, f"source[{i}]") for i, value in enumerate(source)]
    ball, ring = _end(radius), None if annulus is None else (_end(annulus[0]), _end(annulus[1]))
    certificate = in_time(
        seconds,
        "the bounds of the field",
        spare=5.0,
        work=lambda: certify_field(F, variables, at, kappa, rtol=rtol, seconds=seconds, radius=ball, annulus=ring),
    )
    return certificate if isinstance(certificate, str) else _complaint(certificate, constants, rtol, seconds)


def _complaint(certificate: Any, constants: Mapping[str, sp.Expr], rtol: float, seconds: float) -> str | None:
    """What speaks against the claimed ``constants``."""
    from ptproof.proof.verdict import Verdict

    if certificate.verdict is Verdict.REFUTED:
        witness = certificate.witness
        where = ", ".join(f"{name} = {value}" for name, value in witness.values.items())
        smaller = "" if certificate.largest_radius is None else f"the ball of radius {certificate.largest_radius}"
        return lines("the field has no such bounds: refuted", [
            ("field", str(certificate.field.expression)), ("domain", str(certificate.domain)),
            ("fails", witness.statement),
            ("witness", f"{where}: {witness.left}, but the assumption wants {witness.right}"),
            ("certified on", smaller),
        ])  # fmt: skip
    outcomes = {name: _compare(certificate, name, value, seconds) for name, value in constants.items()}
    needs_all = len(constants) < 4 and certificate.verdict is not Verdict.PROVED
    bad = [name for name, verdict in outcomes.items() if verdict is not Verdict.PROVED]
    if not bad and not needs_all:
        return None
    refuted = any(outcomes[name] is Verdict.REFUTED for name in bad)
    rows = [("field", str(certificate.field.expression)), ("domain", str(certificate.domain))]
    for name in bad:
        best = getattr(certificate, name)
        what = "at least" if ABOVE[name] else "at most"
        rows.append((name, f"{constants[name]} is {outcomes[name]}; it has to be {what} the best one, in {best}"))
    if certificate.verdict is Verdict.UNDECIDED:
        rows.append(("certificate", certificate.detail))
    elif not refuted:
        rows.append(("to decide", f"a smaller rtol than {rtol:g}, or a constant a little to the safe side"))
    if refuted:
        return lines("a bound of the field does not hold: refuted", rows)
    return lines("the bounds of the field could not be decided: undecided", rows)


def _constant(value: Any, name: str) -> sp.Expr:
    number = read(value, name)
    if number.free_symbols or not number.is_positive:
        raise InputError(f"{name}: expected a positive number, got {number}")
    return number


def _end(value: Any) -> sp.Expr | None:
    return None if value is None else read(value, "radius")


def _compare(certificate: Any, name: str, value: sp.Expr, seconds: float) -> Any:
    """Whether a claimed constant holds: by the enclosure of the best one, else by a proof for this very number."""
    from ptproof.balls.ball import separated
    from ptproof.proof.verdict import Verdict

    best = getattr(certificate, name)
    safe, unsafe = (best.upper, best.lower) if ABOVE[name] else (best.lower, best.upper)
    sign = 1 if ABOVE[name] else -1
    if safe is not None and (separated(value, sp.Rational(safe)) == sign or value == sp.Rational(safe)):
        return Verdict.PROVED
    if unsafe is not None and separated(value, sp.Rational(unsafe)) == -sign:
        return Verdict.REFUTED
    return _directly(certificate, name, value, seconds)


def _directly(certificate: Any, name: str, value: sp.Expr, seconds: float) -> Any:
    """The inequality itself, squared where it speaks of the gradient's norm, on the whole domain."""
    from ptproof.certify.search import not_differentiable
    from ptproof.proof.claim import Goal
    from ptproof.proof.statement import ge, le
    from ptproof.proof.verdict import Verdict
    from ptproof.testing.relations import decide

    field, domain = certificate.field, certificate.domain
    if name in ("b1", "b2") and not_differentiable(field, domain) is not None:
        return Verdict.UNDECIDED
    square = sp.Add(*((x - s) ** 2 for x, s in zip(field.variables, field.source, strict=True)))
    if name in ("a1", "a2"):
        quantity, bound = field.peak - field.expression, value * square**field.kappa
    else:
        quantity = sp.Add(*(slope**2 for slope in field.gradient))
        bound = value**2 * square ** (2 * field.kappa - 1)
    given = [ge(square, domain.inner**2)]
    if domain.outer is not None:
        given.append(le(square, domain.outer**2))
    real = {symbol: sp.Symbol(symbol.name, real=True) for symbol in field.variables}
    statement = (le if ABOVE[name] else ge)(quantity.xreplace(real), bound.xreplace(real))
    goal = Goal(f"assert_field_bounds/{name}", statement, tuple(part.map(lambda s: s.xreplace(real)) for part in given))
    return decide(goal, min(seconds, 20.0)).verdict
