"""``ptproof gains``: compute gain conditions and bounds."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    import sympy as sp

    from ptproof.gains.answer import Gains
    from ptproof.gains.problem import Study
    from ptproof.problem import Problem
    from ptproof.problem.field import FieldBounds

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
    "nu-min": "Where the gain 1/nu^2 is clipped.",
    "V0": "F(x*) - F at the start.",
    "x0-norm": "Distance to the source at the start.",
    "tau-star": "A stretched time at which the bound may escape.",
    "t0": "Start.",
    "omega": "Frequency of the seeker.",
    "mu": "Filter constant of the seeker.",
    "residual": "A distance that is wanted at t0 + T (exit status 1 if it is not guaranteed).",
    "radius": "Of the ball on which a problem's constants are certified.",
}
_LABELS = {
    "constants.q": "exponent q", "constants.sigma": "exponent σ = 2q − 1",
    "constants.c1": "c₁ = b₁/a₁^q", "constants.c2": "c₂ = b₂/a₂^q",
    "asymptotic.k_min_printed": "least k, as printed", "asymptotic.k_min": "least k that suffices",
    "prescribed_time.overshoot": "overshoot factor, as printed", "prescribed_time.rate": "decay rate in τ",
    "prescribed_time.overshoot_split": "overshoot factor, sharper",
    "critical.V0_at_tau_star": "V₀ that escapes at τ*", "critical.V0_threshold_printed": "safe V₀ below, as printed",
    "critical.V0_threshold": "safe V₀ below", "critical.T_threshold_printed": "safe T below, as printed",
    "critical.T_threshold": "safe T below", "critical.escape_time": "the printed bound escapes at τ",
    "critical.escape_time_split": "the sharper bound escapes at τ",
    "nonvanishing.h1": "h₁", "nonvanishing.h2": "h₂", "nonvanishing.gamma": "γ(h₂d), as printed",
    "nonvanishing.ultimate_bound": "ultimate distance",
    "nonvanishing.ultimate_bound_printed": "ultimate distance, printed γ",
    "nonvanishing.exact_bound": "exact bound in τ, unclipped",
    "clip.tau_end": "τ reached at t₀ + T", "clip.k_effective": "gain after the clip, k/ν_min²",
    "clip.k_min_after_clip": "least k for convergence after the clip", "clip.u1_peak": "peak of u₁",
    "clip.u2_peak": "peak of |u₂| while r ≤ r₀", "clip.residual_bound": "distance at t₀ + T is at most",
    "clip.residual_bound_printed": "the same, as printed", "clip.nu_min_for_residual": "largest ν_min for the residual",
}  # fmt: skip
_TITLES = {
    "constants": "Constants", "asymptotic": "Asymptotic seeker", "prescribed_time": "Prescribed time",
    "critical": "Critical start and time", "nonvanishing": "Drift that does not vanish", "clip": "Clipped gain",
}  # fmt: skip


def _options(command: Any) -> Any:
    for name, text in reversed(_NUMBERS.items()):
        command = click.option(f"--{name}", name.replace("-", "_"), metavar="X", help=text)(command)
    return command


@click.command()
@click.argument("problem", required=False, metavar="[PROBLEM.toml]")
@_options
@click.option("--plot", "picture", metavar="FILE", help="Write a picture of the bounds.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON on standard output.")
def gains(problem: str | None, picture: str | None, as_json: bool, **texts: str | None) -> int:
    """Compute every gain condition and bound for a problem or for given constants.

    Numbers are exact: "1.8", "9/5" and "2*pi/3" all work. For a problem file (or the name of one of the paper's
    examples) the constants are certified where the averaged system moves, unless a1, a2, b1 and b2 are given; a
    tight bound is computed and compared with simulations of the averaged system.

    \b
    Example:  ptproof gains --kappa 2 --a1 3/2 --a2 1/2 --b1 1.4 --b2 3.3 --drift-norm 1.5 --k 1.8 --T 1 --V0 0.5
    """
    from ptproof.errors import InputError
    from ptproof.reading.expressions import parse

    values: dict[str, Any] = {
        name: parse(text, where=f"--{name.replace('_', '-')}") for name, text in texts.items() if text is not None
    }
    radius = values.pop("radius", None)
    if problem is None:
        missing = [f"--{name}" for name in _CONSTANTS if name not in values]
        if missing:
            raise InputError(f"without a problem file the field's constants are needed: {', '.join(missing)}")
        if radius is not None:
            raise InputError("--radius: only a problem file has a field to certify")
        return _from_numbers(values, picture, as_json)
    return _from_problem(problem, radius, values, picture, as_json)


def _from_numbers(values: dict[str, Any], picture: str | None, as_json: bool) -> int:
    from ptproof.gains import GainData
    from ptproof.gains import gains as answer_for
    from ptproof.problem.field import FieldBounds

    bounds = FieldBounds(*(values.pop(name) for name in _CONSTANTS))
    answer = answer_for(GainData(bounds, **values))
    if answer.data.impossible is not None:
        click.echo(f"ptproof: warning: {answer.data.impossible}", err=True)
    if picture is not None:
        from ptproof.gains.plot import plot_gains

        plot_gains(picture, answer.data)
    bound = answer["clip.residual_bound"]
    met = _met(values.get("residual"), None if bound is None else bound.value)
    if as_json:
        click.echo(json.dumps(answer.to_json(), indent=2, ensure_ascii=False))
    else:
        _table(answer)
        _say_residual(values.get("residual"), met)
    return 1 if met is False else 0


def _from_problem(name: str, radius: Any, values: dict[str, Any], picture: str | None, as_json: bool) -> int:
    from ptproof.gains.problem import study
    from ptproof.problem import EXAMPLES, example, load
    from ptproof.simulation.worst import worst_distance

    problem = example(name) if name in EXAMPLES else load(name)
    problem = _changed(problem, values)
    result = study(problem, bounds=_declared(problem, values), radius=radius, **values)
    simulated = worst_distance(problem, result.curve.initial)
    if picture is not None:
        from ptproof.gains.plot import plot_gains

        plot_gains(picture, None if result.answer is None else result.answer.data, result.curve, simulated.curves)
    best = min((bound for bound in result.bounds_at_end.values() if bound is not None), default=None)
    met = _met(values.get("residual"), best)
    if as_json:
        click.echo(json.dumps(_problem_json(result, simulated.worst, simulated.why), indent=2, ensure_ascii=False))
    else:
        if result.answer is not None:
            _table(result.answer)
        _summary(result, simulated.worst, simulated.why)
        _say_residual(values.get("residual"), met)
    return 1 if met is False or result.answer is None else 0


def _declared(problem: Problem, values: dict[str, Any]) -> FieldBounds | None:
    """The constants out of the options, which then take the place of certified ones."""
    from ptproof.errors import InputError
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

    tuning = {name: values.pop(name) for name in ("k", "T", "t0", "nu_min", "omega", "mu") if name in values}
    return dataclasses.replace(problem, tuning=dataclasses.replace(problem.tuning, **tuning))


def _met(residual: sp.Expr | None, bound: float | None) -> bool | None:
    if residual is None:
        return None
    return bound is not None and bound <= float(residual)


def _say_residual(residual: sp.Expr | None, met: bool | None) -> None:
    if met is not None:
        click.echo(f"\nResidual {residual} at t₀ + T: {'guaranteed' if met else 'not guaranteed by these bounds'}.")


def _problem_json(result: Study, worst: float | None, why: str) -> dict[str, Any]:
    from ptproof.gains.entries import ENTRIES

    if result.answer is None:
        verdict = None if result.certificate is None else result.certificate.verdict
        reason = f"the field's constants are {verdict}"
        empty: dict[str, Any] = {section: dict.fromkeys(entries) for section, entries in ENTRIES.items()}
        content = {**empty, "why": {f"{s}.{key}": reason for s, entries in ENTRIES.items() for key in entries}}
    else:
        content = result.answer.to_json()
    return {
        "problem": result.problem.name,
        **content,
        "certificate": None if result.certificate is None else result.certificate.to_json(),
        "valid": result.condition,
        "tight": {
            "distance_at_end": result.bounds_at_end["tight"],
            "initial_distance": str(result.curve.initial),
            **result.curve.evidence.to_json(),
        },
        "bounds_at_end": dict(result.bounds_at_end),
        "worst_simulated": worst,
        "looseness": None if worst is None else result.looseness(worst),
        **({"worst_simulated_why": why} if worst is None else {}),
    }


def _table(answer: Gains) -> None:
    import shutil

    room = max(24, shutil.get_terminal_size((110, 24)).columns - 56)
    for section, entries in answer.values.items():
        click.secho(_TITLES[section], bold=True)
        reasons = {answer.why.get(f"{section}.{key}") for key in entries}
        if len(reasons) == 1 and None not in reasons:
            click.echo(f"  — {reasons.pop()}")
            continue
        for key, quantity in entries.items():
            if quantity is None:
                shown, exact = "—", answer.why[f"{section}.{key}"]
            else:
                shown, exact = quantity.text, str(quantity.exact)
            exact = exact if quantity is None or len(exact) <= room else exact[: room - 1] + "…"
            click.echo(f"  {_LABELS[f'{section}.{key}']:<38}{shown:>13}  " + click.style(exact, dim=True))


def _summary(result: Study, worst: float | None, why: str) -> None:
    certificate, curve = result.certificate, result.curve
    status = "declared" if certificate is None else str(certificate.verdict)
    click.echo(f"\nField constants: {status}, valid {result.condition}.")
    if result.answer is None and certificate is not None:
        click.echo(f"  {certificate.summary}")
    click.echo(f"Averaged distance at t₀ + T from a start at {float(curve.initial):.6g}, drift and clip included:")
    names = {
        "printed": "the paper's chain",
        "closed_form": "closed form, sharper",
        "tight": "certified, level by level",
    }
    ratios = {} if worst is None else result.looseness(worst)
    for key, value in result.bounds_at_end.items():
        shown = "—" if value is None else f"≤ {value:.6g}"
        if value is None and result.answer is not None and key != "tight":
            found = result.answer["clip.residual_bound_printed" if key == "printed" else "clip.residual_bound"]
            shown = "—" if found is None else f"≤ {found.text}"
        ratio = ratios.get(key)
        click.echo(f"  {names[key]:<26} {shown:<14}" + ("" if ratio is None else f"{ratio:.3g} × the worst simulated"))
    if worst is None:
        click.echo(f"  not simulated: {why}")
    else:
        click.echo(f"  {'worst simulated':<26} {worst:.6g}        (observed, not a bound)")
    if str(curve.evidence.verdict) != "proved":
        click.echo(f"  the certified bound was {curve.evidence.detail}")
