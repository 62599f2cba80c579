"""The paper's letters: each symbol once, with its glyph, what is known of it, its unit and its meaning."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import gt, lt
from ptproof.report.alphabet import Alphabet

alphabet = Alphabet()
letter = alphabet.letter
NOTATION = alphabet.entries

t = letter("t", "t", "s", "time")

# The unicycle, its inputs and the filters.
x1 = letter("x1", "x_1", "m", "first coordinate of the vehicle")
x2 = letter("x2", "x_2", "m", "second coordinate of the vehicle")
theta = letter("theta", r"\theta", "rad", "orientation")
theta_0 = letter("theta_0", r"\theta_0", "rad", "orientation at the initial time")
t_0 = letter("t_0", "t_0", "s", "initial time")
nu = letter("nu", r"\nu", "[F]", "state of the filter of the measurement")
d = letter("d", "d", "m²/[F]", "state of the Riccati filter, an estimate of the inverse Hessian")
d_plus = letter("d_p", "d", "m²/[F]", "d where it is positive", positive=True)
c = letter("c", "c", "m/(s [F])", "gain of the measurement", positive=True)
alpha_t = letter("alpha_t", r"\tilde{\alpha}", "m/s", "amplitude of the dither", positive=True)
alpha = letter("alpha", r"\alpha", "m/s", "amplitude of the dither but for a power of ω", positive=True)
h = letter("h", "h", "1/s", "rate of the filter of the measurement", positive=True)
omega = letter("omega", r"\omega", "1/s", "dither frequency", positive=True)
omega_0 = letter("omega_0", r"\omega_0", "1/s", "angular velocity of the vehicle", positive=True)
omega_d = letter("omega_d", r"\omega_d", "1/s", "rate of the Riccati filter", positive=True)
p = letter("p", "p", "1", "exponent: c = ω^(1 − p), α̃ = αω^p", positive=True)

# The field.
H = letter("H", "H", "[F]/m²", "Hessian parameter", positive=True)
F_star = letter("F_s", "F^*", "[F]", "field at the source")
xs1 = letter("xs1", "x^*_1", "m", "first coordinate of the source")
xs2 = letter("xs2", "x^*_2", "m", "second coordinate of the source")

# The rotating frame, the logarithm of d, and the coordinates in which the equilibrium is the origin.
z1 = letter("z1", "z_1", "m", "first coordinate in the rotating frame")
z2 = letter("z2", "z_2", "m", "second coordinate in the rotating frame")
d_t = letter("d_t", r"\tilde{d}", "1", "ln d")
d_h = letter("d_h", r"\hat{d}", "1", "ln d less ln 1/H, averaged")
r = letter("r", "r", "[F]", "ν less the field, averaged")

# One letter for each norm or value at one instant.
b = letter("b", "b", "1/s", "weight of the second part of the Lyapunov function", positive=True)
V_dot = letter("V_dot", r"\dot{V}", "1/s", "rate of the Lyapunov function")
norm_G = letter("norm_G", r"\|G\|", "1", "norm of the matrix G", nonnegative=True)
lambda_P = letter("lambda_min", r"\lambda_{\text{min}}(P)", "s", "least eigenvalue of P", positive=True)
lambda_1, lambda_2, lambda_3, lambda_4 = (
    letter(f"lambda_{n}", rf"\lambda_{n}", "1/s", "eigenvalue of a linearised averaged system") for n in range(1, 5)
)

position, source, rotated = (x1, x2), (xs1, xs2), (z1, z2)
HALF = sp.Rational(1, 2)
P_RANGE = (gt(p, HALF), lt(p, 1))


def field_at(first: sp.Expr, second: sp.Expr) -> sp.Expr:
    """F* − H‖·‖²/2 at the distance (first, second) from the source, as in eq:shapeofField."""
    return F_star - HALF * H * (first**2 + second**2)


F_x = field_at(x1 - xs1, x2 - xs2)
F_z = field_at(z1, z2)
z = sp.ImmutableDenseMatrix(rotated)
I = sp.ImmutableDenseMatrix.eye(2)  # noqa: E741 - the paper's letter
J_0 = sp.ImmutableDenseMatrix([[0, omega_0], [-omega_0, 0]])
Lambda = sp.ImmutableDenseMatrix([[0, 0], [0, -alpha * H / 2]])
Lambda_t = sp.ImmutableDenseMatrix([[0, 0], [0, -alpha / 2]])  # H⁻¹ Λ
J_g = sp.ImmutableDenseMatrix([[0, omega_0, 0], [-omega_0, -alpha * H / 2, 0], [0, 0, -h]])
J_n = sp.ImmutableDenseMatrix([[0, omega_0, 0, 0], [-omega_0, -alpha / 2, 0, 0], [0, 0, -omega_d, 0], [0, 0, 0, -h]])
P = sp.ImmutableDenseMatrix([[alpha / (4 * omega_0**2) + 2 / alpha, 1 / (2 * omega_0)], [1 / (2 * omega_0), 2 / alpha]])
G = sp.ImmutableDenseMatrix([[0, -alpha / (4 * omega_0)], [-alpha / (4 * omega_0), -2]])


def Y(angle: sp.Expr = omega_0 * t) -> sp.ImmutableDenseMatrix:
    """The matrix of the rotating frame, as printed for θ = ω₀t."""
    return sp.ImmutableDenseMatrix([[sp.sin(angle), sp.cos(angle)], [-sp.cos(angle), sp.sin(angle)]])


def rate_of(name: str) -> sp.Expr:
    """The derivative of a signal, for the left side of a displayed system."""
    return sp.Derivative(sp.Function(name)(t), t)


# How SymPy's printer writes the letters, for the report.
GLYPHS = alphabet.glyphs
