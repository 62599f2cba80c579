"""Section II: the second-order Lie bracket system, its coefficients, and the hypotheses of its theorem."""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import average, with_powers
from ptproof.proof import Evidence, Goal, Prose, claim, definition, eq, every, exact, integrals, refute
from ptproof.system import DitherSystem, jacobian, lie_bracket

from .chain import phase
from .notation import HALF, letter, omega, rate_of, t, x1, x2

SECTION = "II Preliminaries: second-order Lie bracket approximations"

s = letter("s", "s", "s", "time, bound")
s_p = letter("p_s", "p", "s", "time of the innermost integral, bound")
tau = letter("tau", r"\tau", "s", "time of the outermost integral, bound")
PERIOD = 2 * sp.pi / omega


def double(u_j: sp.Expr, u_i: sp.Expr, period: sp.Expr = PERIOD) -> sp.Expr:
    """∫₀^T ∫₀^s u_j(ωs) u_i(ωp) dp ds, for dithers of the phase."""
    inside = u_j.subs(phase, omega * s) * u_i.subs(phase, omega * s_p)
    return sp.Integral(inside, (s_p, 0, s), (s, 0, period))


def antisymmetric(u_i: sp.Expr, u_j: sp.Expr) -> sp.Expr:
    """u_j(ωs) u_i(ωp) − u_i(ωs) u_j(ωp)."""
    at_s, at_p = {phase: omega * s}, {phase: omega * s_p}
    return u_j.subs(at_s) * u_i.subs(at_p) - u_i.subs(at_s) * u_j.subs(at_p)


def triple(u_i: sp.Expr, u_j: sp.Expr, u_m: sp.Expr) -> sp.Expr:
    """∫₀^T ∫₀^τ ∫₀^s u_m(ωτ) (u_j(ωs) u_i(ωp) − u_i(ωs) u_j(ωp)) dp ds dτ, with the limits of the Appendix."""
    inside = u_m.subs(phase, omega * tau) * antisymmetric(u_i, u_j)
    return sp.Integral(inside, (s_p, 0, s), (s, 0, tau), (tau, 0, PERIOD))


# --- The bracket -----------------------------------------------------------------------------------------------------

_x = sp.symbols("x_1:3", real=True)
_f = [sp.Function(f"f_{i}", real=True)(*_x) for i in (1, 2)]
_g = [sp.Function(f"g_{i}", real=True)(*_x) for i in (1, 2)]


@claim(
    "newton/2-bracket", "The Lie bracket [f, g] = (∂g/∂x) f − (∂f/∂x) g",
    eq(
        sp.Matrix([sum(sp.diff(_g[i], _x[j]) * _f[j] - sp.diff(_f[i], _x[j]) * _g[j] for j in (0, 1)) for i in (0, 1)]),
        sp.Matrix(lie_bracket(_f, _g, _x)),
    ),
    place="Notation",
)  # fmt: skip
def bracket(goal: Goal) -> Evidence:
    """The sign that the notation gives is the one with which brackets are formed here."""
    return exact(goal)


# --- The general system and what is assumed of it --------------------------------------------------------------------

_k, _p = sp.symbols("k_1:3", positive=True), sp.symbols("p_1:3", positive=True)


def _fields(at: tuple[sp.Symbol, ...]) -> list[sp.Matrix]:
    """f₀, f₁ and f₂ of two states."""
    return [sp.Matrix([sp.Function(f"f{i}{row}", real=True)(*at) for row in (1, 2)]) for i in range(3)]


def _dithers(of: sp.Expr, at: sp.Symbol) -> sp.Expr:
    return sp.Function(f"u_{of}", real=True)(sp.Symbol(f"k_{of}", positive=True) * omega * at)


_f0, *_driven = _fields((x1, x2))
general_system = definition(
    "newton/2-general-system", "A system with powers of the frequency",
    eq(sp.Matrix([rate_of("x1"), rate_of("x2")]),
       sum((_driven[i - 1] * omega ** _p[i - 1] * _dithers(i, t) for i in (1, 2)), _f0)),
    labels=["eq:general_nominal_system"],
    prose="Its control inputs are the dithers; k_i are rational and positive, p_i between 0 and 1. Written for two "
    "states and l = 2.",
)  # fmt: skip
assumption_1 = definition(
    "newton/2-assumption-1", "Assumption 1",
    Prose("The fields are C³; the dithers are measurable, at most 1 in absolute value, 2π-periodic, of mean zero"),
    labels=["ass:second_order_ass1"], prose="That the seekers' dithers are so is claimed with the Propositions.",
)  # fmt: skip
assumption_2 = definition(
    "newton/2-assumption-2", "Assumption 2",
    Prose("For p_i + p_j > 1 the bracket or its double integral vanishes; for p_i + p_j + p_m > 2 the bracket of three "
          "or its triple integral does; for four powers that add up to 3 or more the third derivative of f_i along "
          "f_j, f_m, f_q vanishes"),
    labels=["ass:second_order_ass2"], prose="What it says of the two seekers is claimed with the Propositions.",
)  # fmt: skip
practical_stability = definition(
    "newton/2-sgpuas", "Semi-globally practically uniformly asymptotically stable",
    Prose("Bounded, stable and practically convergent from every bounded neighbourhood, for small enough parameters, "
          "each chosen after the one before it"),
    labels=["def:sGPUAS"], prose="sGPUAS is taken from the literature as it stands.",
)  # fmt: skip

# --- The average and its coefficients, as they are printed ------------------------------------------------------------

_T, _i, _j, _m = sp.Symbol("T", positive=True), *(sp.Symbol(f"p_{n}", positive=True) for n in "ijm")
_zero, *_ones = _fields(_averaged := sp.symbols("xbar1:3", real=True))
_bracket_12 = lie_bracket(list(_ones[0]), list(_ones[1]), _averaged)


def _gamma_of(name: str) -> sp.Expr:
    return sp.Function(f"gamma_{name}", real=True)(omega)


_seconds = [lie_bracket(_bracket_12, list(field), _averaged) for field in _ones]
average_printed = definition(
    "newton/2-average", "The second-order Lie bracket system",
    eq(sp.Matrix([rate_of("xbar1"), rate_of("xbar2")]), sp.Matrix([
        _zero[row] + sp.Limit(_bracket_12[row] * _gamma_of("12"), omega, sp.oo)
        + sp.Limit(sum(_seconds[m][row] * _gamma_of(f"12{m + 1}") for m in (0, 1)), omega, sp.oo)
        for row in (0, 1)
    ])),
    labels=["eq:second_order_LBS_general"], prose="Written here for two states and l = 2.",
)  # fmt: skip
coefficients_printed = definition(
    "newton/2-coefficients", "γ_ij(ω) and γ_ijm(ω) as printed",
    every(
        eq(_gamma_of("ij"), omega ** (_i + _j) / _T
           * sp.Integral(_dithers("j", s) * _dithers("i", s_p), (s_p, 0, s), (s, 0, _T))),
        eq(_gamma_of("ijm"), omega ** (_i + _j + _m) / _T * sp.Integral(
            _dithers("m", tau) * sp.Integral(
                _dithers("j", s) * _dithers("i", s_p) - _dithers("i", s) * _dithers("j", s_p), (s_p, 0, _T)
            ),
            (s, 0, s), (tau, 0, tau),
        )),
    ),
    labels=[], prose="With the factor and the limits as they stand; both are the subject of claims.",
)  # fmt: skip

# --- The coefficients: of f₁ = 1 and f₂ = f(x), with cos and cos 2, both with the power 2/3 ---------------------------

_cos, _cos2 = sp.cos(phase), sp.cos(2 * phase)
_state = (sp.Symbol("x", real=True),)
_field = sp.Function("f", real=True)(*_state)
_pair = DitherSystem(t, phase, omega, _state, (0,), ((1,), (_field,)), (_cos, _cos2))
_average = average(with_powers(_pair, [sp.Rational(2, 3)] * 2))
_gamma = sp.Symbol("gamma_121", real=True)
_first = lie_bracket((1,), (_field,), _state)
_second = lie_bracket(_first, (1,), _state)[0]
PRINTED_FACTOR, USED_FACTOR = omega**2 * omega / (2 * sp.pi), omega**2 * omega / (6 * sp.pi)


@claim(
    "newton/2-coefficients-of-two-cosines", "The integrals of cos and cos 2",
    every(
        eq(PRINTED_FACTOR * triple(_cos, _cos2, _cos), sp.Rational(3, 8)),
        eq(USED_FACTOR * triple(_cos, _cos2, _cos), sp.Rational(1, 8)),
        eq(double(_cos2, _cos), 0), eq(triple(_cos, _cos2, _cos2), 0),
    ),
    place="Section II",
)  # fmt: skip
def two_cosines(goal: Goal) -> Evidence:
    """With powers that add up to 2 the first is γ₁₂₁ as it is defined, with 1/T, the second with 1/(3T). The limits of
    the three integrals are those of the Appendix."""
    return integrals(goal)


@claim(
    "newton/2-gamma-ijm-printed", "The average of two arbitrary fields by γ_ijm with the factor 1/T, as defined",
    eq(_gamma * _second, _average.rhs[0]), given=[eq(_gamma, sp.Rational(3, 8))], place="Section II, γ_ijm",
    labels=["eq:second_order_LBS_general"], uses=[two_cosines], expected="refuted", grade="definition",
    wrong="γ_ijm is defined with the factor 1/T where 1/(3T) is needed.",
    survives="Yes: the Appendix uses 1/(3T), which gives the averages that are printed.",
)  # fmt: skip
def gamma_ijm_printed(goal: Goal) -> Evidence:
    """For cos ωt with the field 1 and cos 2ωt with the field f(x), both with ω^(2/3), the average is −f''/8. With 1/T
    the bracket [[f₁, f₂], f₁] = −f'' gets the coefficient 3/8."""
    return refute(goal, {_field: _state[0] ** 2, _state[0]: 0, _gamma: sp.Rational(3, 8)})


@claim(
    "newton/2-gamma-ijm", "The average of two arbitrary fields by γ_ijm with the factor 1/(3T)",
    eq(_gamma * _second, _average.rhs[0]), given=[eq(_gamma, sp.Rational(1, 8))],
    labels=["eq:second_order_LBS_general"], uses=[two_cosines], corrects=gamma_ijm_printed,
)  # fmt: skip
def gamma_ijm(goal: Goal) -> Evidence:
    """1/8 is what the derived average has."""
    return exact(goal)


_outer, _middle = sp.symbols("tau_end s_end", real=True)
_as_displayed = sp.Integral(
    _cos.subs(phase, omega * tau) * antisymmetric(_cos, _cos2), (s_p, 0, PERIOD), (s, 0, _middle), (tau, 0, _outer)
)


@claim(
    "newton/2-limits-printed", "The limits of the integrals of γ_ijm in the order in which they are printed",
    eq(_as_displayed, triple(_cos, _cos2, _cos)), place="Section II, γ_ijm", uses=[two_cosines],
    expected="refuted", grade="misprint",
    wrong="The three integrals of γ_ijm stand in a wrong order: T belongs to the outermost, s to the innermost.",
    survives="Yes: the Appendix has them in the right order.",
)  # fmt: skip
def limits_printed(goal: Goal) -> Evidence:
    """The signs of integration are ∫₀^τ ∫₀^s … ∫₀^T, the differentials dp ds dτ: the innermost would run over a
    whole period, and τ and s be left over. With these at 0 the integral is 0, while the one of the Appendix is not."""
    return refute(goal, {_outer: 0, _middle: 0, omega: 1})


@claim(
    "newton/2-limits", "The triple integral with the limits of the Appendix",
    eq(triple(_cos, _cos2, _cos), sp.pi / (4 * omega**3) * 3), place="Section II, γ_ijm", corrects=limits_printed,
)  # fmt: skip
def limits_of_integrals(goal: Goal) -> Evidence:
    """The innermost up to s, the next up to τ, the outermost over a period."""
    return integrals(goal)


# --- The condition on three fields -----------------------------------------------------------------------------------

_over_pair = sp.Integral(antisymmetric(_cos, _cos2), (s_p, 0, s), (s, 0, PERIOD))
_condition = sp.Integral(_cos.subs(phase, omega * tau) * _over_pair, (tau, 0, PERIOD))


@claim(
    "newton/2-condition-printed", "The integral in Assumption 2's condition on three fields is that of γ_ijm",
    eq(_condition, triple(_cos, _cos2, _cos)), labels=["ass:second_order_ass2"], uses=[limits_of_integrals],
    expected="refuted", grade="misprint",
    wrong="In the condition on three fields the middle integral runs to T_ij where it should run to τ.",
    survives="Yes: with the limit τ the seekers still satisfy the condition.",
)  # fmt: skip
def condition_printed(goal: Goal) -> Evidence:
    """Up to T_ij the two inner integrals do not depend on τ. What is left is the mean of u_m, which is zero, so that
    the printed condition holds always and says nothing."""
    return refute(goal, {omega: 1})


@claim(
    "newton/2-condition-is-empty", "As printed, the integral in the condition on three fields is zero",
    eq(_condition, 0), labels=["ass:second_order_ass2"],
)  # fmt: skip
def condition_is_empty(goal: Goal) -> Evidence:
    """Here for cos and cos 2, with i = m = 1 and j = 2."""
    return integrals(goal)


@claim(
    "newton/2-condition", "With the limit τ, the condition on three fields asks for the integral of γ_ijm",
    eq(
        sp.Integral(
            _cos.subs(phase, omega * tau) * sp.Integral(antisymmetric(_cos, _cos2), (s_p, 0, s), (s, 0, tau)),
            (tau, 0, PERIOD),
        ),
        sp.pi / (4 * omega**3) * 3,
    ),
    labels=["ass:second_order_ass2"], uses=[limits_of_integrals], corrects=condition_printed,
)  # fmt: skip
def condition(goal: Goal) -> Evidence:
    """The same value as in newton/2-limits."""
    return integrals(goal)


# --- The third derivative in Assumption 2, for the Propositions -------------------------------------------------------


def along(fields: list[tuple[sp.Expr, ...]], state: tuple[sp.Symbol, ...]) -> sp.Matrix:
    """∂/∂x(∂/∂x(∂f_i/∂x f_j) f_m) f_q for the four fields i, j, m, q."""
    value = sp.Matrix(fields[0])
    for field in fields[1:]:
        value = sp.Matrix(jacobian(list(value), state)) * sp.Matrix(field)
    return value


__all__ = ["HALF", "SECTION", "along", "antisymmetric", "double", "triple"]
