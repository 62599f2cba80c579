"""Attacking a clock: its two maps and rates at instants of its interval, by an evaluator of the attacker's own."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof.attack import insist
from ptproof.proof.claim import Goal
from ptproof.proof.statement import Relation, every, ge, gt, lt


def goals(clock: Any) -> tuple[Goal, ...]:
    """What a clock, capped or not, promises, as goals: on its interval in t, and at the times in τ that these lead to.

    What is ``given`` of the letters of a capped clock is assumed. Derivatives and compositions stay unevaluated, so
    that the clock's own are held against others.
    """
    t, tau = clock.t, clock.tau
    given = list(getattr(clock, "given", ()))
    in_t = [*given, ge(t, clock.start)]
    if clock.horizon is not sp.oo:
        in_t.append(lt(t, clock.start + clock.horizon))
    forth, back = clock.to_tau, clock.to_t
    there, again = (
        every(
            Relation(sp.Subs(inverse, other, map_), "=", time),
            Relation(sp.Derivative(map_, time, evaluate=False), "=", rate),
            gt(rate, 0),
            ge(map_, clock.start),
        )
        for map_, inverse, time, other, rate in (
            (forth, back, t, tau, clock.rate),
            (back, forth, tau, t, clock.rate_back),
        )
    )
    at_start = every(
        Relation(sp.Subs(forth, t, clock.start), "=", clock.start),
        Relation(sp.Subs(back, tau, clock.start), "=", clock.start),
    )
    return (
        Goal(f"{clock.name} in t", there, tuple(in_t)),
        Goal(f"{clock.name} in τ", again, (*in_t, Relation(tau, "=", forth))),
        Goal(f"{clock.name} at its start", at_start, tuple(given)),
    )


def unshaken(clock: Any, *, points: int = 12) -> int:
    """At how many points the clock was attacked in vain.

    Raises
    ------
    WrongPromise
        With exact values at which the maps are no inverse of each other, a rate is not theirs, or one decreases.
    """
    return sum(
        insist(f"the clock {clock.name} is a change of time", goal, points=points).points for goal in goals(clock)
    )
