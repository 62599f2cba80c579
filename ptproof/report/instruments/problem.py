"""The vehicle of a seeking problem beside its average, and the problem file that runs the same."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import TIME, Problem, parameters
from ptproof.problem.drift import Drift
from ptproof.problem.loops import averaged_system, closed_loop
from ptproof.proof.claim import Claim
from ptproof.report.instruments.instrument import Vehicle
from ptproof.transforms.clocks import CappedClock

_TUNED = (parameters.k, parameters.omega, parameters.mu, parameters.T, parameters.nu_min)


def vehicle(
    problem: Problem, title: str, claims: Iterable[Claim], starts: Mapping[str, sp.Expr], drift: Drift | None = None
) -> Vehicle:
    """The closed loop of the prescribed-time seeker and its average, in the dilated time, with their letters.

    Parameters
    ----------
    problem
        With a clipped gain, so that the run reaches the prescribed time.
    claims
        What says that these are the paper's.
    starts
        The first position and heading by the names of the states; what is left out is the problem's.
    drift
        In the place of the problem's own; its entries may have letters, which need sliders.

    Raises
    ------
    InputError
        If the gain is not clipped.
    """
    clock, seeker, states = problem.seeker_clock("pt"), problem.seeker("pt"), problem.states
    if not isinstance(clock, CappedClock):
        raise InputError(f"{problem.name}: without nu_min no run gets to the prescribed time")
    pushed, own = drift or problem.drift, {parameters.t0: problem.tuning.t0}
    loop = closed_loop(problem.field, pushed, seeker, clock, "tau", "full").with_values(own)
    average = averaged_system(problem.field, pushed, seeker, clock, "tau").with_values(own)
    first = dict(zip((symbol.name for symbol in problem.variables), problem.initial.x, strict=True))
    first |= {states.heading.name: problem.initial.theta, **starts}
    position = tuple(sp.sympify(first[symbol.name]) for symbol in problem.variables)
    measured = problem.field.value(position) if problem.initial.z is None else problem.initial.z
    values = dict(zip(problem.variables, position, strict=True))
    values |= {states.heading: sp.sympify(first[states.heading.name]), states.filter: measured}
    early, late = clock.pieces
    edges = (
        clock.start, early.to_tau.subs(TIME, clock.until), late.to_tau.subs(TIME, clock.start + parameters.T)
    )  # fmt: skip
    return Vehicle(
        title, loop, average, values, tuple(edge.subs(own) for edge in edges), clock.to_t.subs(own),
        (problem.source[0], problem.source[1]), problem.field.expression, tuple(claims), ("final.x", "average.x"),
    )  # fmt: skip


def command(problem: Problem, moved: Mapping[str, sp.Expr], drift: Drift | None = None) -> str:
    """The shell command that runs :func:`vehicle`: a problem file, and ``ptproof simulate``.

    The values are placeholders, filled with those of the sliders; ``moved`` are the starts that have one.
    """

    def text(value: sp.Basic) -> str:
        own = {symbol.name: sp.Symbol(f"{{{symbol.name}}}") for symbol in value.free_symbols}
        known = {symbol.name for symbol in (TIME, *problem.variables)}
        return str(value.xreplace({item: own[item.name] for item in value.free_symbols if item.name not in known}))

    def listed(values: Iterable[sp.Basic]) -> str:
        return "[" + ", ".join(f'"{text(sp.sympify(value))}"' for value in values) + "]"

    pushed = drift or problem.drift
    initial = {**dict(zip((symbol.name for symbol in problem.variables), problem.initial.x, strict=True)), **moved}
    lines = [
        "[field]", "variables = " + listed(problem.variables), f'expression = "{problem.field.expression}"',
        "source = " + listed(problem.source), f"kappa = {problem.kappa}", "[drift]", f'kind = "{pushed.kind}"',
    ]  # fmt: skip
    if pushed.matrix is not None:
        lines.append("E = [" + ", ".join(listed(row) for row in pushed.matrix.tolist()) + "]")
    elif pushed.kind == "bounded":
        lines += ["f = " + listed(pushed.rate), f'bound = "{pushed.bound}"']
    lines += ["[seeker]", f't0 = "{problem.tuning.t0}"']
    lines += [f'{symbol.name} = "{{{symbol.name}}}"' for symbol in _TUNED]
    lines += ["[initial]", "x = " + listed(initial[symbol.name] for symbol in problem.variables)]
    lines += [f'theta = "{text(sp.sympify(moved.get("theta", problem.initial.theta)))}"']
    file = "vehicle.toml"
    inside = "\n".join(lines)
    return f"cat > {file} <<'END'\n{inside}\nEND\nptproof simulate {file} --seeker pt --frame tau --rtol 1e-11"
