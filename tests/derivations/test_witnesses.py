"""Witnesses of the paper's claims that say no more than they should."""

import sys

from ptproof.proof import Verdict, refute


def test_the_printed_decrease_holds_without_drift(claims):
    """The witness needs the drift: without one the same point is none."""
    (claim,) = (claim for claim in claims if claim.id == "prop/decrease-printed")
    prop = sys.modules[claim.prove.__module__]
    values = {prop.F: -(prop.x1**2) - prop.x2**2, prop.f[0]: 0, prop.f[1]: 0, prop.x1: 1, prop.x2: 0,
              prop.source[0]: 0, prop.source[1]: 0, prop.kappa: 1, prop.k: 1, prop.a1: 1, prop.a2: 1, prop.b1: 2,
              prop.b2: 2, prop.d: 0, prop.T: 1, prop.t0: 0, prop.tau: 0, prop.t: 0}  # fmt: skip
    assert refute(claim.goal(), values).verdict is Verdict.UNDECIDED
