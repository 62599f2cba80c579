"""Section 7.3: how well the saturated angular acceleration makes the angular velocity follow its command."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    Relation,
    claim,
    comparison,
    eq,
    every,
    exact,
    ge,
    le,
    reals,
    specialise,
)  # fmt: skip

from .notation import C, S, epsilon, k, mu, omega, t, u2, z
from .section7c_saturated import acceleration, sat, saturation_identity, signal, y

SECTION = "7.3 Simulation: the angular velocity follows its command"

s, start = sp.symbols("s t_1", real=True)
L = sp.Symbol("L", nonnegative=True)  # a bound of the command's rate
U2, command, deviation = (sp.Function(name, real=True) for name in ("U_2", "W", "Delta"))
after = ge(t, start)


def on_way(relation: Relation) -> ForAll:
    """The relation at all times from t₁ to t."""
    return ForAll((s,), relation, (ge(s, start), le(s, t)))


# The third line of eq:sat_seeker, with W(t) for the feedback law C(ω − (k/μ)(y − z)).
follows = on_way(eq(sp.Derivative(U2(s), s), sat(command(s) - U2(s)) / epsilon))
slow_command = [on_way(le(sp.Derivative(command(s), s), L)), on_way(ge(sp.Derivative(command(s), s), -L))]
remaining = sp.exp(-(t - start) / epsilon)


@claim(
    "7.3/acceleration-form", "The saturated seeker's angular acceleration, with the feedback law as a command",
    eq(acceleration, sat(signal - u2) / epsilon), given=[eq(signal, C * (omega - k / mu * (y - z)))],
    labels=["eq:sat_acc"], place="Section 7.3",
)  # fmt: skip
def acceleration_form(goal: Goal) -> Evidence:
    """What is saturated is the deviation of u₂ from its command."""
    return exact(goal)


@claim(
    "7.3/stays-unsaturated", "A deviation of at most S stays so while the command turns no faster than S/ε",
    le(deviation(t), S),
    given=[
        after, le(deviation(start), S), le(L * epsilon, S),
        on_way(le(sp.Derivative(deviation(s), s), -sat(deviation(s)) / epsilon + L)),
    ],
    labels=["eq:sat_acc"], place="Section 7.3",
)  # fmt: skip
def stays_below(goal: Goal) -> Evidence:
    """At the deviation S the acceleration S/ε is at least the command's rate."""
    return comparison(goal, S)


@claim(
    "7.3/unsaturated", "While the command turns no faster than S/ε, the saturation is never active again",
    every(le(U2(t) - command(t), S), le(command(t) - U2(t), S)),
    given=[
        after, le(sp.Abs(U2(start) - command(start)), S), le(L * epsilon, S), follows, *slow_command,
    ],
    labels=["eq:sat_acc"], place="Section 7.3", uses=[stays_below, acceleration_form],
)  # fmt: skip
def unsaturated(goal: Goal) -> Evidence:
    """Both signs of the deviation. With S = 4 and ε = 0.0004 this is a limit of 10 000 rad/s² for the command's rate,
    and of 4 rad/s for the deviation."""
    both = (U2(s) - command(s), command(s) - U2(s))
    return reals(goal, *(fact for value in both for fact in specialise(goal, stays_below, {deviation(s): value})))


@claim(
    "7.3/deviation", "Without saturation the deviation decays to the level that the command's rate holds up",
    le(deviation(t), deviation(start) * remaining + epsilon * L * (1 - remaining)),
    given=[after, on_way(le(sp.Derivative(deviation(s), s), -deviation(s) / epsilon + L))],
    labels=["eq:sat_acc"], place="Section 7.3",
)  # fmt: skip
def deviation_bound(goal: Goal) -> Evidence:
    """A linear comparison equation with the time constant ε."""
    left = sp.exp(-(s - start) / epsilon)
    return comparison(goal, deviation(start) * left + epsilon * L * (1 - left))


unsaturated_on_way = [on_way(le(U2(s) - command(s), S)), on_way(le(command(s) - U2(s), S))]


@claim(
    "7.3/tracking", "Where the saturation is not active, u₂ follows its command up to an error of the order ε",
    le(sp.Abs(U2(t) - command(t)), sp.Abs(U2(start) - command(start)) * remaining + epsilon * L),
    given=[after, follows, *slow_command, *unsaturated_on_way],
    labels=["eq:sat_acc"], place="Section 7.3", uses=[deviation_bound, acceleration_form, saturation_identity],
)  # fmt: skip
def tracking(goal: Goal) -> Evidence:
    """The text argues with the equilibrium; this is what holds along trajectories: the start is forgotten with the time
    constant ε, and what is left is ε times the largest rate of the command. So ε has to be small against the times in
    which the command changes."""
    both = (U2(s) - command(s), command(s) - U2(s))
    return reals(goal, *(fact for value in both for fact in specialise(goal, deviation_bound, {deviation(s): value})))


@claim(
    "7.3/rise", "What rises no faster than S/ε rises by at most S/ε times the time",
    le(deviation(t), deviation(start) + S / epsilon * (t - start)),
    given=[after, on_way(le(sp.Derivative(deviation(s), s), S / epsilon))], labels=["eq:sat_acc"],
    place="Section 7.3",
)  # fmt: skip
def rise(goal: Goal) -> Evidence:
    """For what rises no faster than the acceleration allows."""
    return comparison(goal, deviation(start) + S / epsilon * (s - start))


@claim(
    "7.3/rate-limited", "Whatever the command is, u₂ changes by at most S/ε times the time",
    le(sp.Abs(U2(t) - U2(start)), S / epsilon * (t - start)),
    given=[after, follows], labels=["eq:sat_acc"], place="Section 7.3", uses=[rise],
)  # fmt: skip
def rate_limited(goal: Goal) -> Evidence:
    """The other side of it: a command that turns faster is not followed. With the parameters of the example it takes
    1 ms for each 10 rad/s."""
    return reals(goal, *(fact for value in (U2(s), -U2(s)) for fact in specialise(goal, rise, {deviation(s): value})))
