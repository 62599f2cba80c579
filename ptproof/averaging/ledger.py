"""The hypotheses of singularly perturbed Lie bracket averaging, each with its own verdict (ass:singular_ass)."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp

from ptproof.averaging.boundary import boundary_layer_stability
from ptproof.averaging.bounded import bounded_in_time
from ptproof.averaging.brackets import Vector
from ptproof.averaging.coefficients import signals
from ptproof.averaging.fast import quasi_steady_state
from ptproof.averaging.problem import DitherProblem, FastStates
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided, check_form, parts, unless_refused
from ptproof.averaging.signal import read_signal
from ptproof.errors import InputError
from ptproof.proof.engines.smoothness import smoothness
from ptproof.proof.signs import vanishes
from ptproof.proof.verdict import Evidence, Verdict, Witness
from ptproof.reading.expressions import parse
from ptproof.system import DitherSystem

_TIMES = {2: "twice", 3: "three times"}
_ORDER = {Verdict.REFUTED: 0, Verdict.UNDECIDED: 1, Verdict.PROVED: 2}


@dataclass(frozen=True)
class Ledger:
    """Letter of the hypothesis → evidence; and the quasi-steady state where there are fast states."""

    entries: Mapping[str, Evidence]
    steady: Vector | None

    @property
    def verdict(self) -> Verdict:
        """The weakest verdict of all entries."""
        return min((entry.verdict for entry in self.entries.values()), key=_ORDER.__getitem__)

    def with_verdict(self, verdict: Verdict) -> tuple[str, ...]:
        """The letters with this verdict."""
        return tuple(letter for letter, entry in self.entries.items() if entry.verdict is verdict)

    def details(self, verdict: Verdict) -> tuple[str, ...]:
        """One sentence for each hypothesis with this verdict."""
        return tuple(f"{letter}: {self.entries[letter].detail}" for letter in self.with_verdict(verdict))

    def to_json(self) -> dict[str, Any]:
        return {
            letter: {"verdict": str(entry.verdict), "detail": entry.detail} for letter, entry in self.entries.items()
        }


_OF_FAST_STATES = {"E": "smoothness", "F": "quasi-steady state", "boundary layer": "boundary layer"}


def examine(problem: DitherProblem) -> Ledger:
    """Every hypothesis of the theorem for this system, on the times and the region asked about.

    Undefined functions of ``problem.functions`` are taken as smooth (that is what their declaration says) and
    the letters say so. An entry "refuted" means that the theorem does not cover the system, with the place and,
    where there is one, a witness; "undecided" is a caveat of the result.

    Examples
    --------
    >>> from ptproof.system import DitherSystem
    >>> tau, theta, x = sp.symbols("tau theta x", real=True)
    >>> omega, F = sp.Symbol("omega", positive=True), sp.Function("F", real=True)(x)
    >>> seeker = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (F,)), (sp.cos(theta), sp.sin(theta)))
    >>> examine(DitherProblem(seeker)).with_verdict(Verdict.PROVED)
    ('form', 'A', 'B', 'C', 'D', 'E', 'F', 'boundary layer')
    """
    judges = {"form": _form, "A": smooth_fields, "B": bounded_fields, "C": _dithers, "D": period_and_mean}
    entries = {letter: judged(judge, problem) for letter, judge in judges.items()}
    fast, steady = problem.fast, None
    if fast is None:
        for letter, engine in _OF_FAST_STATES.items():
            entries[letter] = Evidence(engine, Verdict.PROVED, "there are no fast states")
    else:
        try:
            steady, unique = quasi_steady_state(fast, problem.domain)
        except Exception as error:
            unique = _crash(error)
        entries["E"] = judged(_lipschitz_rates, problem, fast)
        entries["F"] = judged(_steady, problem, fast, steady, unique)
        entries["boundary layer"] = judged(_boundary_layer, problem, fast, steady)
    return Ledger(entries, steady)


def judged(judge: Callable[..., Evidence], *arguments: Any) -> Evidence:
    """What ``judge`` says of the arguments, in how many seconds."""
    start = time.perf_counter()
    try:
        evidence = judge(*arguments)
    except Exception as error:  # what fails decides nothing, and the other hypotheses still count
        evidence = _crash(error)
    return replace(evidence, seconds=time.perf_counter() - start)


def _crash(error: Exception) -> Evidence:
    return Evidence("crash", Verdict.UNDECIDED, f"{type(error).__name__}: {error}")


def _form(problem: DitherProblem) -> Evidence:
    fine = "drift + sqrt(omega) * sum of field * dither"
    evidence = unless_refused("form", lambda: check_form(problem.system), fine)
    own = {problem.system.time, problem.system.phase, problem.system.omega}
    for i, rate in enumerate(problem.fast.rate if problem.fast else (), start=1):
        if evidence.verdict is Verdict.PROVED and (found := rate.free_symbols & own):
            names = ", ".join(sorted(symbol.name for symbol in found))
            detail = f"fast rate {i}: g(x, z) may depend on the states only, but it contains {names}"
            return Evidence("form", Verdict.REFUTED, detail)
    return evidence


def _states(problem: DitherProblem) -> tuple[sp.Symbol, ...]:
    return (*problem.system.state, *(problem.fast.state if problem.fast else ()))


def _places(problem: DitherProblem) -> Iterator[tuple[str, sp.Expr]]:
    """Every entry of drift and fields that is no rational number, with what people call it; each expression once."""
    seen: set[sp.Expr] = set()
    for name, entries in parts(problem.system):
        for row, entry in enumerate(entries, start=1):
            if not entry.is_Rational and entry not in seen:
                seen.add(entry)
                yield f"{name}, entry {row}", entry


def _worst(found: Sequence[tuple[str, Evidence]], engine: str, fine: str) -> Evidence:
    """The first refutation, else all that is undecided, else proved."""
    for place, evidence in found:
        if evidence.verdict is Verdict.REFUTED:
            return replace(evidence, engine=engine, detail=f"{place}: {evidence.detail}")
    left = [(place, evidence) for place, evidence in found if evidence.verdict is not Verdict.PROVED]
    if left:
        detail = "; ".join(f"{place}: {evidence.detail}" for place, evidence in left[:3])
        more = f"; and {len(left) - 3} more" if len(left) > 3 else ""
        return Evidence(engine, Verdict.UNDECIDED, detail + more)
    return Evidence(engine, Verdict.PROVED, fine)


def _assumed(problem: DitherProblem) -> dict[Any, Any]:
    """The functions that are smooth: those declared, or all that occur, whatever stands in them."""
    declared = problem.functions is not None
    return {entry if declared else entry.func: sp.oo for entry in problem.smooth_functions}


def _where(problem: DitherProblem) -> str:
    ranges = []
    if problem.system.time in {s for _, entry in _places(problem) for s in entry.free_symbols}:
        ranges.append("all times" if problem.start is None else f"{problem.system.time} >= {problem.start}")
    ranges += [f"{symbol} in [{low}, {high}]" for symbol, (low, high) in problem.region.items()]
    text = f" for {', '.join(ranges)}" if ranges else ""
    if problem.smooth_functions:
        text += f", with {', '.join(map(str, problem.smooth_functions))} smooth as declared"
    return text


def smooth_fields(problem: DitherProblem, order: int = 2) -> Evidence:
    """Whether drift and fields are C^``order`` on the times and the region asked about."""
    variables = (problem.system.time, *_states(problem))
    found = []
    for place, entry in _places(problem):
        evidence = smoothness(entry, variables, order, _assumed(problem), problem.domain)
        if evidence.witness is not None:
            evidence = replace(evidence, detail=evidence.detail + _dilation_hint(problem, entry, evidence.witness))
        found.append((place, evidence))
    return _worst(
        found, "smoothness", f"{_TIMES.get(order, f'{order} times')} continuously differentiable" + _where(problem)
    )


def _dilation_hint(problem: DitherProblem, entry: sp.Expr, witness: Witness) -> str:
    """What helps where a gain grows without bound at a finite time: one whose base is 0 at the witness."""
    time_, at = problem.system.time, {}
    for symbol in entry.free_symbols:
        with contextlib.suppress(InputError):  # a value that is more than arithmetic
            at[symbol] = parse(witness.values.get(str(symbol), str(symbol)), list(entry.free_symbols))
    for power in entry.atoms(sp.Pow):
        free = power.base.free_symbols
        of_time = time_ in free and all(symbol.is_positive for symbol in free - {time_})
        if power.exp.is_negative and of_time and vanishes(power.base.subs(at, simultaneous=True)):
            return f"; a gain that grows without bound in {time_}: dilate time first, then average"
    return ""


def bounded_fields(problem: DitherProblem) -> Evidence:
    """Whether drift and fields are bounded in time on every compact set of states."""
    system, start, domain = problem.system, problem.start, problem.domain
    found = [
        (place, bounded_in_time(entry, system.time, _states(problem), start, domain, problem.bounded))
        for place, entry in _places(problem)
    ]
    evidence = _worst(found, "bounded in time", "bounded on every compact set of states" + _where(problem))
    if evidence.verdict is Verdict.REFUTED:
        evidence = replace(evidence, detail=evidence.detail + "; dilating time first would help for a growing gain")
    return evidence


def unread(system: DitherSystem) -> Evidence | None:
    """That a dither is none of the signals that are read piece by piece, all of which are bounded; None if all are."""
    for i, dither in enumerate(system.dithers, start=1):
        try:
            read_signal(dither, system.phase, system.period, f"dither {i}")
        except (AveragingRefused, AveragingUndecided) as error:
            return Evidence("dithers", Verdict.UNDECIDED, str(error))
    return None


def _dithers(problem: DitherProblem) -> Evidence:
    system = problem.system
    if open_question := unread(system):
        return open_question
    found = []
    for i, dither in enumerate(system.dithers, start=1):
        if system.time in dither.free_symbols:
            # The slow amplitude has to be bounded with its derivative: then it is Lipschitz.
            own = (system.phase,)
            smooth = smoothness(dither, (system.time,), 1, _assumed(problem), problem.domain)
            bounded = bounded_in_time(dither, system.time, own, problem.start, problem.domain, problem.bounded)
            found += [(f"dither {i}", smooth), (f"dither {i}", bounded)]
    detail = "piecewise smooth and periodic in the phase"
    if found:
        detail += ", with slow amplitudes that are bounded with their derivatives"
    return _worst(found, "dithers", detail)


def period_and_mean(problem: DitherProblem) -> Evidence:
    """Whether each dither has the declared period and the mean 0."""
    fine = f"each dither has the period {problem.system.period} and the exact mean 0"
    return unless_refused("exact integrals", lambda: signals(problem.system), fine)


def _lipschitz_rates(problem: DitherProblem, fast: FastStates) -> Evidence:
    rates = enumerate(fast.rate, start=1)
    found = [(f"fast rate {i}", _lipschitz(rate, _states(problem), problem)) for i, rate in rates]
    return _worst(found, "smoothness", "locally Lipschitz" + _where(problem))


def _lipschitz(rate: sp.Expr, variables: Sequence[sp.Symbol], problem: DitherProblem) -> Evidence:
    """Continuously differentiable functions, and Abs, Max and Min of such, are locally Lipschitz."""
    kinks = [node for node in rate.atoms(sp.Abs, sp.Max, sp.Min) if node.free_symbols & set(variables)]
    outer = rate
    places = []
    for node in sorted(kinks, key=lambda entry: -sp.count_ops(entry)):
        if outer.has(node):
            places.append(
                sp.Dummy("kink", nonnegative=True) if isinstance(node, sp.Abs) else sp.Dummy("kink", real=True)
            )
            outer = outer.xreplace({node: places[-1]})
    domain = problem.domain
    for part in (outer, *(argument for node in kinks for argument in node.args)):
        if part.atoms(sp.Abs, sp.Max, sp.Min) and part is not outer:
            evidence = _lipschitz(part, variables, problem)
        else:
            evidence = smoothness(part, (*variables, *places), 1, _assumed(problem), domain)
        if evidence.verdict is not Verdict.PROVED:
            # Not differentiable is not yet not Lipschitz; a jump is.
            jump = smoothness(rate, variables, 0, _assumed(problem), domain)
            unknown = replace(evidence, verdict=Verdict.UNDECIDED, witness=None)
            return jump if jump.verdict is Verdict.REFUTED else unknown
    return Evidence("smoothness", Verdict.PROVED, "locally Lipschitz")


def _steady(problem: DitherProblem, fast: FastStates, steady: Vector | None, unique: Evidence) -> Evidence:
    if steady is None or unique.verdict is Verdict.REFUTED:
        return unique
    found = [("uniqueness", unique)]
    for i, value in enumerate(steady, start=1):
        smooth = smoothness(value, problem.system.state, 2, _assumed(problem), problem.domain)
        found.append((f"l_{i} = {value}", smooth))
    values = ", ".join(f"{z} = {value}" for z, value in zip(fast.state, steady, strict=True))
    detail = f"{values} is the only solution ({unique.detail}) and twice continuously differentiable"
    return _worst(found, "quasi-steady state", detail)


def _boundary_layer(problem: DitherProblem, fast: FastStates, steady: Vector | None) -> Evidence:
    if steady is None:
        return Evidence("boundary layer", Verdict.UNDECIDED, "no quasi-steady state is known")
    return boundary_layer_stability(fast, steady, problem.domain, problem.system.state)
