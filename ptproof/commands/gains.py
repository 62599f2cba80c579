"""``ptproof gains``: compute gain conditions and bounds."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from ptproof.commands import options
from ptproof.errors import InputError

if TYPE_CHECKING:
    import sympy as sp

    from ptproof.gains.answer import Gains
    from ptproof.gains.problem import Study
    from ptproof.problem import Problem
    from ptproof.problem.field import FieldBounds
    from ptproof.simulation.fleet import Simulated

_CONSTANTS = ("kappa", "a1", "a2", "b1", "b2")
_NUMBERS = {
    "kappa": "Order of the field.",
    "a1": "Largest (F(x*) - F)/r^(2 kappa).",
    "a2": "Smallest (F(x*) - F)/r^(2 kappa).",
    "b1": "Smallest |grad F|/r^(2 kappa - 1).",
    "b2": "Largest |grad F|/r^(2 kappa - 1).",
    "drift-norm": "Norm of E in a drift E grad F.",
    "drift-bound": "Largest norm of a bounded drift.",
    "k": "Gain.",
    "T": "Prescribed time.",
    "nu-min": "Where the clock's rate, 1/nu^2 for the paper's, is capped.",
    "exponent": "The m of the clock 'power', whose rate is 1/nu^(m + 1).",
    "V0": "F(x*) - F at the start.",
    "x0-norm": "Distance to the source at the start.",
    "tau-star": "A stretched time at which the bound may escape.",
    "t0": "Start.",
    "omega": "Frequency of the seeker.",
    "mu": "Filter constant of the seeker.",
    "residual": "A distance wanted at t0 + T: status 1 unless the average and 1/sqrt(omega) are certainly within it.",
    "radius": "Of the ball on which a problem's constants are certified.",
}


def _options(command: Any) -> Any:
    for name, text in reversed(_NUMBERS.items()):
        command = click.option(f"--{name}", name.replace("-", "_"), metavar="X", help=text)(command)
    return command


@click.command()
@click.argument("problem", required=False, metavar="[PROBLEM.toml]")
@_options
@click.option("--clock", metavar="NAME", help="paper, power, logarithmic, exponential or tangent (default: paper).")
@options.plot("a picture of the bounds")
@options.as_json
def gains(problem: str | None, clock: str | None, plot: str | None, as_json: bool, **texts: str | None) -> int:
    """Compute every gain condition and bound for a problem or for given constants.

    Numbers are exact: "1.8", "9/5" and "2*pi/3" all work. For a problem file (or the name of one of the paper's
    examples) the constants are certified where the averaged system moves, unless a1, a2, b1 and b2 are given; a
    tight bound is computed and compared with simulations of the averaged system.

    \b
    Example:  ptproof gains --kappa 2 --a1 3/2 --a2 1/2 --b1 1.4 --b2 3.3 --drift-norm 1.5 --k 1.8 --T 1 --V0 0.5
    """
    from ptproof.gains.residual import Residual
    from ptproof.reading.expressions import parse

    values: dict[str, Any] = {
        name: parse(text, where=f"--{name.replace('_', '-')}") for name, text in texts.items() if text is not None
    }
    if clock is not None:
        values["clock"] = clock
    residual = values.get("residual")
    content, show, bounds, answered, omega = (
        _from_numbers(values, plot) if problem is None else _from_problem(problem, values, plot)
    )
    asked = None if residual is None else Residual(residual, bounds, omega)
    if as_json:
        options.print_json(content | {"residual": None if asked is None else asked.to_json()})
    else:
        if asked is not None:
            click.echo("\n".join(asked.sentences) + "\n")
        show()
    return 0 if answered and (asked is None or asked.is_met) else 1


class _Found(NamedTuple):
    """What either kind of question comes to: its JSON, its tables, the bounds of the average at t₀ + T, and ω."""

    content: dict[str, Any]
    show: Callable[[], None]
    bounds: tuple[sp.Expr, ...]
    answered: bool = True
    omega: sp.Expr | None = None


def _from_numbers(values: dict[str, Any], plot: str | None) -> _Found:
    from ptproof.gains import GainData
    from ptproof.gains import gains as answer_for
    from ptproof.problem.field import FieldBounds

    if missing := [f"--{name}" for name in _CONSTANTS if name not in values]:
        raise InputError(f"without a problem file the field's constants are needed: {', '.join(missing)}")
    if "radius" in values:
        raise InputError("--radius: only a problem file has a field to certify")
    bounds = FieldBounds(*(values.pop(name) for name in _CONSTANTS))
    answer = answer_for(GainData(bounds, **values))
    if answer.data.impossible is not None:
        click.echo(f"ptproof: warning: {answer.data.impossible}", err=True)
    if plot is not None:
        from ptproof.gains.plot import plot_gains

        plot_gains(answer.data, path=plot)
    bound = answer["clip.residual_bound"]
    best = () if bound is None else (bound.exact,)
    return _Found(answer.to_json(), partial(_table, answer), best, omega=answer.data.omega)


def _from_problem(name: str, values: dict[str, Any], plot: str | None) -> _Found:
    from ptproof.gains import study
    from ptproof.problem import EXAMPLES, example, load
    from ptproof.simulation.fleet import worst_distance

    problem = _changed(example(name) if name in EXAMPLES else load(name), values)
    bounds = _declared(problem, values)
    try:
        result = study(problem, bounds=bounds, **values)
        simulated = worst_distance(problem, result.curve.initial)
    except InputError as error:
        raise InputError(f"{name}: {error}") from None
    if plot is not None:
        from ptproof.gains.plot import plot_gains

        plot_gains(None if result.answer is None else result.answer.data, result.curve, simulated.curves, plot)
    content, show = _problem_json(result, simulated), partial(_summary, result, simulated)
    answered, omega = result.answer is not None, result.problem.tuning.omega
    return _Found(content, show, result.exact_bounds_at_end, answered, omega)


def _declared(problem: Problem, values: dict[str, Any]) -> FieldBounds | None:
    """The constants out of the options, which then take the place of certified ones."""
    from ptproof.problem.field import FieldBounds

    kappa = values.pop("kappa", problem.kappa)
    if kappa != problem.kappa:
        raise InputError(f"--kappa: {problem.name} has kappa = {problem.kappa}, not {kappa}")
    given = {name: values.pop(name) for name in _CONSTANTS if name in values}
    if not given:
        return None
    if missing := [f"--{name}" for name in _CONSTANTS if name != "kappa" and name not in given]:
        raise InputError(f"a problem's constants are certified unless all are given; missing: {', '.join(missing)}")
    return FieldBounds(kappa, **given)


def _changed(problem: Problem, values: dict[str, Any]) -> Problem:
    """The problem with the tuning that the options replace; the rest of ``values`` stays."""
    import dataclasses

    names = ("k", "T", "t0", "nu_min", "omega", "mu", "clock", "exponent")
    tuning = {name: values.pop(name) for name in names if name in values}
    if "clock" in tuning:
        tuning.setdefault("exponent", None)
    return dataclasses.replace(problem, tuning=dataclasses.replace(problem.tuning, **tuning))


def _problem_json(result: Study, simulated: Simulated) -> dict[str, Any]:
    from ptproof.gains.entries import ENTRIES

    certificate, worst = result.certificate, simulated.worst
    if result.answer is not None:
        content = result.answer.to_json()
    else:
        reason = f"the field's constants are {None if certificate is None else certificate.verdict}"
        content = {section: dict.fromkeys(entries) for section, entries in ENTRIES.items()}
        content["why"] = {f"{section}.{key}": reason for section, entries in ENTRIES.items() for key in entries}
    return {
        "problem": result.problem.name,
        **content,
        "certificate": None if certificate is None else certificate.to_json(),
        "valid": result.condition,
        "tight": {
            "distance_at_end": result.bounds_at_end["tight"],
            "initial_distance": str(result.curve.initial),
            **result.curve.evidence.to_json(),
        },
        "bounds_at_end": dict(result.bounds_at_end),
        "worst_simulated": worst,
        "looseness": None if worst is None else result.looseness(worst),
        **({"worst_simulated_why": simulated.why} if worst is None else {}),
    }


def _table(answer: Gains) -> None:
    """Every entry, with whose property it is in the first column."""
    import shutil

    from ptproof.gains.entries import ENTRIES, TITLES

    room = max(24, shutil.get_terminal_size((120, 24)).columns - 66)
    for section, entries in answer.values.items():
        click.secho(TITLES[section], bold=True)
        reasons = {answer.why.get(f"{section}.{key}") for key in entries}
        if len(reasons) == 1 and None not in reasons:
            click.echo(f"  — {reasons.pop()}")
            continue
        for key, quantity in entries.items():
            shown, beside = "—", answer.why.get(f"{section}.{key}", "")
            if quantity is not None:
                shown, exact = quantity.text, str(quantity.exact)
                beside = exact if len(exact) <= room else "" if shown else "a formula in tau; see --json"
            entry = ENTRIES[section][key]
            row = f"  {entry.about:<9}{entry.label:<38}{shown:>13}"
            click.echo(f"{row}  {click.style(beside, dim=True)}" if beside else row)


def _summary(result: Study, simulated: Simulated) -> None:
    """The answer first: how far the average is at the end; then the constants, and everything else."""
    from ptproof.balls.rounding import at_most

    certificate, curve, worst = result.certificate, result.curve, simulated.worst
    click.secho(
        f"The average at t₀ + T, from {float(curve.initial):.6g} away, with drift and clip (no bound of the vehicle):",
        bold=True,
    )
    names = {
        "printed": ("the paper's chain", "clip.residual_bound_printed"),
        "closed_form": ("closed form, sharper", "clip.residual_bound"),
        "tight": ("certified, level by level", None),
    }
    ratios = {} if worst is None else result.looseness(worst)
    for name, value in result.bounds_at_end.items():
        label, key = names[name]
        found = None if result.answer is None or key is None else result.answer[key]
        text = at_most(value, 6) if value is not None else None if found is None else found.text
        shown, ratio = "—" if text is None else f"≤ {text}", ratios.get(name)
        click.echo(f"  {label:<26} {shown:<14}" + ("" if ratio is None else f"{ratio:.3g} × the worst simulated"))
    if worst is None:
        click.echo(f"  no worst simulated distance: {simulated.why}")
    else:
        click.echo(f"  {'worst simulated':<26} {worst:.6g}        (observed, not a bound)")
    if str(curve.evidence.verdict) != "proved":
        click.echo(f"  the certified bound was {curve.evidence.detail}")
    hover = float(result.problem.tuning.omega) ** -0.5
    click.echo(
        f"The vehicle circles around its average at about {hover:.6g} (1/√ω, to leading order; no theorem about its\n"
        f"distance: that is what ptproof certify decides)."
    )
    status = "declared" if certificate is None else str(certificate.verdict)
    click.echo(f"Field constants: {status}, valid {result.condition}.\n")
    if result.answer is not None:
        _table(result.answer)
    elif certificate is not None:
        click.echo(f"  {certificate.summary}")
