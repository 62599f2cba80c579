"""The pipeline: from the plant and the two laws to the averaged systems, every stage computed from the one before.

Nothing here is transcribed from the paper but the unicycle, the field and the laws.
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from ptproof.averaging import average, derive_powered, with_powers
from ptproof.averaging.powers import PoweredSystem
from ptproof.system import DitherSystem, System
from ptproof.transforms import change_variable, change_variables, solve_state

from .notation import (
    F_x,
    F_z,
    H,
    Y,
    alpha,
    alpha_t,
    c,
    d,
    d_h,
    d_plus,
    d_t,
    h,
    nu,
    omega,
    omega_0,
    omega_d,
    p,
    r,
    rotated,
    source,
    t,
    t_0,
    theta,
    theta_0,
    x1,
    x2,
)  # fmt: skip

phase = sp.Symbol("phi", real=True)
DITHERS = (sp.sin(phase), sp.cos(phase), sp.cos(2 * phase))


def unicycle(u1: sp.Expr, u2: sp.Expr, filters: dict[sp.Symbol, sp.Expr], name: str) -> System:
    """The vehicle under the inputs u₁ and u₂, beside the filters."""
    rates = (u1 * sp.cos(theta), u1 * sp.sin(theta), u2, *filters.values())
    return System(t, (x1, x2, theta, *filters), rates, name=name)


def in_rotating_frame(system: System, angle: sp.Expr = omega_0 * t) -> System:
    """The closed loop in z = Yᵀ(x − x*), with sin² of the frame's angle written as 1 − cos²."""
    angle = sp.expand(angle)
    offset = sp.Matrix([x1 - source[0], x2 - source[1]])
    turned, back = Y(angle).T * offset, sp.Matrix(source) + Y(angle) * sp.Matrix(rotated)
    moved = change_variables(system, dict(zip((x1, x2), back, strict=True)), dict(zip(rotated, turned, strict=True)))

    sine, cosine = sp.sin(angle), sp.cos(angle)

    def is_even_part(node: sp.Expr) -> bool:
        return bool(node.is_Pow and node.base == sine and node.exp >= 2)

    def by_cosine(node: sp.Expr) -> sp.Expr:
        return (1 - cosine**2) ** (node.exp // 2) * sine ** (node.exp % 2)

    def reduced(entry: sp.Expr) -> sp.Expr:
        return sp.expand(sp.expand(entry).replace(is_even_part, by_cosine))

    return replace(moved, rhs=tuple(map(reduced, moved.rhs)), parameters=None)


def powered(system: System) -> PoweredSystem:
    """The closed loop with c = ω^(1 − p) and α̃ = αω^p, split into drift, fields, powers of ω and dithers."""
    waves = [wave.subs(phase, omega * t) for wave in DITHERS]
    marks = sp.symbols("mark_1:4", real=True)
    fields, powers, dithers = [], [], []
    rates = [sp.expand(entry.xreplace(dict(zip(waves, marks, strict=True)))) for entry in system.rhs]
    for mark, wave in zip(marks, DITHERS, strict=True):
        column = [entry.coeff(mark, 1).subs({c: omega ** (1 - p), alpha_t: alpha * omega**p}) for entry in rates]
        power = {sp.expand(sp.log(part).diff(omega) * omega) for part in map(_power_part, column) if part != 0}
        if power:
            (exponent,) = power
            fields.append(tuple(sp.expand(entry / omega**exponent) for entry in column))
            powers.append(exponent)
            dithers.append(wave)
    drift = tuple(entry.subs(dict.fromkeys(marks, 0)) for entry in rates)
    plain = DitherSystem(t, phase, omega, system.state, drift, tuple(fields), tuple(dithers), name=system.name)
    return with_powers(plain, powers)


def _power_part(entry: sp.Expr) -> sp.Expr:
    """The factor ω^(…) of an entry; 0 of the entry 0."""
    return sp.powsimp(sp.factor(entry)).as_independent(omega)[1] if entry != 0 else sp.S.Zero


# --- The gradient seeker ---------------------------------------------------------------------------------------------

_gradient = unicycle(
    c * (F_x - nu) * sp.sin(omega * t) + alpha_t * sp.cos(omega * t), omega_0, {nu: h * (F_x - nu)}, "gradient seeker"
)
gradient = solve_state(_gradient, theta, omega_0 * t)
gradient_in_z = in_rotating_frame(gradient)
gradient_dithered = powered(gradient_in_z)
gradient_averaged = average(gradient_dithered)

heading = theta_0 + omega_0 * (t - t_0)
gradient_from_any_heading = in_rotating_frame(solve_state(_gradient, theta, heading), heading)

# --- The Newton seeker -----------------------------------------------------------------------------------------------


_law = c * d * (F_x - nu) * sp.sin(omega * t) + alpha_t * sp.cos(omega * t)
_riccati = omega_d * d * (1 - d * 8 * omega**2 / alpha_t**2 * (F_x - nu) * sp.cos(2 * omega * t))
_newton = unicycle(_law, omega_0, {d: _riccati, nu: h * (F_x - nu)}, "Newton seeker")
newton = solve_state(_newton, theta, omega_0 * t)
newton_in_z = in_rotating_frame(newton)
newton_dithered = powered(newton_in_z)
newton_found = derive_powered(newton_dithered)
newton_averaged = newton_found.system

_where_positive = replace(
    newton_in_z, state=(*rotated, d_plus, nu), rhs=tuple(rate.subs(d, d_plus) for rate in newton_in_z.rhs)
)
logarithmic = change_variable(_where_positive, d_plus, d_t, sp.log(d_plus), sp.exp(d_t))
logarithmic_dithered = powered(logarithmic)
logarithmic_averaged = average(logarithmic_dithered)

_shifted = change_variable(logarithmic_averaged, d_t, d_h, d_t - sp.log(1 / H), d_h + sp.log(1 / H))
shifted = change_variable(_shifted, nu, r, nu - F_z, r + F_z)
