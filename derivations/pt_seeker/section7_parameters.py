"""Section 7: the numbers of its three examples, as printed and as simulated."""

from __future__ import annotations

import sympy as sp

from ptproof.problem import Problem, example
from ptproof.proof import Evidence, Goal, Relation, claim, definition, eq, every, exact

from .notation import S, T, epsilon, k, mu, omega, t0

SECTION = "7 Simulation: the parameters"

start = sp.symbols("x01 x02", real=True)
source = sp.symbols("xs1 xs2", real=True)
constant = sp.Symbol("k_h", positive=True)  # the gain that is simulated beside C(t) = 1/ν²
MU = sp.Rational("0.001")
VANISHING = {t0: 0, omega: 30, k: sp.Rational("1.8"), mu: MU, T: 1, start[0]: -2, start[1]: -2}
NONVANISHING = {t0: 0, omega: 50, k: 1, mu: MU, T: 2, start[0]: 1, start[1]: -1, source[0]: 0, source[1]: 0}
SATURATED = {
    t0: 0, omega: 30, k: sp.Rational("1.4"), mu: MU, T: 1, start[0]: 2, start[1]: 2, source[0]: 0, source[1]: 0,
    epsilon: sp.Rational("0.0004"), S: 4, constant: sp.Rational("11.11"),
}  # fmt: skip


def _simulated(problem: Problem) -> dict[sp.Symbol, sp.Expr]:
    """The same letters by what the simulated problem has for them."""
    tuning, law = problem.tuning, problem.saturation
    values = {t0: tuning.t0, omega: tuning.omega, k: tuning.k, mu: tuning.mu, T: tuning.T}
    values |= dict(zip((*start, *source), (*problem.initial.x, *problem.field.source), strict=True))
    return values if law is None else {**values, epsilon: law.epsilon, S: law.level, constant: law.gain}


def _column(values: dict[sp.Symbol, sp.Expr], letters: dict[sp.Symbol, sp.Expr]) -> sp.Matrix:
    return sp.Matrix([values[letter] for letter in letters])


def _equations(printed: dict[sp.Symbol, sp.Expr]) -> list[Relation]:
    return [eq(letter, value) for letter, value in printed.items()]


parameters = [
    definition(
        f"{part}/parameters", f"The parameters of Section {part}", every(*_equations(printed)), labels=[],
        place=f"Section {part}", prose="With the start of the vehicle; the heading at the start is not printed.",
    )
    for part, printed in (("7.1", VANISHING), ("7.2", NONVANISHING), ("7.3", SATURATED))
]  # fmt: skip


@claim(
    "7.1/simulated-as-printed", "What is simulated has the printed parameters",
    eq(_column(_simulated(example("vanishing")), VANISHING), _column(VANISHING, VANISHING)), place="Section 7.1",
)  # fmt: skip
def vanishing(goal: Goal) -> Evidence:
    """t₀, ω, k, μ, T and the start, in this order."""
    return exact(goal)


@claim(
    "7.2/simulated-as-printed", "What is simulated has the printed parameters",
    eq(_column(_simulated(example("nonvanishing")), NONVANISHING), _column(NONVANISHING, NONVANISHING)),
    place="Section 7.2",
)  # fmt: skip
def nonvanishing(goal: Goal) -> Evidence:
    """t₀, ω, k, μ, T, the start and the source."""
    return exact(goal)


@claim(
    "7.3/simulated-as-printed", "What is simulated has the printed parameters",
    eq(_column(_simulated(example("saturated")), SATURATED), _column(SATURATED, SATURATED)), place="Section 7.3",
)  # fmt: skip
def saturated(goal: Goal) -> Evidence:
    """t₀, ω, k, μ, T, the start, the source, ε, S and k_h."""
    return exact(goal)
