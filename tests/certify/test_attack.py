"""Certified constants are attacked; an end that is a little wrong is hit."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.certify import FieldCertificate, Range, certify_field
from ptproof.certify.attack import attack_certificate
from ptproof.proof.attack import WrongPromise
from ptproof.proof.verdict import Verdict

FIELDS = {
    "ripple": ("5/2 + cos(2*pi/3*x)/2 - (x^2 + y^2)/2", ["x", "y"], [0, 0], 1, {}),
    "quartic on a ball": ("2 - x^2 - 2*y^2 - x^4", ["x", "y"], [0, 0], 1, {"radius": 2}),
    "off the origin": ("-(x - 1)^2 - 3*(y + sqrt(2))^2", ["x", "y"], ["1", "-sqrt(2)"], 1, {}),
    "one variable": ("-x^4*(2 + sin(x))", ["x"], [0], 2, {"annulus": ("1/10", 3)}),
}


@pytest.fixture(scope="module")
def certificates() -> dict[str, FieldCertificate]:
    return {name: certify_field(*data, **domain) for name, (*data, domain) in FIELDS.items()}


@pytest.mark.parametrize("name", FIELDS)
def test_a_certificate_holds(name: str, certificates: dict[str, FieldCertificate]) -> None:
    assert certificates[name].verdict is Verdict.PROVED
    assert attack_certificate(certificates[name]) > 50


@pytest.mark.parametrize("end", ["a1", "a2", "b1", "b2"])
@pytest.mark.parametrize("name", FIELDS)
def test_a_wrong_end_is_hit(name: str, end: str, certificates: dict[str, FieldCertificate]) -> None:
    true = getattr(certificates[name], end)
    factor = 0.9 if end in ("a1", "b2") else 1.1
    wrong = replace(certificates[name], **{end: Range(true.lower * factor, true.upper * factor)})
    with pytest.raises(WrongPromise, match="ptproof is wrong here"):
        attack_certificate(wrong, rays=12)


def test_a_jump_that_was_overlooked_is_hit(certificates: dict[str, FieldCertificate]) -> None:
    field = certificates["ripple"].field
    x, y = field.variables
    jump = -(x**2 + y**2) * sp.Piecewise((1, y < 1), (2, True))
    wrong = FieldCertificate(
        replace(field, expression=jump), certificates["ripple"].domain, Verdict.PROVED,
        Range(1.0, 1.0), Range(1.0, 1.0), Range(2.0, 2.0), Range(2.0, 2.0),
    )  # fmt: skip
    with pytest.raises(WrongPromise, match=r"F\(x"):
        attack_certificate(wrong)
