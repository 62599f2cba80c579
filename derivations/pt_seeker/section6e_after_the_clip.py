"""Section 6.4: what the clip costs: a residual, a condition for what comes after, and starts that are out of reach."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    exact,
    ge,
    gt,
    le,
    limits,
    lt,
    reals,
    refute,
    specialise,
)  # fmt: skip

from . import chain
from .notation import (
    E11,
    E12,
    E21,
    E22,
    IN_TIME,
    C,
    E,
    E_norm,
    F,
    F_source,
    T,
    f,
    k,
    nu,
    omega,
    t,
    t0,
    x1,
    x2,
    xs1,
    xs2,
)  # fmt: skip
from .section6c_feasibility import lowest
from .section6d_clipped import (
    below_one,
    clipped,
    decay_rate,
    drift_rate,
    drifted,
    final,
    gain_after,
    gain_before,
    rate_with_gain,
    s,
    slope,
    switch,
    total,
    total_time,
)  # fmt: skip

SECTION = "6.4 Discussion: what the clipped gain costs"

# --- The residual -----------------------------------------------------------------------------------------------------

start = sp.Symbol("V_start", positive=True)
printed_bound = start * sp.exp(drift_rate * T) * sp.exp(-decay_rate * total)


@claim(
    "6.4/residual-vanishes-with-the-clip", "The bound at the prescribed time tends to 0 as ν_min tends to 0",
    eq(sp.Limit(printed_bound, lowest, 0, "+"), 0), place="Section 6.4",
)  # fmt: skip
def residual_limit(goal: Goal) -> Evidence:
    """For every start, gain, drift matrix and T. So a small clip keeps the convergence on the average up to as small a
    residual as one likes; the size for a given ν_min depends on what is unknown to the vehicle."""
    return limits(goal)


X_t = sp.Function("X", real=True)


def moves(first: sp.Expr, end: sp.Expr, gain: sp.Expr) -> ForAll:
    """A coordinate of the averaged vehicle for F = −‖x‖²/2, without drift."""
    return ForAll((s,), eq(sp.Derivative(X_t(s), s), -gain * k / 2 * X_t(s)), (ge(s, first), le(s, end)))


def _below(first: sp.Expr, end: sp.Expr, gain: sp.Expr) -> ForAll:
    return ForAll((s,), le(sp.Derivative(X_t(s), s), -gain * k / 2 * X_t(s)), (ge(s, first), le(s, end)))


@claim(
    "6.4/coordinate-before-the-clip", "A coordinate of the average before the clip, from above",
    le(X_t(switch), X_t(t0) * sp.exp(-k / 2 * T * (1 / lowest - 1))),
    given=[below_one, _below(t0, switch, 1 / nu(s - t0) ** 2)], place="Section 6.4",
)  # fmt: skip
def coordinate_before(goal: Goal) -> Evidence:
    """The comparison lemma, for a coordinate of any sign."""
    return comparison(goal, X_t(t0) * sp.exp(-k / 2 * (s - t0) / nu(s - t0)), denominators=[nu(s - t0)])


@claim(
    "6.4/coordinate-after-the-clip", "A coordinate of the average after the clip, from above",
    le(X_t(final), X_t(switch) * sp.exp(-k / 2 * T / lowest)),
    given=[below_one, _below(switch, final, 1 / lowest**2)], place="Section 6.4",
)  # fmt: skip
def coordinate_after(goal: Goal) -> Evidence:
    """The same with the constant gain."""
    return comparison(goal, X_t(switch) * sp.exp(-k / 2 / lowest**2 * (s - switch)))


@claim(
    "6.4/residual-exact", "For F = −‖x‖²/2 without drift the average ends at e^(−kT(2/ν_min − 1)/2) times its start",
    eq(X_t(final), X_t(t0) * sp.exp(-k / 2 * total)),
    given=[below_one, moves(t0, final, clipped(s))], place="Section 6.4",
    uses=[coordinate_before, coordinate_after, gain_before, gain_after, total_time],
)  # fmt: skip
def residual_exact(goal: Goal) -> Evidence:
    """Each coordinate, exactly: the bound before is attained, and the source is not reached at the prescribed time."""
    negative = {X_t(s): -X_t(s)}
    return reals(
        goal, *specialise(goal, coordinate_before, {}), *specialise(goal, coordinate_after, {}),
        *specialise(goal, coordinate_before, negative), *specialise(goal, coordinate_after, negative),
    )  # fmt: skip


# --- After the prescribed time ----------------------------------------------------------------------------------------

clipped_rate = drifted.derivative_along(F_source - F)
moving = gt(slope.dot(slope), 0)
at_last = eq(C, 1 / lowest**2)


@claim(
    "6.4/closer-after-the-clip", "After the clip the seeker is driven closer to the source, as the text says",
    lt(clipped_rate, 0), given=[at_last, moving], place="Section 6.4", expected="refuted",
    grade="wording",
    wrong="That the clipped seeker goes on towards the source is said without a condition; under a drift E∇F with "
    "k < 2ν_min²‖E‖ its average may move away after the clip.",
    survives="The theorem is about the gain without a clip and is not touched; without drift the sentence is right.",
)  # fmt: skip
def closer_after(goal: Goal) -> Evidence:
    """On the average, for every drift of case A. The witness is F = −‖x‖²/2 with the drift 3x and the last gain 4:
    V grows. From the clip on the seeker is an asymptotic one, with its condition on k."""
    return refute(goal, {
        F: -(x1**2 + x2**2) / 2, F_source: 0, x1: 1, x2: 0, k: 1, lowest: sp.Rational(1, 2), C: 4,
        E11: -3, E22: -3, E12: 0, E21: 0,
    })  # fmt: skip


drift = E * slope


@claim(
    "6.4/closer-after-the-clip-corrected", "After the clip V falls on the average if k > 2ν_min²‖E‖",
    lt(clipped_rate, 0),
    given=[at_last, moving, le(drift.dot(drift), E_norm**2 * slope.dot(slope)), gt(k, 2 * lowest**2 * E_norm)],
    place="Section 6.4", corrects=closer_after, uses=[rate_with_gain],
)  # fmt: skip
def closer_after_corrected(goal: Goal) -> Evidence:
    """The condition of the asymptotic seeker with the last gain: ν_min² = 0.09 makes it eleven times as weak. Without
    drift it always holds, so that the sentence is right then."""
    return reals(goal)


# --- The vehicle itself -----------------------------------------------------------------------------------------------

X1, X2, Along = (sp.Function(name, real=True) for name in ("X_1", "X_2", "D"))
n1, n2 = sp.symbols("n_1 n_2", real=True)


@claim(
    "6.4/speed", "Without drift the vehicle's speed is √ω times the gain, whatever its heading",
    eq(sum((entry.subs(dict.fromkeys(f, 0))) ** 2 for entry in chain.closed_loop_t.rhs[:2]), omega / nu(t - t0) ** 4),
    given=IN_TIME, place="Section 6.4",
)  # fmt: skip
def speed(goal: Goal) -> Evidence:
    """cos² + sin² = 1: the seeker turns, and never slows down."""
    return exact(goal)


def drives(end: sp.Expr, gain: sp.Expr) -> ForAll:
    """A vehicle whose speed is at most √ω times the gain, on [t₀, end]."""
    speed_squared = sp.Derivative(X1(s), s) ** 2 + sp.Derivative(X2(s), s) ** 2
    return ForAll((s,), le(speed_squared, omega * gain**2), (ge(s, t0), le(s, end)))


def advances(first: sp.Expr, end: sp.Expr, gain: sp.Expr) -> ForAll:
    """A length that grows no faster than the vehicle drives."""
    return ForAll((s,), le(sp.Derivative(Along(s), s), gain * sp.sqrt(omega)), (ge(s, first), le(s, end)))


@claim(
    "6.4/advance-before-the-clip", "The vehicle's way before the clip",
    le(Along(switch), Along(t0) + sp.sqrt(omega) * T * (1 / lowest - 1)),
    given=[below_one, advances(t0, switch, 1 / nu(s - t0) ** 2)], place="Section 6.4",
)  # fmt: skip
def advance_before(goal: Goal) -> Evidence:
    """The speed √ω/ν², integrated."""
    return comparison(goal, Along(t0) + sp.sqrt(omega) * (s - t0) / nu(s - t0), denominators=[nu(s - t0)])


@claim(
    "6.4/advance-after-the-clip", "The vehicle's way after the clip",
    le(Along(final), Along(switch) + sp.sqrt(omega) * T / lowest),
    given=[below_one, advances(switch, final, 1 / lowest**2)], place="Section 6.4",
)  # fmt: skip
def advance_after(goal: Goal) -> Evidence:
    """The speed √ω/ν_min² for the last Tν_min."""
    return comparison(goal, Along(switch) + sp.sqrt(omega) / lowest**2 * (s - switch))


@claim(
    "6.4/advance", "In no direction the vehicle gets further than √ωT(2/ν_min − 1) by the prescribed time",
    le(n1 * (X1(final) - X1(t0)) + n2 * (X2(final) - X2(t0)), sp.sqrt(omega) * total),
    given=[below_one, eq(n1**2 + n2**2, 1), drives(final, clipped(s))], place="Section 6.4",
    uses=[advance_before, advance_after, gain_before, gain_after, total_time, speed],
)  # fmt: skip
def advance(goal: Goal) -> Evidence:
    """Driftless, for every steering: only the speed counts."""
    way = {Along(s): n1 * X1(s) + n2 * X2(s)}
    return reals(goal, *specialise(goal, advance_before, way), *specialise(goal, advance_after, way))


def length(first: sp.Expr, second: sp.Expr) -> sp.Expr:
    """The Euclidean norm of a pair."""
    return sp.sqrt(first**2 + second**2)


d1, d2, e1, e2 = sp.symbols("d_1 d_2 e_1 e_2", real=True)
span, rest = sp.symbols("N M", nonnegative=True)
reach = sp.Symbol("L", positive=True)


@claim(
    "6.4/triangle", "Who gets at most L ahead in the direction of the source keeps the distance less L",
    le(span - reach, rest),
    given=[
        eq(span**2, d1**2 + d2**2), eq(rest**2, (d1 - e1) ** 2 + (d2 - e2) ** 2), le(d1 * e1 + d2 * e2, span * reach),
    ],
    place="Section 6.4",
)  # fmt: skip
def triangle(goal: Goal) -> Evidence:
    """d is the way to the source, e the way that was gone."""
    return reals(goal)


ahead = (xs1 - X1(t0), xs2 - X2(t0))
gone = (X1(final) - X1(t0), X2(final) - X2(t0))
left = length(xs1 - X1(final), xs2 - X2(final))


@claim(
    "6.4/far-start", "Under the clipped gain a start that is too far away does not arrive in time",
    le(length(*ahead) - sp.sqrt(omega) * total, left),
    given=[below_one, drives(final, clipped(s))], place="Section 6.4", uses=[advance, triangle],
)  # fmt: skip
def far_start(goal: Goal) -> Evidence:
    """The vehicle itself, without drift: from a distance of more than √ωT(2/ν_min − 1) + ε it cannot be within ε of the
    source at t₀ + T. So "regardless of initial conditions" needs an ω that is chosen for the start, as the definition
    of FxT-sSPUAS allows, or the gain without a clip."""
    unit = {n1: ahead[0] / length(*ahead), n2: ahead[1] / length(*ahead)}
    values = {d1: ahead[0], d2: ahead[1], e1: gone[0], e2: gone[1], span: length(*ahead), rest: left,
              reach: sp.sqrt(omega) * total}  # fmt: skip
    return reals(goal, *specialise(goal, advance, unit), *specialise(goal, triangle, values))
