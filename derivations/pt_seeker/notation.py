"""The paper's letters: each symbol once, with its glyph, what is known of it, its unit and its meaning."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import ge, lt
from ptproof.report.alphabet import Alphabet

alphabet = Alphabet()
letter = alphabet.letter
NOTATION = alphabet.entries

# Times. All are real, never positive: one-sided limits go wrong with positive times.
t = letter("t", "t", "s", "time")
t0 = letter("t0", "t_0", "s", "initial time")
tau = letter("tau", r"\tau", "s", "dilated time")
tau_fast = letter("tau_f", r"\tilde\tau", "1", "fast time, τ/μ")
T = letter("T", "T", "s", "prescribed time", positive=True)

# The unicycle and its feedback.
x1 = letter("x1", "x_1", "m", "first coordinate of the vehicle")
x2 = letter("x2", "x_2", "m", "second coordinate of the vehicle")
theta = letter("theta", r"\theta", "rad", "heading")
z = letter("z", "z", "[F]", "state of the washout filter")
u2 = letter("u2", "u_2", "rad/s", "angular velocity as a state")
p = letter("p", "p", "rad", "θ + kz")
y_tilde = letter("y_tilde", r"\tilde y", "[F]", "deviation of z from the quasi-steady state")
k = letter("k", "k", "1/[F]", "gain of the feedback", positive=True)
omega = letter("omega", r"\omega", "1/s", "dither frequency", positive=True)
mu = letter("mu", r"\mu", "s", "time constant of the washout filter", positive=True)
m = letter("m", "m", "1", "the product μω where it is held fixed", positive=True)
epsilon = letter("epsilon", r"\epsilon", "s", "time constant of the angular acceleration", positive=True)
S = letter("S", "S", "rad", "saturation level", positive=True)
C = letter("C", "C", "1", "gain C(t) of the saturated seeker at one instant", positive=True)

# The field, its source and the drift.
xs1 = letter("xs1", "x^*_1", "m", "first coordinate of the source")
xs2 = letter("xs2", "x^*_2", "m", "second coordinate of the source")
F_source = letter("F_s", "F(x^*)", "[F]", "field at the source")
kappa = letter("kappa", r"\kappa", "1", "order of the field's bounds", positive=True, integer=True)
a1 = letter("a1", "a_1", "[F]/m^{2κ}", "upper constant of the field", positive=True)
a2 = letter("a2", "a_2", "[F]/m^{2κ}", "lower constant of the field", positive=True)
b1 = letter("b1", "b_1", "[F]/m^{2κ}", "lower constant of the gradient", positive=True)
b2 = letter("b2", "b_2", "[F]/m^{2κ}", "upper constant of the gradient", positive=True)
E11, E12, E21, E22 = (
    letter(f"E{i}{j}", f"E_{{{i}{j}}}", "m²/([F] s)", "entry of the drift matrix") for i in (1, 2) for j in (1, 2)
)
E_norm = letter("E_norm", r"\|E\|", "m²/([F] s)", "spectral norm of the drift matrix", nonnegative=True)

# Lyapunov analysis; one symbol for each norm or value at one instant.
V = letter("V", "V", "[F]", "F(x*) − F(x̄)", positive=True)
V0 = letter("V0", "V(x_0)", "[F]", "V at the initial time", positive=True)
U = letter("U", "U", "[F]^{1/2κ}", "V^(1/2κ)", positive=True)
G = letter("G", r"\|\nabla F\|", "[F]/m", "norm of the gradient", positive=True)
R = letter("R", r"\|\bar x - x^*\|", "m", "distance of the averaged vehicle from the source", positive=True)
R0 = letter(
    "R0",
    r"\|\bar x(t_0) - x^*\|",
    "m",
    "distance of the averaged vehicle from the source at the initial time",
    positive=True,
)
f_norm = letter("f_norm", r"\|f\|", "m/s", "norm of the drift", nonnegative=True)
d = letter("d", r"\|d\|_{[t_0,\tau]}", "m/s", "largest bound of the drift up to now", nonnegative=True)
zeta = letter("zeta", r"\zeta", "[F]^{1/2κ}/s", "input of the scalar comparison system", nonnegative=True)

# Where the two times, and the fast one, run: what is claimed of them is claimed there.
IN_TIME = (ge(t, t0), lt(t, t0 + T))
IN_TAU = (ge(tau, t0),)
IN_FAST_TIME = (ge(mu * tau_fast, t0),)

E = sp.ImmutableDenseMatrix([[E11, E12], [E21, E22]])
position = (x1, x2)
source = (xs1, xs2)

F = sp.Function("F", real=True)(x1, x2)
f = (sp.Function("f1", real=True)(t, x1, x2), sp.Function("f2", real=True)(t, x1, x2))


def drift_at(time: sp.Expr, where: tuple[sp.Expr, sp.Expr] = position) -> tuple[sp.Expr, sp.Expr]:
    """f at an instant of the original time t and a position."""
    first, second = (component.subs(t, time) for component in f)
    if where == position:
        return first, second
    moved = dict(zip(position, where, strict=True))
    return first.subs(moved, simultaneous=True), second.subs(moved, simultaneous=True)


def rate_of(name: str, time: sp.Symbol) -> sp.Expr:
    """The derivative of a signal, for the left side of a displayed system."""
    return sp.Derivative(sp.Function(name)(time), time)


def nu(elapsed: sp.Expr) -> sp.Expr:
    """ν as printed in eq:nu, a function of the elapsed time t − t₀."""
    return 1 - elapsed / T


def q(order: sp.Expr = kappa) -> sp.Expr:
    """q_κ = (2κ − 1)/(2κ)."""
    return (2 * order - 1) / (2 * order)


def c(index: int, order: sp.Expr = kappa) -> sp.Expr:
    """c_κ,i = b_i / a_i^(q_κ)."""
    b, a = ((b1, a1), (b2, a2))[index - 1]
    return b / a ** q(order)


sigma = 2 * q() - 1  # σ_κ of Section 6.2
r = 2 * kappa - 1  # the exponent r of the Proposition's proof
h1 = k * c(1) ** 2 / (4 * kappa)
h2 = c(2) / (2 * kappa)

# How SymPy's printer writes the letters, for the report.
GLYPHS = alphabet.glyphs
