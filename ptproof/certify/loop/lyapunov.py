"""A function that decreases along the vehicle: V of the circle's centre, corrected order by order.

Nothing here has to be right: W and ρ are looked for in floats, and whatever they are, what is proved is proved of the
derivative of exactly this W (:meth:`Flow.derivative`). A wrong coefficient costs the certificate, not its truth.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from flint import acb

from ptproof.certify.loop.flow import Flow
from ptproof.certify.loop.jets import REST
from ptproof.certify.loop.polynomials import ZERO, Key, Polynomial, real, scaled, selected, term, total

_NOISE = 1e-13


@dataclass(frozen=True)
class Lyapunov:
    """W and its rate dW/dτ."""

    flow: Flow
    function: Polynomial
    rate: Polynomial

    @staticmethod
    def of(flow: Flow, function: Polynomial) -> Lyapunov:
        """From any W, by exact differentiation along the flow."""
        return Lyapunov(flow, function, scaled(acb(1), flow.derivative(function), grade=-2))


def lyapunov(flow: Flow, start: Polynomial, order: int, manifold_order: int, weight: float) -> Lyapunov:
    """``start`` V, corrected to ``order``, with q measured from the slow manifold to ``manifold_order``.

    At the grade j the manifold solves m ∂ρ_j/∂s + ρ_j = what is left of m dq/dσ at q = 0, and W_j solves
    L₀W_j = −(R_j − its mean over s at q = 0), L₀ = ∂_s − (q/m)∂_q, which is diagonal in the terms exp(ins) q^p.
    ``weight`` is the λ of (λ/2)q².
    """
    flow = replace(flow, manifold=ZERO)
    m = float(flow.m)
    for grade in range(manifold_order + 1):
        left = selected(flow.deviation, _plain(grade, lambda key: key[2] == 0))
        step = {key: complex(value) * m / (1 + 1j * key[1] * m) for key, value in left.items()}
        flow = replace(flow, manifold=total(flow.manifold, _exact(step)))
    corrected = start
    for grade in range(1, order + 1):
        left = selected(flow.derivative(corrected), _plain(grade, lambda key: bool(key[1] or key[2])))
        step = {key: -complex(value) / (1j * key[1] - key[2] / m) for key, value in left.items()}
        corrected = total(corrected, _exact(step))
    return Lyapunov.of(flow, total(corrected, term(acb(weight) / 2, power=2)))


def _plain(grade: int, keep: Callable[[Key], bool]) -> Callable[[Key], bool]:
    """Of this grade, kept, with letters that W may have: no rests, and nothing that jumps where the gain is clipped."""
    return lambda key: (
        key[0] == grade and keep(key) and not any(letter.late or letter.name.startswith(REST) for letter in key[3])
    )


def _exact(part: Polynomial) -> Polynomial:
    """The terms that are more than rounding, as exact balls."""
    kept = {key: value for key, value in part.items() if abs(value) > _NOISE}
    return {key: acb(value) for key, value in real(kept).items()}
