"""What a reader of the report may move: the Newton seeker beside its average, which knows no Hessian."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ptproof.proof import Claim
from ptproof.report.instruments import Instrument, Quantity, Region, Slider, Vehicle, taken

from . import chain
from .notation import (
    F_star,
    F_x,
    H,
    Y,
    alpha,
    alpha_t,
    c,
    d,
    h,
    nu,
    omega,
    omega_0,
    omega_d,
    p,
    source,
    t,
    x1,
    x2,
    z1,
    z2,
)
from .section4_linear import eigenvalues as gradient_eigenvalues
from .section4_linear import stable as gradient_stable
from .section5a_design import average_newton
from .section5a_design import eigenvalues as newton_eigenvalues
from .section5a_design import stable as newton_stable
from .section6_simulation import NUMBERS, START


def instruments() -> Iterator[Instrument]:
    """Sections IV to VI."""
    yield _eigenvalues()
    yield _vehicle()


def _eigenvalues() -> Instrument:
    sliders = (
        Slider(alpha, "0.1", 20, 5, logarithmic=True), Slider(omega_0, "0.1", 5, 1), Slider(H, "0.01", 3, "0.9"),
    )  # fmt: skip

    def both(claimed: Claim, seeker: str) -> list[Quantity]:
        return [
            Quantity(f"λ{sign} of the {seeker}", taken(claimed, sliders, assumed=True, part=part), unit="1/s")
            for part, sign in ((1, "₁"), (2, "₂"))
        ]

    return Instrument(
        "eigenvalues", "How fast: the eigenvalues of both averages",
        "Where they are real. Those of the Newton seeker do not move with $H$; those of the gradient seeker do.",
        sliders,
        (
            *both(newton_eigenvalues, "Newton seeker"), *both(gradient_eigenvalues, "gradient seeker"),
            Region("Where those of the Newton seeker are real, and negative", omega_0, alpha,
                   (taken(newton_stable, sliders),)),
            Region("Where those of the gradient seeker are", omega_0, alpha, (taken(gradient_stable, sliders),)),
        ),
    )  # fmt: skip


def _vehicle() -> Instrument:
    end = sp.Symbol("t_end", positive=True)
    fixed = {letter: START[letter] for letter in (F_star, *source)}
    gains = {c: omega ** (1 - p), alpha_t: alpha * omega**p}
    loop = chain.newton.with_values(gains).with_values(fixed)
    average = chain.newton_averaged.with_values(fixed)
    start = sp.Matrix([START[x1] - START[source[0]], START[x2] - START[source[1]]])
    turned = Y(sp.S.Zero).T * start
    values = {x1: START[x1], x2: START[x2], d: START[d], nu: START[nu], z1: turned[0], z2: turned[1]}
    back = sp.Matrix([fixed[entry] for entry in source]) + Y(omega_0 * t) * sp.Matrix([z1, z2])
    sliders = (
        Slider(h, "0.4", 5, 1, logarithmic=True), Slider(alpha, "0.5", 4, NUMBERS[alpha]),
        Slider(omega, 5, 40, NUMBERS[omega]), Slider(omega_0, "0.2", 3, NUMBERS[omega_0]),
        Slider(omega_d, "0.05", "0.6", NUMBERS[omega_d]), Slider(p, "0.51", "0.95", NUMBERS[p]),
        Slider(H, "0.005", "0.05", NUMBERS[H], logarithmic=True),
        Slider(end, 5, 60, 40, glyph="t", unit="s", meaning="end of the run"),
    )  # fmt: skip
    return Instrument(
        "newton", "The Newton seeker beside its average",
        "The closed loop of Section VI from its start, with the rate h of the filter that the text does not give, and "
        "its average, turned back from the rotating frame. Where the filter is slow, or H small, d may escape.",
        sliders,
        (
            Vehicle(
                "Vehicle and average", loop, average, values, (sp.S.Zero, end), t, (fixed[source[0]], fixed[source[1]]),
                F_x.subs(fixed), (average_newton,), places=((x1, x2), (back[0], back[1])),
            ),
        ),
    )  # fmt: skip
