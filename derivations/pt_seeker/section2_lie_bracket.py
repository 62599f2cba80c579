"""Section 2.1: the Lie bracket system: its coefficients, its pairs of dithers, and what its bracket is formed of."""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import average
from ptproof.proof import Evidence, Goal, claim, eq, every, exact, integrals, refute
from ptproof.system import DitherSystem, lie_bracket

from .notation import T, omega, tau, x1, x2, z
from .section2_averaging import b, l, phase, position

SECTION = "2 Preliminaries: the Lie bracket system"

_s, _theta = sp.symbols("s vartheta", real=True)
HALF, QUARTER = sp.Rational(1, 2), sp.Rational(1, 4)


def iterated_integral(outer: sp.Expr, inner: sp.Expr, period: sp.Expr = 2 * sp.pi) -> sp.Expr:
    """v_ji = (1/T_f) ∫₀^{T_f} u_j(θ) ∫₀^θ u_i(s) ds dθ, unevaluated, for dithers given in the phase."""
    inside = sp.Integral(inner.subs(phase, _s), (_s, 0, _theta))
    return sp.Integral(outer.subs(phase, _theta) * inside, (_theta, 0, period)) / period


# --- The coefficients v_ji ------------------------------------------------------------------------------------------


@claim(
    "2.1/iterated-integrals", "v_ji of the dithers cos and sin",
    every(
        eq(iterated_integral(sp.sin(phase), sp.cos(phase)), HALF),
        eq(iterated_integral(sp.cos(phase), sp.sin(phase)), -HALF),
        eq(iterated_integral(sp.cos(phase), sp.cos(phase)), 0),
        eq(iterated_integral(sp.sin(phase), sp.sin(phase)), 0),
    ),
    place="Section 2.1",
)  # fmt: skip
def iterated_integrals(goal: Goal) -> Evidence:
    """v₂₁ = 1/2 is the constant that multiplies the bracket; v₁₂ = −v₂₁ and v_ii = 0 because the means vanish."""
    return integrals(goal)


@claim(
    "2.1/iterated-integral-printed", "v₂₁ = 1/2 with the letter T of the prescribed time, as printed",
    eq(iterated_integral(sp.sin(phase), sp.cos(phase), T), HALF), place="Section 2.1",
    labels=["eq:Lie_Bracket_System"], expected="refuted", grade="misprint",
    wrong="The period in v_ji is written T, the prescribed time, where the period T_f of the dithers is meant.",
    survives="Yes: Section 5 uses v₂₁ = 1/2, the value over a period.",
)  # fmt: skip
def iterated_integral_printed(goal: Goal) -> Evidence:
    """The formula for v_ji integrates over [0, T] and divides by T. Assumption 1D calls the period of the dithers T_f;
    T is the prescribed time everywhere else. With that T the dithers cos and sin give 1/2 − sin(2T)/(4T), which is
    1/2 − 1/π at T = π/4, and not the 1/2 of the averaged system."""
    return refute(goal, {T: sp.pi / 4})


period = sp.Symbol("T_f", positive=True)
frequency = 2 * sp.pi / period


@claim(
    "2.1/iterated-integral", "v₂₁ over one period T_f",
    eq(iterated_integral(sp.sin(frequency * phase), sp.cos(frequency * phase), period), period / (4 * sp.pi)),
    place="Section 2.1", labels=["eq:Lie_Bracket_System"], corrects=iterated_integral_printed,
)  # fmt: skip
def iterated_integral_period(goal: Goal) -> Evidence:
    """For cosine and sine of any period T_f the coefficient is T_f/(4π); the period 2π of the seeker's dithers
    gives 1/2."""
    return integrals(goal)


# --- The Lie bracket system of arbitrary fields of (τ, x) -----------------------------------------------------------

_fields = tuple(tuple(sp.Function(f"b{i}{j}", real=True)(tau, x1, x2) for j in (1, 2)) for i in range(5))


def _bracket(i: int, j: int) -> sp.Matrix:
    """[bᵢ, bⱼ] of the arbitrary fields."""
    return sp.Matrix(lie_bracket(_fields[i], _fields[j], position))


v21 = sp.Symbol("v_21", real=True)
coefficient_is_half = [eq(v21, HALF)]
_two = average(DitherSystem(tau, phase, omega, position, _fields[0], _fields[1:3], (sp.cos(phase), sp.sin(phase))))


@claim(
    "2.1/lie-bracket-system", "The Lie bracket system of two arbitrary fields under cosine and sine",
    eq(sp.Matrix(_fields[0]) + _bracket(1, 2) * v21, _two.vector), given=coefficient_is_half,
    labels=["eq:Lie_Bracket_System"], uses=[iterated_integrals],
)  # fmt: skip
def lie_bracket_system(goal: Goal) -> Evidence:
    """b₀ + [b₁, b₂] v₂₁, the printed sum for N = 2, against the averaging engine at two arbitrary smooth fields."""
    return exact(goal)


_amplitude = 2 + sp.cos(tau)
_slowly = (_amplitude * sp.cos(phase), _amplitude * sp.sin(phase))
_varying = average(DitherSystem(tau, phase, omega, position, _fields[0], _fields[1:3], _slowly))


@claim(
    "2.1/slowly-varying-dithers", "For dithers with the slowly varying amplitude 2 + cos τ, v₂₁ depends on τ",
    eq(sp.Matrix(_fields[0]) + _bracket(1, 2) * _amplitude**2 * v21, _varying.vector), given=coefficient_is_half,
    place="Section 2.1", uses=[iterated_integrals],
)  # fmt: skip
def slowly_varying_dithers(goal: Goal) -> Evidence:
    """The dithers of the general system are u(τ, θ), while v_ji is written with u(θ). For a(τ) cos θ and a(τ) sin θ it
    is a(τ)²/2, at each τ the integral over the phase alone. The seeker's dithers depend on the phase alone."""
    return exact(goal)


# dx₁ = √ω cos(ωτ) dτ, dx₂ = √ω x₁ sin(ωτ) dτ from x₁(0) = 0: b₁ = (1, 0) and b₂ = (0, x₁).
_solution = sp.sin(omega * tau) / sp.sqrt(omega)
_turn = 2 * sp.pi / omega


@claim(
    "2.1/sign-of-the-bracket", "The sign of the bracket and the order of v_ji, on a system that is solved",
    every(
        eq(sp.Derivative(_solution, tau), sp.sqrt(omega) * sp.cos(omega * tau)),
        eq(
            sp.Integral(sp.sqrt(omega) * sp.sin(omega * tau) * _solution, (tau, 0, _turn)) / _turn,
            lie_bracket((1, 0), (0, x1), position)[1] * HALF,
        ),
    ),
    place="Section 2.1", uses=[iterated_integrals],
)  # fmt: skip
def sign_of_the_bracket(goal: Goal) -> Evidence:
    """For b₁ = (1, 0) and b₂ = (0, x₁) under cosine and sine, x₁ oscillates and x₂ grows at the mean rate 1/2 for every
    ω. That is [b₁, b₂]v₂₁ with [b₁, b₂] = (∂b₂/∂x)b₁ − (∂b₁/∂x)b₂ and the inner integral over u₁; with the opposite
    sign of either it would be −1/2."""
    return integrals(goal)


# --- The sum over pairs ---------------------------------------------------------------------------------------------

# In this order no neighbours have a coefficient.
_dithers = (sp.cos(phase), sp.cos(2 * phase), sp.sin(phase), sp.sin(2 * phase))
_values = {(1, 2): 0, (1, 3): HALF, (1, 4): 0, (2, 3): 0, (2, 4): QUARTER, (3, 4): 0}
_v = {(i, j): sp.Symbol(f"v_{j}{i}", real=True) for i, j in _values}
_given = [eq(_v[pair], value) for pair, value in _values.items()]
_four = average(DitherSystem(tau, phase, omega, position, _fields[0], _fields[1:], _dithers))


def _sum_over(*pairs: tuple[int, int]) -> sp.Matrix:
    """b₀ + Σ [bᵢ, bⱼ] v_ji over these pairs (i, j)."""
    return sum((_bracket(i, j) * _v[i, j] for i, j in pairs), sp.Matrix(_fields[0]))


@claim(
    "2.1/iterated-integrals-of-four", "v_ji of four dithers at two frequencies",
    every(*(eq(iterated_integral(_dithers[j - 1], _dithers[i - 1]), value) for (i, j), value in _values.items())),
    place="Section 2.1", labels=["eq:Lie_Bracket_System"],
)  # fmt: skip
def four_integrals(goal: Goal) -> Evidence:
    """Of cos φ, cos 2φ, sin φ, sin 2φ only the first and third, and the second and fourth, have a coefficient: 1/2
    and 1/4. No two neighbours have one."""
    return integrals(goal)


@claim(
    "2.1/sum-over-neighbours-printed", "The sum over i = 1, …, N and j = i + 1, as printed, for four dithers",
    eq(_sum_over((1, 2), (2, 3), (3, 4)), _four.vector), given=_given,
    labels=["eq:Lie_Bracket_System"], uses=[four_integrals],
    expected="refuted", grade="misprint",
    wrong="The sum is written over i with j = i + 1 only; a sum over all pairs i < j is meant.",
    survives="Yes: the seeker has two dithers, and the only pair is (1, 2).",
)  # fmt: skip
def sum_over_neighbours_printed(goal: Goal) -> Evidence:
    """Taken as it is written, the sum has the pairs (1, 2), (2, 3), (3, 4), and at i = N even a pair with a field that
    does not exist. With the four dithers in this order each of the three coefficients is 0, so that nothing but b₀ is
    left, while [b₁, b₃]/2 + [b₂, b₄]/4 belongs into the average."""
    fields = {entry: sp.S.Zero for field in _fields for entry in field}
    fields |= {_fields[1][0]: sp.S.One, _fields[3][1]: x1}
    return refute(goal, {**fields, **{_v[pair]: value for pair, value in _values.items()}, tau: 0, x1: 0, x2: 0})


@claim(
    "2.1/lie-bracket-system-of-four", "The Lie bracket system of four arbitrary fields",
    eq(_sum_over(*_v), _four.vector), given=_given, labels=["eq:Lie_Bracket_System"], uses=[four_integrals],
    corrects=sum_over_neighbours_printed,
)  # fmt: skip
def lie_bracket_system_of_four(goal: Goal) -> Evidence:
    """The sum over all pairs i < j: here six of them, four with the coefficient 0."""
    return exact(goal)


# --- The bracket at l(x) ----------------------------------------------------------------------------------------------

_composed = tuple(tuple(entry.subs(z, l) for entry in field) for field in b)
_of_reduced = average(
    DitherSystem(tau, phase, omega, position, _composed[0], _composed[1:], (sp.cos(phase), sp.sin(phase)))
)
_held = sp.Matrix([sp.Subs(entry, z, l) for entry in lie_bracket(b[1], b[2], position)])  # formed in x, then z = l(x)


@claim(
    "2.1/bracket-at-quasi-steady-state-printed",
    "The bracket of the fields of (τ, x, z), at z = l(x), gives the average",
    eq(sp.Matrix(_composed[0]) + _held * v21, _of_reduced.vector), given=coefficient_is_half,
    labels=["eq:Lie_Bracket_System"],
    expected="refuted", grade="definition",
    wrong="[b_i, b_j](τ, x, l(x)) reads as a bracket formed in x with z held, as in Assumption 1B, and then taken at "
    "z = l(x); the bracket of the composed fields b_i(τ, x, l(x)) is meant.",
    survives="Yes: Section 5 forms the bracket of the composed fields.",
)  # fmt: skip
def bracket_at_quasi_steady_state_printed(goal: Goal) -> Evidence:
    """Assumption 1B differentiates [b_j, b_k](τ, x, z) by x and by z, so that the bracket there is one in x with z
    held. The Lie bracket system takes it at z = l(x). For b₁ = (1, 0), b₂ = (0, z) and l = x₁ that is 0, while the
    reduced model has the fields (1, 0) and (0, x₁), and drifts."""
    fields = {entry: sp.S.Zero for field in b for entry in field}
    return refute(goal, {**fields, b[1][0]: sp.S.One, b[2][1]: z, l: x1, v21: HALF, tau: 0, x1: 0, x2: 0})


@claim(
    "2.1/bracket-of-composed-fields", "The average of the reduced model has the bracket of the composed fields",
    eq(
        sp.Matrix(_composed[0]) + sp.Matrix(lie_bracket(_composed[1], _composed[2], position)) * v21,
        _of_reduced.vector,
    ),
    given=coefficient_is_half, labels=["eq:Lie_Bracket_System"], uses=[iterated_integrals],
    corrects=bracket_at_quasi_steady_state_printed,
)  # fmt: skip
def bracket_of_composed_fields(goal: Goal) -> Evidence:
    """z = l(x) is put in first, then the bracket is formed: Lie bracket averaging is applied to the reduced model."""
    return exact(goal)
