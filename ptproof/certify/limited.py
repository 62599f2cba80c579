"""A certificate from text, under a time limit that holds whatever the text is."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.certify.certificate import FieldCertificate
from ptproof.errors import InputError
from ptproof.reading.expressions import CONSTANTS, FUNCTIONS, parse
from ptproof.reading.limits import Answered, Unanswered, Why, apart, check_seconds


def certify_text(
    expression: str,
    names: str,
    source: str | None,
    kappa: str,
    radius: str | None = None,
    annulus: str | None = None,
    rtol: float = 1e-3,
    seconds: float = 60.0,
) -> FieldCertificate:
    """The certificate of a field given as text, computed in a process of its own.

    ``names`` and ``source`` are lists separated by commas, ``annulus`` is ``"r,R"``; numbers are exact. Raises
    :class:`InputError` for bad input, also where there is no answer soon after ``seconds``.
    """
    check_seconds(seconds, "--timeout")
    arguments = (expression, names, source, kappa, radius, annulus, rtol, seconds)
    match apart(1.6 * seconds + 5, _certify, *arguments):
        case Answered(certificate):
            return certificate
        case Unanswered(Why.TIME):
            raise InputError(f"no answer within {seconds:g} s: the expression is too large for exact algebra")
        case Unanswered(Why.FAILED, _, Exception() as error):
            raise error
        case Unanswered(_, reason):
            raise InputError(f"the computation ended without an answer ({reason})")


def _certify(
    expression: str,
    names: str,
    source: str | None,
    kappa: str,
    radius: str | None,
    annulus: str | None,
    rtol: float,
    seconds: float,
) -> FieldCertificate:
    from ptproof.certify.search import certify_field

    variables = [_variable(name) for name in split_list(names)]
    coordinates = ["0"] * len(variables) if source is None else split_list(source)
    options: dict[str, Any] = {}
    if radius is not None:
        options["radius"] = parse(radius, where="--radius")
    if annulus is not None:
        ends = split_list(annulus)
        if len(ends) != 2:
            raise InputError(f"--annulus: expected two radii r,R, got {annulus!r}")
        options["annulus"] = tuple(parse(end, where="--annulus") for end in ends)
    order = parse(kappa, where="--kappa")
    return certify_field(
        parse(expression, variables, where="EXPR"),
        variables,
        [parse(entry, where="--source") for entry in coordinates],
        int(order) if order.is_Integer else order,
        rtol=rtol,
        seconds=seconds,
        **options,
    )


def _variable(name: str) -> sp.Symbol:
    if not name.isidentifier() or name in FUNCTIONS or name in CONSTANTS:
        raise InputError(f"--vars: {name!r} cannot be the name of a variable")
    return sp.Symbol(name, real=True)


def split_list(text: str) -> list[str]:
    """The entries of a list, separated by the commas outside of parentheses."""
    entries, depth = [""], 0
    for character in text:
        depth += (character == "(") - (character == ")")
        if character == "," and depth == 0:
            entries.append("")
        else:
            entries[-1] += character
    return [entry.strip() for entry in entries]
