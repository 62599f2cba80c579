"""Domains: what is inside, and what is refused."""

import pytest
import sympy as sp

from ptproof.certify import Domain
from ptproof.errors import InputError


@pytest.mark.parametrize(
    ("domain", "text", "has_source"),
    [
        (Domain.of(), "the whole space", True),
        (Domain.of(radius=2), "the ball ‖x − x*‖ ≤ 2", True),
        (Domain.of(radius=sp.sqrt(2)), "the ball ‖x − x*‖ ≤ sqrt(2)", True),
        (Domain.of(annulus=(sp.Rational(1, 2), 3)), "the annulus 1/2 ≤ ‖x − x*‖ ≤ 3", False),
        (Domain.of(annulus=(0, 3)), "the ball ‖x − x*‖ ≤ 3", True),
    ],
)
def test_text_names_the_domain(domain, text, has_source):
    assert (str(domain), domain.has_source) == (text, has_source)


@pytest.mark.parametrize("ends", [(1, 1), (2, 1), (-1, 1), (1, None), (1.0, 2), ("1", 2), (sp.I, 2)])
def test_bad_annulus_is_refused(ends):
    with pytest.raises(InputError):
        Domain.of(annulus=ends)
